"""The flashed program on the simulated Mega and the firmware for the host drive the same world."""

import numpy as np
from plumb.bench.boards import Hidden
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


# [steps of 255] Most by which a motor's drive changes from tick to tick at an even speed. An edge
# that comes early or late moves it by 15.
EVEN = 21


def test_no_tick_of_the_simulated_mega_loses_time(elf):
    garage = Garage(Hidden(), friction=0.0)
    machine = garage.machine(elf=elf)
    switched_on(machine, garage.settings).stream(["G0 X-300 Y0", "G4 P1"])
    machine.send(b"G1 X300 Y0 F800\n")
    machine.advance(5000)
    drives = []
    for _ in range(3500):
        machine.advance(10)
        drives.append([machine.duty("left"), machine.duty("right")])
    changes = abs(np.diff(drives, axis=0))
    assert changes.max() <= EVEN
    assert min(np.ptp(drives, axis=0)) > 10  # it went all the time
