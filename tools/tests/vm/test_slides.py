"""A sled high on the sheet keeps its motors on; one that slides all the same is held again."""

import numpy as np
import pytest
from plumb.bench.causes import MAKER
from plumb.vm.garage import VirtualMachine
from usual_machine import declaration, switched_on, usual_machine

STAYS = "The motors stay on: so high on the sheet the sled would slide ($77). Park it lower."
SLIDES = "The sled slid with its motors off: they hold it until after its next move."
MOST = 1.5  # [mm] the chain gives 0.4 mm, and some more until its motor holds
CREEP = 0.5  # [mm] at most, of what was let go
HELD = 0.05  # [mm] at most, of what has power
USUAL = "$77=1.4"  # [N m]
TRUSTED = "$77=10"  # [N m] the machine believes that its gears hold any sled


@pytest.mark.parametrize(
    ("brain", "height", "setting", "warned", "most"),
    [
        ("host", 605.0, USUAL, STAYS, HELD),
        ("host", 450.0, USUAL, "", CREEP),
        ("host", 605.0, TRUSTED, SLIDES, MOST),
        pytest.param("mega", 605.0, TRUSTED, SLIDES, MOST, marks=pytest.mark.slow),
    ],
)
def test_a_sled_stays_where_it_was(brain, height, setting, warned, most, elf):
    machine = usual_machine(elf=elf if brain == "mega" else None)
    said: list[str] = []
    sender = switched_on(machine, MAKER, said=said.append)
    sender.stream([setting, declaration(machine), f"G0 X0 Y{height}", "G4 P0"])
    lowest = farthest_in(30, machine)
    sender.stream(["G1 X200 F600", "G4 P0"])
    x, y = machine.sled
    assert lowest < most
    assert (x, y) == pytest.approx((200, height), abs=CREEP)
    farthest_in(10, machine)
    sender.stream(["G1 X150", "G4 P0"])
    heard = [line for line in said if line in (STAYS, SLIDES)]
    # That they stay on is said once; each time that it slides is news.
    assert heard == ([STAYS] if warned == STAYS else [SLIDES] * len(heard))
    assert bool(heard) == bool(warned)
    assert (lowest > CREEP) == (warned == SLIDES)


def farthest_in(seconds: int, machine: VirtualMachine) -> float:
    """How far the sled goes [mm] from where it stands."""
    stood, farthest = machine.sled, 0.0
    for _ in range(10 * seconds):
        machine.advance(100)
        farthest = max(farthest, float(np.hypot(*np.subtract(machine.sled, stood))))
    return farthest
