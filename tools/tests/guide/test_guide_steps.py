"""Steps of the guide: lines, answers, alarms, what it keeps and calls normal; faults in wires."""

from types import SimpleNamespace

import pytest
from plumb import guide
from plumb.fit.compare import expected_anywhere, expected_priors, expected_sentence
from plumb.guide import (
    GuideProgress,
    GuideVisit,
    _judge_mark,
    chain_jog,
    check_wires,
    first_mark,
    keep_other,
    progress_in,
    ran_away,
    remedy,
    set_chains,
    show_reach,
    tell_numbers,
)
from plumb.hidden import Hidden
from plumb.line.memory import read_numbers
from plumb.line.sender import Sender
from plumb.settings import machine_toml
from plumb.text.errors import InputError
from plumb.text.values import MM
from plumb.vm.garage import Garage, InProcessPort
from synthetic import BELIEVED
from usual_machine import switched_on


class PreparedOwner:
    """Answers each question by a function of its text; `said` holds what was said and asked."""

    unit = MM

    def __init__(self, answer):
        self.said, self._answer = [], answer

    def say(self, text):
        self.said.append(text)

    def _ask(self, question):
        self.said.append(question)
        return self._answer(question)

    def agrees(self, what, act):
        return self._ask(what) == "y"

    def says_yes(self, question):
        return self._ask(question) == "y"

    def choice(self, question, answers):
        letter = self._ask(question)
        assert letter in answers
        return letter

    def number(self, question, low, high, *, usual=None, kind="length"):
        size = float(self._ask(question))
        assert low <= size <= high
        return size


class Sent(GuideVisit):
    """A visit that keeps what it would send; `alarms` stops the machine at lines with a word."""

    def __init__(self, folder, answers, *, place=(0.0, 0.0, 0.0), alarms=None):
        self.sent, self.alarms = [], alarms or {}
        left = list(answers)
        owner = PreparedOwner(lambda question: left.pop(0))
        self.said = owner.said
        sender = SimpleNamespace(status=SimpleNamespace(place=place))
        super().__init__(sender, owner, GuideProgress(folder))
        (folder / "machine.toml").write_text(machine_toml(BELIEVED))

    def move(self, *lines):
        self.sent += lines
        if "G0 Z1" in lines:
            self.sender.status.place = (0.0, 0.0, 1.0)
        return next((why for word, why in self.alarms.items() if word in " ".join(lines)), "")


@pytest.fixture
def numbers(monkeypatch):
    """The numbers that the machine holds."""
    held = {11: 1651.0, 16: 1.0, 29: 1300.0}
    monkeypatch.setattr(guide, "read_numbers", lambda _sender: held)
    return held


PAY_OUT = ["B06 L0 R0", "B02 L1 R0", "B02 L0 R1"]


def test_a_sprocket_turns_as_typed_and_back_until_its_tooth_is_up(tmp_path, numbers):
    visit = Sent(tmp_path, ["12.5", "-40", "40", "0", "-3.25", "0", "y", "y", "y"])
    assert set_chains(visit)
    turns = [("L", 12.5), ("L", -40), ("L", 40), ("R", -3.25)]
    lines = [
        line for chain, size in turns for line in ("G91", f"B09 {chain}{size:.2f} F300", "G90")
    ]
    assert visit.sent == [*lines, *PAY_OUT]
    assert sum("1651 mm of chain" in line for line in visit.said) == 2


def test_an_alarm_while_a_chain_is_paid_out_ends_the_step(tmp_path, numbers):
    visit = Sent(tmp_path, ["0", "0", "y", "y", "y"], alarms={"B02 L1": "Position Lost"})
    assert not set_chains(visit)
    assert visit.said[-1] == "The machine stopped: Position Lost" and visit.sent == PAY_OUT[:2]


@pytest.mark.parametrize(
    "answers", [["0", "0", "n"], ["0", "0", "y", "n"], ["0", "0", "y", "y", "n"]]
)
def test_nothing_is_sent_without_consent(tmp_path, numbers, answers):
    visit = Sent(tmp_path, answers)
    assert not set_chains(visit) and visit.sent == PAY_OUT[: len(answers) - 3]


@pytest.mark.parametrize(
    ("place", "is_there"),
    [
        ((0.5, -0.5, 0.0), True),
        ((0.6, 0.0, 0.0), False),
        ((-0.6, 0.0, 0.0), False),
        ((0.0, 0.6, 0.0), False),
        ((0.0, -0.6, 0.0), False),
        ((0.0, 0.0, 9.0), True),
    ],
)
def test_a_mark_is_made_only_in_the_middle(tmp_path, numbers, place, is_there):
    width, height = BELIEVED.sheet
    visit = Sent(tmp_path, ["y", "y", f"{width / 2}", f"{height / 2}"], place=place)
    assert first_mark(visit) is is_there
    dimple = ["G91", "G1 Z-2 F100", "G0 Z5", "G90"] if is_there else []
    assert visit.sent == ["B15", *dimple]
    said = f"The sled is not in the middle: it reports {place[0]:.2f}, {place[1]:.2f} mm"
    assert (said in visit.said) is not is_there


@pytest.mark.parametrize("answers", [["n"], ["y", "n"]])
def test_no_mark_is_made_without_consent(tmp_path, numbers, answers):
    visit = Sent(tmp_path, answers)
    assert not first_mark(visit) and visit.sent == ["B15"][: len(answers) - 1]


def test_a_sled_on_brackets_is_refused(tmp_path):
    visit = Sent(tmp_path, ["b"])
    kept = visit.path.read_bytes()
    assert not tell_numbers(visit) and "brackets tilt the sled" in visit.said[-1]
    assert visit.sent == [] and visit.path.read_bytes() == kept


@pytest.mark.parametrize(("attached", "axes"), [(1.0, "LRZ"), (0.0, "LR")])
def test_z_is_jogged_only_where_it_has_a_motor(tmp_path, numbers, attached, axes):
    numbers[16] = attached
    visit = Sent(tmp_path, ["y", "s"] * len(axes))
    assert check_wires(visit)
    jogs = [line for line in visit.sent if line.startswith(("B09", "G0", "G1"))]
    assert len(jogs) == 2 * len(axes) and len(visit.sent) == 6 * len(axes)
    assert ("G0 Z1" in visit.sent) is ("G0 Z-1" in visit.sent) is (attached > 0)
    assert ("B09 L-20 F300" in visit.sent) and ("B09 R20 F300" in visit.sent)


def owner_of(*answers):
    left = list(answers)
    return PreparedOwner(lambda question: left.pop(0))


def test_a_damaged_file_is_refused(tmp_path):
    (tmp_path / "guide.json").write_text('{"done": 3}')
    with pytest.raises(InputError, match="damaged"):
        progress_in(tmp_path)


# How well a careful owner knows the frame [mm]: little but the height is open.
SIGMAS = {"motor_height": 10.0, "motor_center_x": 0.1, "motor_gap": 0.1, "rotation_radius": 0.1}


@pytest.mark.parametrize(("off", "is_normal"), [(19.0, True), (21.0, False)])
def test_a_first_mark_twice_as_far_as_expected_is_still_normal(tmp_path, off, is_normal):
    width, height = BELIEVED.sheet
    owner = owner_of(str(width / 2), str(height / 2 + off))
    visit = GuideVisit(None, owner, GuideProgress(tmp_path, [], SIGMAS))
    assert _judge_mark(visit, BELIEVED) is is_normal
    assert ("is normal" in owner.said[-1]) is is_normal


def test_the_guide_calls_normal_what_plumb_reach_does(tmp_path):
    owner = owner_of()
    (tmp_path / "machine.toml").write_text(machine_toml(BELIEVED))
    assert show_reach(GuideVisit(None, owner, GuideProgress(tmp_path, [], SIGMAS)))
    expected = expected_anywhere(BELIEVED, expected_priors(SIGMAS))
    assert owner.said[-1].endswith(expected_sentence(expected, MM))


@pytest.fixture
def path(tmp_path):
    path = tmp_path / "machine.toml"
    path.write_bytes(b"first")
    return path


def names(path):
    return sorted(each.name for each in path.parent.iterdir())


def test_a_replaced_file_is_kept_once(path):
    keep_other(path, b"second")
    keep_other(path, b"second")
    assert names(path) == ["machine-old.toml", "machine.toml"]
    assert path.with_name("machine-old.toml").read_bytes() == b"first" == path.read_bytes()


def test_another_file_that_is_replaced_gets_a_further_name(path):
    keep_other(path, b"second")
    path.write_bytes(b"second")
    keep_other(path, b"third")
    assert path.with_name("machine-old-2.toml").read_bytes() == b"second"
    assert path.with_name("machine-old.toml").read_bytes() == b"first"


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
