"""Marks that a tape has read are read again: which hole each name means, and how noisy it is."""

from types import SimpleNamespace

import numpy as np
import pytest
from plumb.marks.form import read_form
from plumb.vm.tape import BLANK, Tape

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
