"""The published Calibration Measurements.ini."""

from pathlib import Path

import plumb
import pytest
from plumb.marks.read import read_marks
from plumb.text.errors import InputError
from synthetic import SHEET

EXAMPLE = Path(plumb.__file__).parent / "examples" / "mibproj" / "Calibration Measurements.ini"


def test_the_example_is_read_into_the_machine_frame():
    measurements = read_marks(EXAMPLE, sheet=SHEET)
    assert [mark.name for mark in measurements.marks] == [str(i) for i in range(9)]
    # Mark 0: 69.2 - 1219.2 and 609.6 - 59.6; measured 67 - 1219.2 and 609.6 - 52.
    assert measurements.targets[0] == pytest.approx([-1150.0, 550.0])
    assert measurements.measured[0] == pytest.approx([-1152.2, 557.6])
    assert measurements.controller is None
    assert measurements.source == str(EXAMPLE)


def spoilt(tmp_path, old, new, name="marks.ini"):
    text = EXAMPLE.read_text()
    assert old in text
    path = tmp_path / name
    path.write_text(text.replace(old, new, 1))
    return path


@pytest.mark.parametrize(
    ("old", "new", "hint"),
    [
        ("numpositions = 9\n", "", "numpositions is missing in .global."),
        ("numpositions = 9", "numpositions = nine", "is not a count"),
        ("numpositions = 9", "numpositions = 8", "x8: is beyond numpositions = 8"),
        ("numpositions = 9", "numpositions = 10", "tx9 is missing"),
        ("x4 = 1216\n", "", "x4 is missing in .actual_positions."),
        ("tx4 = 1219.2\n", "xt4 = 1219.2\n", "tx4 is missing in .target_positions."),
        ("y1 = 45", "y1 = 45 mm", "y1: '45 mm' is not a number"),
        ("y1 = 45", "y1 =", "y1: a number is missing"),
        ("y1 = 45", "x1 = 45", "already on line"),
        ("tx8 = 2369.2", "tx8 = 3369.2", "mark 8: target .* is off the 2438 x 1219 mm sheet"),
    ],
)
def test_bad_files_are_refused_with_the_place(tmp_path, old, new, hint):
    path = spoilt(tmp_path, old, new)
    with pytest.raises(InputError, match=hint) as caught:
        read_marks(path, sheet=SHEET)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)
