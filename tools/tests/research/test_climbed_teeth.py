"""A chain that climbs over a tooth slips by a link, and the firmware suspects it, not more."""

import numpy as np
import pytest
from scene import Scene
from slips import (
    CHAINS,
    FRICTION,
    SlipTry,
    false_suspicions,
    lines_along,
    table,
    telemetry_of,
    tried,
    tries,
)

LINK = 6.35  # [mm]


@pytest.fixture(scope="module")
def scene():
    return Scene(2, friction=FRICTION)


@pytest.mark.slow
def test_most_slips_are_suspected_and_never_of_the_other_chain():
    seen = list(tries([2], feeds=[400.0]))
    assert len(seen) == 20
    assert sum(each.named > 0 for each in seen) >= 11, seen
    assert max(each.named for each in seen) <= 1
    assert sum(each.other for each in seen) == 0


@pytest.mark.parametrize("chain", CHAINS)
def test_it_is_said_where_and_when_a_chain_may_have_slipped(scene, chain):
    seen = tried(scene, chain, (-700.0, 250.0), 400.0, winds_in=True)
    assert (seen.named, seen.other) == (1, 0), seen
    last = telemetry_of(scene).last_slip
    assert last.chain == chain
    assert np.hypot(*np.subtract(last.place, (-700, 250))) < 20
    assert 3 < last.seconds_ago < 20


def test_the_flashed_program_suspects_it_too(elf):
    scene = Scene(2, elf=elf, friction=FRICTION)
    assert telemetry_of(scene).last_slip is None
    seen = tried(scene, "right", (0.0, 0.0), 400.0, winds_in=True)
    assert (seen.named, seen.other) == (1, 0)


def test_a_chain_that_climbs_over_a_tooth_slips_by_a_link():
    scene = Scene(1)
    scene.send(["G0 X0 Y88.66"])
    machine, before = scene.machine, scene.machine.sled
    machine.climb("left")
    machine.advance(3000)
    assert machine.sled == pytest.approx(before, abs=1e-3)  # a sprocket at rest
    scene.send(["G1 X60 Y88.66 F400", "G1 X0"])
    moved = np.hypot(*np.subtract(machine.sled, before))
    machine.slip("left", -LINK)
    machine.advance(1000)
    assert 3 < moved < 2 * LINK
    assert machine.sled == pytest.approx(before, abs=0.05)


def test_work_and_stops_alone_raise_no_suspicion():
    # Of the machines that docs/telemetry.md counts; others have one in some hours.
    assert false_suspicions(0.1, seeds=[11]) == (0, pytest.approx(0.1, abs=0.05))


def test_a_line_along_a_chain_goes_to_its_motor():
    begin, end = lines_along("left", (-1489.2, 0.0), True)
    assert (begin, end) == ("X-1489.20 Y-50.00", "X-1489.20 Y50.00")
    assert lines_along("left", (-1489.2, 0.0), False) == (end, begin)
    assert lines_along("right", (1489.2, 0.0), True)[1] == "X1489.20 Y50.00"


def test_the_table_counts_by_tension_and_feed():
    done = [
        SlipTry(150.0, True, 95.0, 1, 0),
        SlipTry(150.0, True, 95.0, 0, 1),
        SlipTry(900.0, True, 35.0, 2, 0),
    ]
    rows = table(done).splitlines()
    assert rows[2:] == ["| 30 to 50 | – | – | 1 of 1 | 0 |", "| over 90 | 1 of 2 | – | – | 1 |"]
