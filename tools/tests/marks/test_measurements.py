"""Choosing the form of a marks file, and joining several files."""

import numpy as np
import pytest
from plumb.marks.read import Mark, Measurements, join_measurements, read_marks
from plumb.text.errors import InputError

SHEET = (2438.4, 1219.2)
CSV = "target_x_mm,target_y_mm,measured_x_mm,measured_y_mm\n1,2,3,4\n"
TOML = 'frame = "machine"\n[[mark]]\ntarget = [1, 2]\nmeasured = [3, 4]\n'
INI = (
    "[global]\nnumpositions = 1\n[actual_positions]\nx0 = 1222.2\ny0 = 605.6\n"
    "[target_positions]\ntx0 = 1220.2\nty0 = 607.6\n"
)


@pytest.mark.parametrize("text", [CSV, TOML, INI])
@pytest.mark.parametrize("ending", ["csv", "toml", "ini", "txt"])
def test_content_counts_more_than_a_files_ending(tmp_path, text, ending):
    path = tmp_path / f"marks.{ending}"
    path.write_text(text)
    measurements = read_marks(path, sheet=SHEET)
    assert np.allclose(measurements.targets, [[1, 2]])
    assert np.allclose(measurements.measured, [[3, 4]])


@pytest.mark.parametrize(
    ("name", "text", "hint"),
    [
        ("groundcontrol.ini", "[Maslow Settings]\nmotorspacingx = 3000\n", "holds settings"),
        ("notes.txt", "hello\n", "none of the known forms"),
        ("marks.csv", "", "empty"),
        ("marks.ini", "hello\n", "is not key = value"),
    ],
)
def test_other_files_are_refused(tmp_path, name, text, hint):
    path = tmp_path / name
    path.write_text(text)
    with pytest.raises(InputError, match=hint):
        read_marks(path, sheet=SHEET)


A = Mark("A", (0.0, 0.0), (1.0, 1.0), sled_weight=98.0)


def test_the_same_name_and_target_is_a_repeat():
    first = Measurements((A,), controller="stock", sled_weight=98.0, source="one.toml")
    second = Measurements((A,), tape_sigma=0.5, sled_weight=120.0, source="two.toml")
    both = join_measurements([first, second])
    assert both.repeats == {"A": (0, 1)}
    assert (both.controller, both.tape_sigma, both.sled_weight) == ("stock", 0.5, None)
    assert both.source == "one.toml + two.toml"


def test_contradictions_between_files_are_refused():
    first = Measurements((A,), controller="stock", source="one.toml")
    second = Measurements((A,), controller="holey", source="two.toml")
    with pytest.raises(InputError, match=r"two\.toml: controller is holey here and stock in one"):
        join_measurements([first, second])
