"""Tests of steps of the guide: lines, answers, alarms, what it accepts, keeps and calls normal."""

from types import SimpleNamespace

import pytest
from plumb import guide
from plumb.fit.compare import expected_anywhere, expected_priors, expected_sentence
from plumb.guide import (
    GuideProgress,
    GuideVisit,
    _judge_mark,
    check_wires,
    first_mark,
    keep_other,
    progress_in,
    set_chains,
    show_reach,
    tell_numbers,
)
from plumb.settings.machine import machine_toml
from plumb.text.errors import InputError
from plumb.text.values import MM
from prepared_owner import PreparedOwner
from synthetic import BELIEVED


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
