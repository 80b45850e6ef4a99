"""The flashed program on the simulated Mega and the firmware for the host drive the same world."""

import re
from dataclasses import replace

import numpy as np
import pytest
from plumb.bench.causes import MAKER, Hidden
from plumb.model.predict import lengths
from plumb.vm.garage import EXTENDED, Garage
from usual_machine import switched_on

MOVES = ("G0 X20 Y10", "G1 X0 Y-20 F600", "G1 X5 Y-20 Z1 F300", "G0 X0 Y0 Z0")
COUNT = 63.5 / 8113.73  # [mm] of chain for an encoder count
# [counts] Between two rests. The loop lets a chain rest within 1.5 counts of its set-point, and
# the host's program itself differs by as much if a line comes to it a millisecond later.
WITHIN = 2
DEAD_BAND = 1.5  # [counts]
ASKED = ("G1 X2 Y1 F30", "G2 X3 Y2 I0 J1 F25", "G1 X0 Y0 F20")  # in inches: reported to 0.3 counts
REPORT = re.compile(r"<\w+,MPos:(-?[\d.]+),(-?[\d.]+),")
REPORTED_EVERY, TICK = 200, 10  # [ms]


def rests(elf: str | None) -> list[list[int]]:
    """The counts of all axes after each move."""
    garage = Garage(Hidden(), friction=0.0)
    machine = garage.machine(elf=elf)
    sender = switched_on(machine, garage.settings)
    counts = []
    for move in MOVES:
        sender.stream([move, "G4 P1"])
        sender.await_rest()
        counts.append([machine.count(axis) for axis in ("left", "right", "z")])
    return counts


def set_points(elf: str | None, phases: range) -> list[np.ndarray]:
    """The chains' set-points [counts] in each move of ASKED, as reports on the way tell them.

    A report shows a tick in twenty. With each phase the moves begin a tick later.
    """
    garage = Garage(Hidden(), friction=0.0)
    machine = garage.machine(elf=elf)
    sender = switched_on(machine, garage.settings)
    sender.stream(["G0 X0 Y0"])
    sender.await_rest()
    sender.stream(["G20"])
    places: list[list[tuple[float, float]]] = [[] for _ in ASKED]
    for phase in phases:
        for move, seen in zip(ASKED, places, strict=True):
            machine.advance((TICK * phase - round(machine.seconds * 1000)) % REPORTED_EVERY + 1000)
            machine.take_said()
            machine.send(f"{move}\n".encode())
            said, last = "", [("", "")]
            while len(last) < 5 or len({*last[-5:]}) > 1:
                machine.advance(REPORTED_EVERY)
                said += machine.take_said().decode()
                last = REPORT.findall(said)
            seen += [(float(x), float(y)) for x, y in last]
    inch = 25.4
    settings = garage.settings
    return [
        lengths(settings, inch * np.unique(np.array(each), axis=0))[0] / COUNT for each in places
    ]


@pytest.mark.slow
def test_both_ask_for_the_same_lengths_at_the_same_ticks(elf):
    """At each tick that the Mega reports, its set-points are those of a tick of the host."""
    flashed, host = set_points(elf, range(1)), set_points(None, range(REPORTED_EVERY // TICK))
    for move, mega, ticks in zip(ASKED, flashed, host, strict=True):
        apart = np.abs(mega[:, None] - ticks[None]).max(axis=2).min(axis=1)
        assert apart.max() <= 1, f"{move}: {apart}"
        assert len(mega) > 20
    # Ticks are so far apart that no wrong set-point is near a tick by chance, move after move.
    steps = np.abs(np.diff(np.sort(host[0][:, 0])))
    assert np.median(steps) > 3


def test_both_rest_at_the_same_counts(elf):
    flashed, host = rests(elf), rests(None)
    asked = targets()
    for move, mega, computer, target in zip(MOVES, flashed, host, asked, strict=True):
        apart = [abs(a - b) for a, b in zip(mega, computer, strict=True)]
        assert max(apart) <= WITHIN, f"{move}: {mega} and {computer}"
        for counts in (mega, computer):
            # A count is a whole number, and a motor without power may turn by part of a count.
            assert np.abs(counts[:2] - target).max() <= DEAD_BAND + 1, f"{move}: {counts}, {target}"
    assert max(map(abs, host[0])) > 1000


def targets() -> np.ndarray:
    """[counts] of both chains from the start, for the end of each of MOVES."""
    words = [dict((word[0], float(word[1:])) for word in move.split()[1:]) for move in MOVES]
    ends = np.array([(each["X"], each["Y"]) for each in words])
    chains, _ = lengths(Garage(Hidden()).settings, ends)
    return (chains - EXTENDED) / COUNT


@pytest.mark.slow
def test_the_flashed_program_keeps_its_place_through_a_power_cut(elf):
    machine = Garage(Hidden()).machine(elf=elf)
    sender = switched_on(machine, Garage(Hidden()).settings)
    sender.stream(["G0 X10"])
    sender.await_rest()
    place = machine.sled
    machine.stop()
    again = switched_on(machine)
    assert again.status.place[0] == pytest.approx(10.0, abs=0.05)
    assert machine.sled == pytest.approx(place, abs=0.01)


@pytest.mark.slow
def test_the_flashed_program_drives_chains_off_the_bottom(elf):
    garage = Garage(Hidden(), friction=0.0, settings=replace(MAKER, feed="bottom"))
    machine = garage.machine(elf=elf)
    sender = switched_on(machine, garage.settings)
    sender.stream(["G0 X-40 Y30"])
    sender.await_rest()
    assert machine.sled == pytest.approx((-40, 30), abs=0.05)
