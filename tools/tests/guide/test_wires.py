"""What a jog of a virtual machine with a fault in its wires makes the guide say."""

import pytest
from plumb.bench.causes import Hidden
from plumb.guide.progress import Progress
from plumb.guide.steps import Visit
from plumb.guide.talk import Talk
from plumb.guide.wires import chain_jog, remedy
from plumb.line.sender import Sender
from plumb.vm.garage import Garage
from plumb.vm.in_process import InProcessPort

SIDES = ("left", "right")
MOVED = 0.5  # [mm] that an owner sees


def jogged(tmp_path, side, *faults):
    """What an owner sees of a jog, and what the machine says."""
    machine = Garage(Hidden()).machine()
    for fault in faults:
        machine.set_wire(side, fault, True)
    machine.start()
    sender = Sender(InProcessPort(machine))
    sender.await_start()
    visit = Visit(sender, Talk(print, input), Progress(tmp_path))
    before = machine.chains[SIDES.index(side)]
    alarm = visit.move(*chain_jog(side).there)
    change = machine.chains[SIDES.index(side)] - before
    seen = "n" if abs(change) < MOVED else "s" if change < 0 else "l"
    return seen, alarm


@pytest.mark.parametrize("side", SIDES)
@pytest.mark.parametrize(
    ("faults", "words"),
    [
        ((), ""),
        (("motor_reversed",), "power wires of the {side} motor are swapped"),
        (("encoder_reversed",), "encoder of the {side} motor counts backwards"),
        (("motor_reversed", "encoder_reversed"), "runs the wrong way"),
        (("motor_unplugged",), "gets no power"),
        (("encoder_unplugged",), "its encoder is silent"),
    ],
)
def test_the_remedy_names_the_wire_that_is_wrong(tmp_path, side, faults, words):
    said = remedy(side, *jogged(tmp_path, side, *faults))
    assert words.format(side=side) in said
    assert bool(said) == bool(faults)


@pytest.mark.parametrize(("axis", "plug"), [("left", "MP3"), ("right", "MP1"), ("z", "MP2")])
def test_the_wrong_motor_moved_so_a_plug_is_on_the_wrong_socket(axis, plug):
    assert plug in remedy(axis, "o", "")


def test_z_that_goes_down_wants_another_sign():
    assert "$20" in remedy("z", "l", "")


def test_an_alarm_that_names_no_wire_is_said_as_it_is():
    assert "no such thing" in remedy("left", "s", "no such thing")
