"""The two forms of measurements: marks.toml, and the published Calibration Measurements.ini."""

import re
from pathlib import Path

import plumb
import pytest
from example_machine import ROOT
from plumb.marks.read import Distance, Mark, read_marks
from plumb.text.errors import InputError
from synthetic import SHEET

PANEL = (2400.0, 1200.0)
GOOD = """
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


def read(tmp_path, text):
    path = tmp_path / "marks.toml"
    path.write_text(text)
    return read_marks(path, sheet=PANEL)


def test_every_key_is_read(tmp_path):
    measurements = read(tmp_path, GOOD)
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
def test_bad_files_are_refused_with_the_place(tmp_path, old, new, hint):
    assert old in GOOD
    with pytest.raises(InputError, match=hint) as caught:
        read(tmp_path, GOOD.replace(old, new, 1))
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
