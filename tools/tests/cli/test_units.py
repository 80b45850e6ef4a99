"""Lengths are taken and shown as they were typed, or in the unit that is asked for."""

import re
from pathlib import Path

import pytest
from example_machine import INI, MARKS
from plumb.cli.arguments import length, place
from plumb.cli.recover import touch
from plumb.marks.read import read_marks
from synthetic import SHEET

INCHES = ("--units", "inch")


def row_of(said, name="1"):
    return next(line.split() for line in said.splitlines() if line.split()[:1] == [name])


def test_places_from_the_corner_are_shown_from_the_corner(run):
    said = run("compare", INI, MARKS, "--details")[1]
    # The file says target = [100.00, 100.00] and measured = [98.0, 106.0], y down.
    assert row_of(said)[1:5] == ["100.0", "100.0", "98.0", "106.0"]
    assert row_of(said)[5:7] == ["-1.98", "+5.99"]
    assert "from the sheet's top left corner, x right, y down" in " ".join(said.split())


def test_values_typed_in_inches_are_shown_in_inches_unless_mm_are_asked_for(run, tmp_path):
    marks = tmp_path / "marks.toml"
    places = [(5, 5), (48, 24), (90, 40)]
    text = "".join(
        f'[[mark]]\ntarget = [{x}, {y}]\nmeasured = ["{x} 1/10", {y}]\n' for x, y in places
    )
    marks.write_text(f'frame = "sheet-top-left"\nunits = "inch"\n{text}')
    assert row_of(run("compare", INI, marks)[1])[1:5] == ["5.00", "5.00", "5.10", "5.00"]
    said = run("compare", INI, marks, "--units", "mm")[1]
    assert row_of(said)[1:5] == ["127.0", "127.0", "129.5", "127.0"]


MILLIMETRES = re.compile(r"[\d.]+ mm\b")


def lengths_shown(said, unit):
    """The sizes that stand before a unit."""
    return [float(size) for size in re.findall(rf"([\d.]+)\s+{unit}\b", said)]


@pytest.mark.parametrize(
    "words",
    [
        ["diagnose", INI, MARKS],
        ["add", INI, MARKS, "--effect", "chain_sag", "sled_swing"],
        ["reach", INI],
        ["next", INI, MARKS],
        ["calibrate", INI, MARKS, "--details"],
    ],
    ids=lambda words: words[0],
)
def test_every_command_speaks_inches_on_request(words, run):
    metric, imperial = (run(*words, "--units", unit)[1] for unit in ("mm", "inch"))
    sizes = lengths_shown(metric, "mm"), lengths_shown(imperial, "inch")
    assert len(sizes[0]) >= len(sizes[1]) > 0
    in_inches = [size / 25.4 for size in sizes[0]]
    for size in sizes[1]:
        assert min(abs(size - each) for each in in_inches) < 0.02 + 0.05 * size  # two digits
    # What stays in mm is drawn by eye: the last 100 mm of a way, and what a plan is read to.
    said = re.sub(r"(to|last) [\d.]+ mm", "", " ".join(imperial.split()))
    assert MILLIMETRES.findall(said) == [] and "metre" not in said and " in mm" not in said


def test_json_and_files_stay_in_mm(ask, run, tmp_path):
    machine = tmp_path / "machine.toml"
    added = ["add", INI, MARKS, "--effect", "sled_swing"]
    _, metric = ask(*added)
    assert ask(*added, "--units", "inch")[1] == metric
    assert run(*added, "--units", "inch", "-o", machine)[0] == 0
    assert "8.91 mm before" in machine.read_text()


def test_feeds_and_places_of_a_job_are_in_inches_on_request(run, tmp_path):
    job = tmp_path / "job.nc"
    job.write_text("G20 G90\nG0 Z0.2\nG0 X2 Y1\nG1 Z-0.1 F10\nG1 X4 F30\nG0 Z0.2\n")
    said = run("check", job, INI, *INCHES)[1]
    assert "asks for 10.0 inch/min and gets 2." in " ".join(said.split()) and "mm" not in said
    assert "asks for 254 mm/min and gets 5" in " ".join(run("check", job, INI)[1].split())
    resume = ("resume", job, INI, "--line", "5", "-o", tmp_path / "rest.nc")
    assert "from X2.000 Y1.000 inch, where" in " ".join(run(*resume, *INCHES)[1].split())
    assert "from X50.80 Y25.40, where" in " ".join(run(*resume, "--force")[1].split())


def test_a_number_that_moved_too_far_is_shown_in_the_chosen_unit(run, tmp_path):
    marks = tmp_path / "marks.csv"
    places = [(x, y) for x in (-1000, 0, 1000) for y in (450, -450)]
    rows = [f"{x},{y},{x * 1.01},{y * 1.01}" for x, y in places]
    marks.write_text("\n".join(["target_x_mm,target_y_mm,measured_x_mm,measured_y_mm", *rows]))
    said = " ".join(run("add", INI, marks, "--effect", "none", *INCHES)[1].split())
    moved = re.search(r"gap between the motors: the marks say ([\d.]+) inch, ([\d.]+) inch", said)
    assert moved and float(moved[2]) > 0.236
    assert abs(float(moved[1]) - 117.26) == pytest.approx(float(moved[2]), abs=0.002)


def test_a_form_in_inches_is_filled_in_inches_and_read(run, here):
    words = ("grid", "--settings", INI, "--preset", "nine", *INCHES, "--output", "grid.nc")
    assert run(*words, "--marks", "marks.toml")[0] == 0
    text = Path("marks.toml").read_text()
    assert "inch from the sheet's top left corner" in text
    text = re.sub(r"^target = (.*)", r"target = \1\nmeasured = \1", text, flags=re.MULTILINE)
    text = text.replace("measured = [3.9370, 3.9370]", "measured = [3 7/8, 4 3/16]")
    Path("marks.toml").write_text(text)
    read = read_marks("marks.toml", sheet=SHEET)
    first = read.marks[0]
    assert first.target == pytest.approx((100 - 1219.2, 609.6 - 100), abs=0.002)
    assert first.measured == pytest.approx((3.875 * 25.4 - 1219.2, 609.6 - 4.1875 * 25.4))
    assert read.typed.unit == "inch"


def test_a_grid_is_the_same_in_inches(run):
    inches = ("--margin=5in", '--depth=1/8"', "--safe-height=1/4in")
    said = run("grid", *inches)
    assert said[0] == 0 and said == run(
        "grid", "--margin=127", "--depth=3.175", "--safe-height=6.35"
    )
    cut = run("grid", "--places=-30-1/2in,4in 0,100")[1]
    assert "G1 X-774.7 Y101.6 F700" in cut and "G1 X0 Y100 F700" in cut


def test_places_and_lengths_of_a_command_are_the_same_in_inches():
    assert place("4in,-2 1/2in") == pytest.approx((101.6, -63.5))
    assert length('1/32"') == pytest.approx(0.79375)
    hole, shown = touch("-36in,10in:-35 7/8in,254")
    assert hole == pytest.approx((-914.4, 254)) and shown == pytest.approx((-911.225, 254))
