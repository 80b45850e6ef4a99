"""A machine's owner: cuts and readings are true; practice on a machine with a secret."""

import json
import signal
from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from plumb.cli.main import main
from plumb.cli.practice import _Reader
from plumb.grid import Grid, marks_list, program
from plumb.hidden import MAKER, Hidden, causes_of, plan, size_for
from plumb.line.sender import Sender
from plumb.marks.form import read_form
from plumb.marks.read import read_marks
from plumb.model.reach import plain_machine
from plumb.plan.case import PlannedCheck
from plumb.vm.garage import (
    BLANK,
    Garage,
    InProcessPort,
    Tape,
    VirtualOwner,
    astray,
    set_up,
    sled_error,
    true_value,
)
from plumb.vm.practice import Secret, score, secret_in
from served_machine import INTERRUPTIBLE, PLUMB, plumb
from systems import ON_POSIX


def hiding(effect: str, millimetres: float = 3.0) -> Hidden:
    cause = causes_of(effect)[0]
    return Hidden(((cause, size_for(cause, plan(5, 5), millimetres)),))


@pytest.mark.parametrize("feed", ["top", "bottom"])
def test_a_machine_without_a_fault_cuts_where_it_should(tmp_path, feed):
    garage = Garage(Hidden(), friction=0.0, settings=replace(MAKER, feed=feed))
    owner = VirtualOwner(garage, noise=0.0)
    set_up(port := InProcessPort(owner.machine), owner.settings)
    path = tmp_path / "marks.toml"
    grid, machine = Grid(columns=2, rows=2, repeats=False), plain_machine(owner.settings)
    Sender(port).stream(program(grid, machine).splitlines())
    path.write_text(owner.tape.fill(marks_list(grid, machine), owner.machine))
    marks = read_marks(path, sheet=MAKER.sheet).marks
    assert {mark.name for mark in marks} == {"1", "2", "3", "4"}
    for mark in marks:
        assert mark.measured == pytest.approx(mark.target, abs=0.12)


def test_the_simulated_owners_readings_are_true_and_no_better_than_a_tapes():
    owner = VirtualOwner(Garage(hiding("chain_pitch"), motor_gap=2981.0))
    (gap,) = owner.check([PlannedCheck("motor_gap", 1.0)])
    assert abs(gap.value - 2981.0) < 4
    assert gap.value != 2981.0
    assert true_value(owner.garage, "chain_pitch.left") > 5e-4
    assert true_value(owner.garage, "chain_stretch.compliance") == 5.17e-6
    assert true_value(owner.garage, "motor_level.height_difference") == 0
    assert true_value(owner.garage, "sled_friction.drag") == owner.garage.friction


def test_an_unexplained_field_moves_marks_by_its_size():
    hidden = Hidden(outside="bump", outside_mm=3.0)
    across, up = np.meshgrid(np.linspace(-1100, 1100, 5), np.linspace(-500, 500, 5))
    places = np.stack([across.ravel(), up.ravel()], axis=1)
    moved = astray(hidden, places, 4)
    assert np.sqrt(np.mean(np.sum(moved**2, axis=1))) == pytest.approx(3.0)
    # A place is moved alike whatever else is asked about.
    assert astray(hidden, places[7:8], 4) == pytest.approx(moved[7:8])
    assert not astray(Hidden(), places, 4).any()
    garage = Garage(hidden, seed=4)
    assert garage.read(places) == pytest.approx(places + moved)


SHEET = (2400.0, 1200.0)
NOISE = 0.4


def form(*marks):
    """A form that waits for marks: name, and target [mm from the top left corner]."""
    lines = ['frame = "sheet-top-left"']
    for name, x, y in marks:
        lines += ["", "[[mark]]", f'name = "{name}"', f"target = [{x:.3f}, {y:.3f}]", BLANK]
    return "\n".join([*lines, ""])


class Sheet:
    """A garage whose holes are off by a number of mm, and its machine."""

    settings = SimpleNamespace(sheet=SHEET)
    height = 5.0

    def __init__(self):
        self.holes = []

    def read(self, places):
        return np.array(places).reshape(-1, 2)

    def cut(self, x, y):
        """Plunge at a place [mm from the top left corner]."""
        place = (x - SHEET[0] / 2, SHEET[1] / 2 - y)
        self.holes += [(len(self.holes), 0.0, *place, 0.5)]

    def cuts(self):
        return self.holes


@pytest.fixture
def sheet():
    return Sheet()


@pytest.fixture
def tape(sheet):
    return Tape(sheet, np.random.default_rng(3), noise=NOISE)


def cut_and_read(tape, sheet, off, *marks):
    for _, x, y in marks:
        sheet.cut(x + off, y)
    return tape.fill(form(*marks), sheet)


def readings(text, tmp_path):
    """Name and place [mm from the top left corner] of each reading of a form."""
    path = tmp_path / "read.toml"
    path.write_text(text)
    each = read_form(path, sheet=SHEET).measurements.readings
    return [(mark.name, x + SHEET[0] / 2, SHEET[1] / 2 - y) for mark, (x, y) in each]


NEAR = ("1", 100.0, 100.0), ("2", 2300.0, 100.0), ("3", 2300.0, 1100.0)


def test_each_mark_is_read_again_with_new_noise(tape, sheet, tmp_path):
    cut_and_read(tape, sheet, 7.0, *NEAR)
    again = readings(tape.fill_again(form(*NEAR * 200)), tmp_path)
    for name, x, y in NEAR:
        read = np.array([place for other, *place in again if other == name])
        assert read.mean(axis=0) == pytest.approx((x + 7.0, y), abs=5 * NOISE / np.sqrt(200))
        assert read[:, 0].std() == pytest.approx(NOISE, rel=0.2)


def test_a_target_cut_in_two_rounds_has_a_name_in_each(tape, sheet, tmp_path):
    cut_and_read(tape, sheet, 9.0, *NEAR)
    cut_and_read(tape, sheet, -6.0, ("1", 100.0, 100.0))
    both = [("1", 100.0, 100.0), ("marks-2:1", 100.0, 100.0)]
    again = readings(tape.fill_again(form(*both, *both)), tmp_path)
    assert [x for _, x, _ in again] == pytest.approx([109, 94, 109, 94], abs=5 * NOISE)


def test_a_mark_that_the_tape_never_read_is_refused_by_name(tape, sheet):
    cut_and_read(tape, sheet, 0.0, *NEAR)
    with pytest.raises(ValueError, match="read no mark 9 on this sheet"):
        tape.fill_again(form(*NEAR, ("9", 1200.0, 600.0)))
    with pytest.raises(ValueError, match="read no mark marks-2:1 on this sheet"):
        tape.fill_again(form(NEAR[0], ("marks-2:1", 100.0, 100.0)))
    tape.lay(sheet, np.random.default_rng(4))
    with pytest.raises(ValueError, match="read no mark 1 on this sheet"):
        tape.fill_again(form(*NEAR))


GRID = ("grid", "--places=-1119,510 1119,510 1119,-510 -1119,-510")


@pytest.fixture
def machine(tmp_path):
    """The machine of the folder game, with seed 7."""
    words = ("practice", "start", "game", "--seed", "7", "--speed", "30")
    program = INTERRUPTIBLE([*PLUMB, *words], cwd=tmp_path)
    while not (tmp_path / "game/port").is_symlink():
        assert program.poll() is None, "no machine"
    yield tmp_path / "game"
    program.send_signal(signal.SIGINT)
    assert program.wait() == 0


@ON_POSIX
def test_a_practice_is_cut_read_and_revealed_with_the_commands_of_a_machine(machine, tmp_path):
    plumb(*GRID, "--output", "game/grid.nc", "--marks", "game/marks.toml", folder=tmp_path)
    plumb("send", "game/grid.nc", "--port", "game/port", folder=tmp_path)
    marks = read_marks(machine / "marks.toml", sheet=MAKER.sheet)
    assert len(marks.measured_marks) == 4
    assert abs(marks.measured - marks.targets).max() > 2
    # What is hidden shows, and nothing says it.
    assert not any("sled_swing" in path.read_text() for path in machine.glob("*.*"))
    inputs = ("game/machine.toml", "game/marks.toml")
    words = ("--effect", "sled_swing", "--client", "none", "-o", "game/new.toml")
    plumb("add", *inputs, *words, folder=tmp_path)
    said = plumb("practice", "reveal", "game", "game/new.toml", folder=tmp_path)
    assert "Hidden was sled_swing" in said and "You found" in said
    again = ("practice", "reveal", "game", "game/new.toml", "--json")
    score = json.loads(plumb(*again, folder=tmp_path))
    assert score["named"] == ["sled_swing"] and not score["missed"] and not score["false"]
    assert score["after_mm"] < 0.5 * score["before_mm"]
    # Settings that were left as they are find nothing.
    assert "You missed" in plumb("practice", "reveal", "game", folder=tmp_path, code=1)


@pytest.mark.parametrize(
    ("words", "complaint"),
    [
        (["reveal", "nowhere"], "holds no secret; begin: plumb practice start nowhere"),
        (["reveal", "broken"], "is not a secret"),
        (["start", "game", "--seed", "2"], "holds a secret already"),
        (["start", "theirs"], "holds a machine.toml"),
        (["start", "game", "--json"], "--json goes with reveal"),
        (["hint", "game"], "give start, reveal"),
    ],
)
def test_refusals(words, complaint, here, capsys):
    for name, text in (("broken", "{}"), ("game", Secret(1).text)):
        (here / name).mkdir()
        (here / name / "practice.json").write_text(text)
    (here / "theirs").mkdir()
    (here / "theirs/machine.toml").write_text("")
    assert main(["practice", *words]) == 2
    assert complaint in capsys.readouterr().err


def test_a_secret_is_drawn_by_its_seed_and_kept(tmp_path):
    secrets = [Secret(seed) for seed in range(20)]
    assert len({secret.garage.hidden.effects for secret in secrets}) >= 4
    for secret in (Secret(3), Secret(4, 5.0, ()), Secret(4, 5.0, ("chain_sag",))):
        (tmp_path / "practice.json").write_text(secret.text)
        assert secret_in(tmp_path) == secret
        assert secret_in(tmp_path).garage.hidden == secret.garage.hidden
    assert secret.garage.hidden.effects == ("chain_sag",)


def test_the_error_over_the_sheet_is_nothing_where_the_settings_are_true():
    assert sled_error(Garage(Hidden()), MAKER) < 0.02
    assert sled_error(Secret(1).garage, MAKER) > 1
    assert score(Secret(1), replace(MAKER, motor_height=100.0)).after_mm is None


def test_the_same_form_again_waits_for_its_marks_to_be_cut_again(tmp_path):
    tape = CountingTape()
    reader = _Reader(tmp_path, tape)
    for _ in range(2):
        (tmp_path / "marks.toml").write_text(f'[[mark]]\nname = "1"\n{BLANK}\n')
        reader.look(machine=None)
        reader.look(machine=None)
    assert tape.passed_over == 2


class CountingTape:
    """A tape that reads at once, and counts the forms for which it left older marks."""

    passed_over = 0

    def pass_over(self, machine):
        self.passed_over += 1

    def fill_when_cut(self, form, machine):
        return form.replace(BLANK, "measured = [1, 2]")
