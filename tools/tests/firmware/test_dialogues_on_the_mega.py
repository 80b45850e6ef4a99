"""Every dialogue of test/dialogues, played by the flashed program on the simulated Mega.

The host's build of the firmware plays the same files in test/test_dialogues, in the same world of
motors, chains and sled.
"""

import sys
from concurrent.futures import Future, ThreadPoolExecutor

import pytest
from example_machine import ROOT

sys.path.insert(0, str(ROOT / "tools/bench"))
import played as plays
from played import played

DIALOGUES = ROOT / "test/dialogues"
NAMES = sorted(path.name for path in DIALOGUES.glob("*.nc"))
# Played whenever anything changed: motion, a halt, the memory, the probe.
ALWAYS = {"arcs.nc", "halts.nc", "power_cut.nc", "probe.nc"}


@pytest.fixture(scope="module")
def ends(request) -> dict[str, Future]:
    """The end of each dialogue that was asked for; two at a time, as each takes seconds."""
    calls = [item.callspec for item in request.session.items if hasattr(item, "callspec")]
    asked = {call.params["name"] for call in calls if call.params.get("name") in NAMES}
    player = plays.player()
    pool = ThreadPoolExecutor(2)
    yield {name: pool.submit(played, player, DIALOGUES, name) for name in sorted(asked)}
    pool.shutdown(cancel_futures=True)


@pytest.mark.parametrize(
    "name", [pytest.param(name, marks=() if name in ALWAYS else pytest.mark.slow) for name in NAMES]
)
def test_the_flashed_program_answers_as_written(ends, name):
    done = ends[name].result()
    assert done.returncode == 0, done.stderr
