"""The guide's words after a jog of a virtual machine with a fault in its wires."""

import pytest
from plumb.bench.boards import Hidden
from plumb.guide import GuideProgress, GuideVisit, chain_jog, check_wires, ran_away, remedy
from plumb.line.memory import read_numbers
from plumb.line.sender import Sender
from plumb.text.values import MM
from plumb.vm.garage import Garage, InProcessPort
from prepared_owner import PreparedOwner
from usual_machine import switched_on

SIDES = ("left", "right")
MOVED = 0.5  # [mm] that an owner sees


def jogged(tmp_path, side, *faults):
    """The motion that an owner sees in a jog, and the machine's words."""
    machine = Garage(Hidden()).machine()
    for fault in faults:
        machine.set_wire(side, fault, True)
    sender = switched_on(machine)
    visit = GuideVisit(sender, PreparedOwner(input), GuideProgress(tmp_path))
    before = machine.chains[SIDES.index(side)]
    alarm = visit.move(*chain_jog(side, MM).there)
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


Z_FAULTS = {
    (): "",
    ("motor_reversed",): "power wires of the z motor are swapped",
    ("encoder_reversed",): "encoder of the z motor counts backwards",
    ("motor_reversed", "encoder_reversed"): "give $19 (its travel for one turn) the other sign",
    ("motor_unplugged",): "gets no power",
    ("encoder_unplugged",): "its encoder is silent",
}


class FirstDay:
    """A machine that no client ever spoke to, and an owner who watches z as well as he can."""

    def __init__(self, folder, faults, *, sees=0.05):
        self.machine = Garage(Hidden()).machine()
        for fault in faults:
            self.machine.set_wire("z", fault, True)
        self.machine.start()
        owner = PreparedOwner(self._answer)
        self.said, self._sees, self._before = owner.said, sees, 0.0
        self.sender = Sender(InProcessPort(self.machine))
        self.sender.await_start()
        self.visit = GuideVisit(self.sender, owner, GuideProgress(folder))
        self.heights = []
        self.sender.attend = lambda _: self.heights.append(self.machine.height)

    def _answer(self, question):
        if "router go up" not in question:
            self._before = self.machine.height
            return "s" if "What did you see" in question else "y"
        went = self.machine.height - self._before
        return "n" if abs(went) < self._sees else "s" if went > 0 else "l"

    def check(self):
        """Take the step; what it says of z at the end."""
        self.said.clear()
        self.heights.clear()
        done = check_wires(self.visit)
        return done, "" if done else self.said[-1]


@pytest.mark.parametrize("faults", Z_FAULTS, ids="-".join)
def test_a_fault_of_z_is_named_before_it_has_gone_far(tmp_path, faults):
    day = FirstDay(tmp_path, faults)
    done, said = day.check()
    assert done is (not faults) and Z_FAULTS[faults] in said
    assert max(map(abs, day.heights)) < 1.05
    day.machine.advance(60_000)
    assert abs(day.machine.height) < 1.05
    assert read_numbers(day.sender)[29] == 1300


@pytest.mark.parametrize("faults", [each for each in Z_FAULTS if "rev" in str(each)], ids="-".join)
def test_z_rises_once_the_named_wire_is_swapped(tmp_path, faults):
    day = FirstDay(tmp_path, faults)
    day.check()
    if len(faults) == 1:
        day.machine.set_wire("z", faults[0], False)
    else:
        day.sender.stream(["$19=-3.17"])
    assert day.check() == (True, "")
    assert max(day.heights) - day.heights[0] > 0.7


@pytest.mark.parametrize("fault", ["motor_reversed", "encoder_reversed"])
def test_an_owner_who_saw_nothing_is_still_led_to_the_cure(tmp_path, fault):
    day = FirstDay(tmp_path, (fault,), sees=0.5)
    assert "are swapped, or its encoder counts backwards" in day.check()[1]
    # He exchanges the power wires, which was wrong if it was the encoder.
    day.machine.set_wire("z", "motor_reversed", fault == "encoder_reversed")
    done, said = day.check()
    assert done is (fault == "motor_reversed")
    if not done:
        assert "give $19" in said
        day.sender.stream(["$19=-3.17"])
        assert day.check() == (True, "")


def test_a_motor_that_ran_away_is_not_called_good(tmp_path):
    day = FirstDay(tmp_path, ())
    day.sender.stream(["$33=0"])
    done, said = day.check()
    assert not done and "was to move by 1.00 mm and counts 0." in said
    assert day.machine.height > 0.5, "and is not moved again"
    for counted, is_good in [(1.29, True), (0.71, True), (1.31, False), (0.69, False)]:
        assert (ran_away(1, counted, MM) == "") is is_good
