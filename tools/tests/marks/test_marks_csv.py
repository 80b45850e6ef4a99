"""marks.csv."""

import pytest
from plumb.marks.read import Mark, read_marks
from plumb.text.errors import InputError

SHEET = (2438.4, 1219.2)
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
        (
            f"{HEADER},approach_x,approach_y\n1,2,3,4,0,0\n",
            "line 2, approach: .0, 0. is not a direction",
        ),
        (
            f"{HEADER},chain_left_mm,chain_right_mm\n1,2,3,4,5,-6\n",
            "line 2, chains: -6 is out of range",
        ),
        (f"{HEADER}\n900,400,100,100\n", "check the frame"),
    ],
)
def test_bad_files_are_refused_with_the_place(tmp_path, text, hint):
    with pytest.raises(InputError, match=hint) as caught:
        read(tmp_path, text)
    assert str(caught.value).startswith(str(tmp_path))
    assert "\n" not in str(caught.value)


def test_measured_far_but_possible_is_accepted(tmp_path):
    assert len(read(tmp_path, f"{HEADER}\n0,0,300,-250\n").marks) == 1
