"""A virtual machine and its owner: it cuts as the judge says, and its readings are true."""

from dataclasses import replace
from types import SimpleNamespace

import numpy as np
import pytest
from plumb.bench.boards import MAKER, Hidden, causes_of, plan, size_for
from plumb.grid.options import Grid
from plumb.grid.program import marks_list, program
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
    true_value,
)


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
