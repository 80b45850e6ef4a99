"""The flashed program on the simulated Mega and the firmware for the host drive the same world."""

import numpy as np
from plumb.bench.causes import Hidden
from plumb.model.predict import lengths
from plumb.vm.garage import EXTENDED, Garage
from usual_machine import switched_on

MOVES = ("G0 X20 Y10", "G1 X16 Y6 Z1 F600")
COUNT = 63.5 / 8113.73  # [mm] of chain for an encoder count
# [counts] Between two rests. The loop lets a chain rest within 1.5 counts of its set-point, and
# the host's program itself differs by as much if a line comes to it a millisecond later.
WITHIN = 2
DEAD_BAND = 1.5  # [counts]


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
