"""Every dialogue of test/dialogues, played by the flashed program on the simulated Mega.

The host's build of the firmware plays the same files in test/test_dialogues.
"""

import sys
from concurrent.futures import Future, ThreadPoolExecutor
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools/bench"))
from played import play, played, stage_player  # noqa: E402

DIALOGUES = ROOT / "test/dialogues"
# The simulated shield is v1.2, whose drivers have no error pins.
ON_OTHER_SHIELDS = {"driver_error.nc"}
NAMES = sorted({path.name for path in DIALOGUES.glob("*.nc")} - ON_OTHER_SHIELDS)


@pytest.fixture(scope="module")
def player() -> Path:
    """The program that plays a dialogue on the simulated board; the firmware is built too."""
    return stage_player()


@pytest.fixture(scope="module")
def ends(player, request) -> dict[str, Future]:
    """The end of each dialogue that was asked for; two at a time, as each takes up to minutes."""
    calls = [item.callspec for item in request.session.items if hasattr(item, "callspec")]
    asked = {call.params["name"] for call in calls if call.params.get("name") in NAMES}
    pool = ThreadPoolExecutor(2)
    yield {name: pool.submit(played, player, DIALOGUES, name) for name in sorted(asked)}
    pool.shutdown(cancel_futures=True)


@pytest.mark.slow
@pytest.mark.parametrize("name", NAMES)
def test_the_flashed_program_answers_as_written(ends, name):
    done = ends[name].result()
    assert done.returncode == 0, done.stderr


@pytest.mark.slow
def test_the_player_notices_what_is_wrong(player, tmp_path):
    wrong = [
        "<- PCB v1.3 Detected",
        "<* ok\n~~ wait 1\n~~ on left",
        "<* ok\n~~ wait 1\n~~ laser high",
    ]
    for i, text in enumerate(wrong):
        (tmp_path / f"{i}.nc").write_text(text)
        assert play(player, tmp_path, f"{i}.nc").returncode == 1
    assert play(player, tmp_path, "absent.nc").returncode == 2
