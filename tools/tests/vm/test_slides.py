"""A sled high on the sheet whose motors are let go slides, and is held again where it was."""

import numpy as np
import pytest
from plumb.bench.causes import MAKER
from plumb.line.sender import Sender
from plumb.model.predict import judged, lengths
from plumb.vm.garage import VirtualMachine, set_up
from plumb.vm.in_process import InProcessPort

SLIDES = "The sled slid with its motors off: they hold it until after its next move."
MOST = 1.5  # [mm] the chain gives 0.4 mm, and some more until its motor holds
CREEP = 0.5  # [mm] at most, of what was let go


@pytest.mark.parametrize("height", [605.0, 450.0])
@pytest.mark.parametrize("brain", ["host", "mega"])
def test_a_sled_that_slides_is_held_where_it_was(height, brain, elf):
    chains, _ = lengths(MAKER, np.zeros((1, 2)))
    machine = VirtualMachine(
        judged(MAKER), paid_out=float(chains[0, 0]), elf=elf if brain == "mega" else None
    )
    machine.start()
    said: list[str] = []
    sender = Sender(InProcessPort(machine), said=said.append)
    sender.await_start()
    set_up(sender, MAKER)
    left, right = machine.chains
    sender.stream([f"B06 L{left:.4f} R{right:.4f}", f"G0 X0 Y{height}", "G4 P0"])
    stood, lowest = machine.sled, 0.0
    for _ in range(300):
        machine.advance(100)
        lowest = max(lowest, float(np.hypot(*np.subtract(machine.sled, stood))))
    sender.stream(["G1 X200 F600", "G4 P0"])
    x, y = machine.sled
    assert lowest < MOST
    assert (x, y) == pytest.approx((200, height), abs=CREEP)
    assert (SLIDES in said) == (height > 600) == (lowest > CREEP)
