"""The flashed program on the simulated Mega and the firmware for the host drive the same world."""

from plumb.bench.causes import Hidden
from plumb.vm.garage import Garage
from usual_machine import switched_on

MOVES = ("G0 X20 Y10", "G1 X16 Y6 Z1 F600")
# [counts] Between two rests. The loop lets a chain rest within 1.5 counts of its set-point, and
# the host's program itself differs by as much if a line comes to it a millisecond later.
WITHIN = 2


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
    for move, mega, computer in zip(MOVES, flashed, host, strict=True):
        apart = [abs(a - b) for a, b in zip(mega, computer, strict=True)]
        assert max(apart) <= WITHIN, f"{move}: {mega} and {computer}"
    assert max(map(abs, host[0])) > 1000
