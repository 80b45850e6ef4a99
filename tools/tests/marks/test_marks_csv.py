"""marks.csv; choosing the form of a marks file; joining several files."""

import numpy as np
import pytest
from plumb.marks.read import Mark, Measurements, join_measurements, read_marks
from plumb.text.errors import InputError
from synthetic import SHEET

GOOD = """# a comment
name, target_x_mm,target_y_mm,measured_x_mm,measured_y_mm,approach_x,approach_y,sled_weight_n,\
chain_left_mm,chain_right_mm
"A, left",-900,400,-901.5,402,1,0,110,1500,2500

B,0,0,0.5,-0.25,,,,,
# another
,900,-400,901,-401,,,,,
,900,-400,901.5,-401.5,,,,,
"""


def read(tmp_path, text, name="marks.csv"):
    path = tmp_path / name
    path.write_bytes(text.encode())
    return read_marks(path, sheet=SHEET)


@pytest.mark.parametrize("ending", ["\n", "\r\n"])
@pytest.mark.parametrize("start", ["", "\ufeff"])
def test_all_columns_are_read(tmp_path, ending, start):
    measurements = read(tmp_path, start + GOOD.replace("\n", ending))
    assert measurements.marks == (
        Mark("A, left", (-900.0, 400.0), (-901.5, 402.0), (1.0, 0.0), 110.0, (1500.0, 2500.0)),
        Mark("B", (0.0, 0.0), (0.5, -0.25)),
        Mark("3", (900.0, -400.0), (901.0, -401.0)),
        Mark("3", (900.0, -400.0), (901.5, -401.5)),
    )
    assert measurements.repeats == {"3": (2, 3)}


HEADER = "target_x_mm,target_y_mm,measured_x_mm,measured_y_mm"


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("# only\n", "comments only|none of"),
        (f"{HEADER}\n", "no marks below its header"),
        ("1,2,3,4\n", "line 1: the first line does not name the columns"),
        (f"{HEADER.replace(',', ';')}\n1;2;3;4\n", "not separated by commas"),
        (f"{HEADER},{'name,' * 2}x\n", "column name stands twice"),
        (f"{HEADER},nmae\n1,2,3,4,A\n", "line 1: unknown name 'nmae'; did you mean name"),
        ("target_x_mm,target_y_mm,measured_x_mm\n1,2,3\n", "column measured_y_mm is missing"),
        (f"{HEADER}\n1,2,3\n", "line 2: 3 values where the header has 4"),
        (f"{HEADER}\n1,2,3,4,5\n", "line 2: 5 values where the header has 4"),
        (f"{HEADER}\n1,2,,4\n", "line 2, measured_x_mm: a number is missing"),
        (f"{HEADER}\n#x\n1,2,x,4\n", "line 3, measured_x_mm: 'x' is not a number"),
        (f"{HEADER}\n1,2,nan,4\n", "line 2, measured_x_mm: 'nan'"),
        (f'{HEADER}\n1,2,"3,4\n', "line 2: cannot be split|line 2: 3 values"),
        (f"{HEADER},approach_x\n1,2,3,4,1\n", "line 2, approach_y: a number is missing"),
        (f"{HEADER},approach_x,approach_y\n1,2,3,4,0,0\n", "line 2, approach: .0, 0. is not a dir"),
        (f"{HEADER},chain_left_mm,chain_right_mm\n1,2,3,4,5,-6\n", "line 2, chains: -6 is out of"),
        (f"{HEADER}\n900,400,100,100\n", "check the frame"),
        (f"{HEADER}\n36,16,36,16\n-36,16,-36,16\n36,-16,36,-16\n", "looks like inches"),
    ],
)
def test_bad_files_are_refused_with_the_place(tmp_path, text, hint):
    with pytest.raises(InputError, match=hint) as caught:
        read(tmp_path, text)
    assert str(caught.value).startswith(str(tmp_path))
    assert "\n" not in str(caught.value)


def test_measured_far_but_possible_is_accepted(tmp_path):
    assert len(read(tmp_path, f"{HEADER}\n0,0,300,-250\n").marks) == 1


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
