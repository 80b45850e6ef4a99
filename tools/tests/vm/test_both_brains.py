"""The flashed program on the simulated Mega and the firmware for the host drive the same world."""

import subprocess
from pathlib import Path

import pytest
from plumb.bench.causes import Hidden
from plumb.line.sender import Sender
from plumb.vm.garage import Garage, set_up
from plumb.vm.in_process import InProcessPort

ROOT = Path(__file__).resolve().parents[3]
ELF = ROOT / ".pio/build/megaatmega2560/firmware.elf"
MOVES = ("G0 X20 Y10", "G1 X0 Y-20 F600", "G1 X5 Y-20 Z1 F300", "G0 X0 Y0 Z0")
WITHIN = 2  # encoder counts at rest; a chain is 0.008 mm for each


@pytest.fixture(scope="module")
def elf() -> str:
    pio = ["flock", ROOT / ".pio", ROOT / ".venv/bin/pio"]
    subprocess.run([*pio, "run", "-s", "-d", ROOT, "-e", "megaatmega2560"], check=True)
    return str(ELF)


def rests(elf: str | None) -> list[list[int]]:
    """The counts of all axes after each move."""
    garage = Garage(Hidden(), friction=0.0)
    machine = garage.machine(elf=elf)
    machine.start()
    sender = Sender(InProcessPort(machine))
    sender.await_start()
    set_up(sender, garage.settings)
    counts = []
    for move in MOVES:
        sender.stream([move, "G4 P1"])
        sender.await_rest()
        counts.append([machine.count(axis) for axis in ("left", "right", "z")])
    return counts


@pytest.mark.slow
def test_both_rest_at_the_same_counts(elf):
    flashed, host = rests(elf), rests(None)
    for move, mega, computer in zip(MOVES, flashed, host, strict=True):
        apart = [abs(a - b) for a, b in zip(mega, computer, strict=True)]
        assert max(apart) <= WITHIN, f"{move}: {mega} and {computer}"
    assert max(map(abs, host[0])) > 1000


@pytest.mark.slow
def test_the_flashed_program_keeps_its_place_through_a_power_cut(elf):
    machine = Garage(Hidden()).machine(elf=elf)
    machine.start()
    sender = Sender(InProcessPort(machine))
    sender.await_start()
    set_up(sender, Garage(Hidden()).settings)
    sender.stream(["G0 X10"])
    sender.await_rest()
    place = machine.sled
    machine.stop()
    machine.start()
    again = Sender(InProcessPort(machine))
    again.await_start()
    assert again.status.place[0] == pytest.approx(10.0, abs=0.05)
    assert machine.sled == pytest.approx(place, abs=0.01)
