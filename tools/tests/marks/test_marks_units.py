"""Marks in inches are the same marks: toml and csv."""

import pytest
from plumb.marks.read import read_marks
from plumb.text.errors import InputError
from synthetic import SHEET

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


def read(tmp_path, text, name="marks.toml"):
    path = tmp_path / name
    path.write_text(text)
    return read_marks(path, sheet=SHEET)


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
    path = tmp_path / "marks.toml"
    bare = INCHES.replace('["5 1/8", "4 15/16"]', "[5 1/8, 4-15/16]").replace(
        'inch = "45 1/16"', "inch = 45 1/16  # once [1/2, 3]"
    )
    windows = bare.replace("  # once [1/2, 3]", "").replace("\n", "\r\n")
    read = []
    for text in (INCHES, bare, bare.replace('"1"', '"a [1/2, 3]"'), windows):
        path.write_bytes(text.encode())
        read.append(read_marks(path, sheet=SHEET))
    assert read[0].marks == read[1].marks == read[3].marks
    assert read[0].distances == read[1].distances == read[3].distances
    assert read[2].marks[0].name == "a [1/2, 3]"
    assert read[2].marks[0].measured == read[0].marks[0].measured


@pytest.mark.parametrize("place", ["[5 1/8, 4 15/16]", '["5 1/8", "4 15/16"]'])
def test_a_fraction_in_a_file_of_mm_is_refused_with_the_cure(place, tmp_path):
    path = tmp_path / "marks.toml"
    path.write_text(MILLIMETRES.replace("[130.175, 125.4125]", place))
    with pytest.raises(
        InputError, match=r"mark 1 measured: '5 1/8' is a fraction, .* units = \"in"
    ):
        read_marks(path, sheet=SHEET)
