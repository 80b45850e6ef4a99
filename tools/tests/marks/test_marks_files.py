"""Marks in marks.toml, marks.csv and the published ini, in mm and inches; several files joined."""

import re
from pathlib import Path

import numpy as np
import plumb
import pytest
from example_machine import ROOT
from plumb.marks.read import Distance, Mark, Measurements, join_measurements, read_marks
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


def read(tmp_path, text, name="marks.toml", sheet=SHEET):
    path = tmp_path / name
    path.write_bytes(text.encode())
    return read_marks(path, sheet=sheet)


@pytest.mark.parametrize("ending", ["\n", "\r\n"])
@pytest.mark.parametrize("start", ["", "\ufeff"])
def test_all_columns_are_read(tmp_path, ending, start):
    measurements = read(tmp_path, start + GOOD.replace("\n", ending), "marks.csv")
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
        read(tmp_path, text, "marks.csv")
    assert str(caught.value).startswith(str(tmp_path))
    assert "\n" not in str(caught.value)


def test_measured_far_but_possible_is_accepted(tmp_path):
    assert len(read(tmp_path, f"{HEADER}\n0,0,300,-250\n", "marks.csv").marks) == 1


CSV = f"{HEADER}\n1,2,3,4\n"
TOML = 'frame = "machine"\n[[mark]]\ntarget = [1, 2]\nmeasured = [3, 4]\n'
INI = (
    "[global]\nnumpositions = 1\n[actual_positions]\nx0 = 1222.2\ny0 = 605.6\n"
    "[target_positions]\ntx0 = 1220.2\nty0 = 607.6\n"
)


@pytest.mark.parametrize("text", [CSV, TOML, INI])
@pytest.mark.parametrize("ending", ["csv", "toml", "ini", "txt"])
def test_content_counts_more_than_a_files_ending(tmp_path, text, ending):
    measurements = read(tmp_path, text, f"marks.{ending}")
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
    with pytest.raises(InputError, match=hint):
        read(tmp_path, text, name)


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


PANEL = (2400.0, 1200.0)
EVERY_KEY = """
frame = "sheet-top-left"
controller = "holey"
tape_sigma_mm = 0.5
sled_weight_n = 110.0
[[mark]]
name = "A"
target = [200, 100]
measured = [201.5, 98]
approach = [1, 2]
chains = [1500.25, 1600]
[[mark]]
name = "A"
target = [200, 100]
measured = [201.0, 98.5]
sled_weight_n = 90
[[mark]]
name = 2
target = [1200.0, 600.0]
[[distance]]
between = ["A", 2]
mm = 1119.5
"""


def test_every_key_is_read(tmp_path):
    measurements = read(tmp_path, EVERY_KEY, sheet=PANEL)
    assert measurements.marks == (
        # x - 1200 and 600 - y; an approach with y down turns round as well.
        Mark("A", (-1000.0, 500.0), (-998.5, 502.0), (1.0, -2.0), 110.0, (1500.25, 1600.0)),
        Mark("A", (-1000.0, 500.0), (-999.0, 501.5), None, 90.0, None),
        Mark("2", (0.0, 0.0), None, None, 110.0, None),
    )
    assert measurements.distances == (Distance(("A", "2"), 1119.5),)
    said = measurements.controller, measurements.tape_sigma, measurements.sled_weight
    assert said == ("holey", 0.5, 110.0)
    assert measurements.repeats == {"A": (0, 1)}
    assert measurements.targets.shape == measurements.measured.shape == (2, 2)
    assert measurements.distance_targets.tolist() == [[[-1000.0, 500.0], [0.0, 0.0]]]
    assert measurements.distance_lengths.tolist() == [1119.5]


def test_distances_alone_are_measurements_too():
    path = Path(__file__).parents[1] / "data" / "madgrizzle_2018-09-02.toml"
    measurements = read_marks(path, sheet=(2438.4, 1219.2))
    assert measurements.measured.shape == (0, 2)
    assert len(measurements.distances) == 16


@pytest.mark.parametrize(
    ("old", "new", "hint"),
    [
        ('frame = "sheet-top-left"', "", "frame is missing"),
        ("sheet-top-left", "top-left", "frame: 'top-left' is not known; .*sheet-top-left, machine"),
        ('"sheet-top-left"', "3", "frame: '3' is not known"),
        ("holey", "grbl", "controller: 'grbl' is not known; .*stock, holey, plumb"),
        ("controller =", "controler =", "unknown name 'controler'; did you mean controller"),
        ("tape_sigma_mm = 0.5", "tape_sigma_mm = 0", "tape_sigma_mm: 0 is out of range"),
        ("sled_weight_n = 110.0", "sled_weight_n = 11.2", "9.81 times kilograms"),
        ("sled_weight_n = 90", "sled_weight_n = 25", "mark A sled_weight_n: .*pounds"),
        ("measured = [201.5, 98]", "mesured = [201.5, 98]", "mark A: unknown name 'mesured'; did "),
        ("measured = [201.5, 98]", "measured = [201.5]", "mark A measured: two numbers"),
        ("measured = [201.5, 98]", 'measured = ["201.5", 98]', "mark A measured: a number is nee"),
        ("approach = [1, 2]", "approach = [0, 0.0]", "not a direction"),
        ("chains = [1500.25, 1600]", "chains = [-1, 1600]", "chains: -1 is out of range"),
        ("target = [1200.0, 600.0]", "", "mark 2: target is missing; write target = ... .a place"),
        ("name = 2", 'name = ""', "the name is empty"),
        ("name = 2", "name = 2.5", "text in quotes"),
        ("name = 2", "name = 3", "there is no mark named '2'"),
        ("[[distance]]", "[distance]", "needs double brackets"),
        ('between = ["A", 2]', 'between = ["A"]', "between: two names"),
        ('between = ["A", 2]', 'between = ["A", "A"]', "named twice"),
        ('between = ["A", 2]', "", "between is missing"),
        ("mm = 1119.5", "feet = 4", "unknown name 'feet'"),
        ("mm = 1119.5", "", "mm or inch is missing"),
        ("mm = 1119.5", "mm = -1", "above zero"),
        ('[[distance]]\nbetween = ["A", 2]\nmm = 1119.5', "", "mark 2: has no measured position"),
        (
            "target = [200, 100]\nmeasured = [201.0",
            "target = [320, 100]\nmeasured = [201.0",
            "mark A: the same name stands twice with targets far apart",
        ),
        ("[[mark]]", "[[mark]", "is not valid TOML"),
    ],
)
def test_bad_toml_files_are_refused_with_the_place(tmp_path, old, new, hint):
    assert old in EVERY_KEY
    with pytest.raises(InputError, match=hint) as caught:
        read(tmp_path, EVERY_KEY.replace(old, new, 1), sheet=PANEL)
    assert str(caught.value).startswith(str(tmp_path))
    assert "\n" not in str(caught.value)


def test_a_file_without_marks_is_refused(tmp_path):
    with pytest.raises(InputError, match="no measured mark"):
        read(tmp_path, 'frame = "machine"\n')


def test_the_example_in_the_docs_can_be_read(tmp_path):
    settings = EXAMPLE.with_name("groundcontrol.ini").read_bytes()
    (tmp_path / "groundcontrol.ini").write_bytes(settings)
    (text,) = re.findall(r"```toml\n(.*?)```", (ROOT / "docs/marks.md").read_text(), re.DOTALL)
    path = tmp_path / "marks.toml"
    path.write_text(text)
    assert read_marks(path, sheet=PANEL).distances


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
def test_bad_published_files_are_refused_with_the_place(tmp_path, old, new, hint):
    path = spoilt(tmp_path, old, new)
    with pytest.raises(InputError, match=hint) as caught:
        read_marks(path, sheet=SHEET)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


MILLIMETRES = """
frame = "sheet-top-left"
[[mark]]
name = "1"
target = [127.0, 127.0]
measured = [130.175, 125.4125]
approach = [0, -40]
chains = [1700.0, 1800.0]
[[mark]]
name = "2"
target = [1270.0, 127.0]
[[distance]]
between = ["1", "2"]
mm = 1144.5875
"""
INCHES = """
frame = "sheet-top-left"
units = "inch"
[[mark]]
name = "1"
target = [5, 5.0]
measured = ["5 1/8", "4 15/16"]
approach = [0, -40]
chains = [1700.0, 1800.0]
[[mark]]
name = "2"
target = [50, 5]
[[distance]]
between = ["1", "2"]
inch = "45 1/16"
"""


def test_a_toml_in_inches_holds_the_same_marks(tmp_path):
    ours, theirs = read(tmp_path, INCHES), read(tmp_path, MILLIMETRES)
    for mark, same in zip(ours.marks, theirs.marks, strict=True):
        assert mark.target == pytest.approx(same.target)
        assert mark.measured == (same.measured and pytest.approx(same.measured))
        assert (mark.approach, mark.chains) == (same.approach, same.chains)
    assert ours.distances[0].length == pytest.approx(theirs.distances[0].length)


@pytest.mark.parametrize(
    ("old", "new", "hint"),
    [
        ('units = "inch"', 'units = "feet"', "units: 'feet' is not known; write one of mm, inch"),
        ("[5, 5.0]", '[5, "5 1/0"]', "mark 1 target: '5 1/0' divides by zero"),
        ("[5, 5.0]", "[5, 0, 5, 0]", "target: two numbers are needed, as [x, y]; is a comma"),
        ('inch = "45 1/16"', "", "mm or inch is missing"),
        ('inch = "45 1/16"', 'inch = "45 1/16"\nmm = 3', "mm or inch is missing"),
        ('inch = "45 1/16"', "inch = -2", "inch: a distance is above zero"),
    ],
)
def test_a_value_that_is_not_a_length_is_named(old, new, hint, tmp_path):
    with pytest.raises(InputError) as refused:
        read(tmp_path, INCHES.replace(old, new))
    assert hint in str(refused.value)


def test_a_csv_may_mix_columns_of_both_units(tmp_path):
    text = (
        "name,target_x_mm,target_y_mm,measured_x_inch,measured_y_in\n"
        "a,127,254,5 1/8,10\nb,-127,0,-5,0.0\n"
    )
    marks = read(tmp_path, text, "marks.csv").marks
    assert marks[0].measured == pytest.approx((130.175, 254.0))
    assert marks[1].measured == pytest.approx((-127.0, 0.0))
    assert marks[0].target == (127.0, 254.0)


def test_fractions_need_no_quotes_and_names_stay_as_they_are(tmp_path):
    bare = INCHES.replace('["5 1/8", "4 15/16"]', "[5 1/8, 4-15/16]").replace(
        'inch = "45 1/16"', "inch = 45 1/16  # once [1/2, 3]"
    )
    windows = bare.replace("  # once [1/2, 3]", "").replace("\n", "\r\n")
    texts = (INCHES, bare, windows, bare.replace('"1"', '"a [1/2, 3]"'))
    quoted, *same, named = (read(tmp_path, text) for text in texts)
    for each in same:
        assert each.marks == quoted.marks and each.distances == quoted.distances
    assert named.marks[0].name == "a [1/2, 3]"
    assert named.marks[0].measured == quoted.marks[0].measured


@pytest.mark.parametrize("place", ["[5 1/8, 4 15/16]", '["5 1/8", "4 15/16"]'])
def test_a_fraction_in_a_file_of_mm_is_refused_with_the_cure(place, tmp_path):
    why = r"mark 1 measured: '5 1/8' is a fraction, .* units = \"in"
    with pytest.raises(InputError, match=why):
        read(tmp_path, MILLIMETRES.replace("[130.175, 125.4125]", place))
