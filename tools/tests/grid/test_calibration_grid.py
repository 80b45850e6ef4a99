"""The programs of `plumb grid`, run by a small interpreter."""

import math
import re
import subprocess
import sys
import tomllib
from collections import Counter, namedtuple
from itertools import pairwise
from pathlib import Path

import plumb.grid as grids
import pytest

SLED = 229.0  # [mm] radius of the largest usual sled, 18 inch across

Move = namedtuple("Move", "code start end feed")  # places [mm], feed [mm/min]

CHOICES = [
    {},
    {"columns": 3, "rows": 3, "repeats": False},
    {"columns": 4, "rows": 2, "depth": 5.0, "feed": 500.0},
    {"columns": 7, "rows": 5, "safe_height": 12.5, "depth": 1.25, "margin": 150.0},
    {"places": ((-900.0, 400.0), (12.3, -400.0)), "repeats": False},
]
GRIDS = [options for options in CHOICES if "places" not in options]


def gcode(machine=None, **options):
    return grids.program(grids.Grid(**options), machine or grids.PlainMachine())


def touches(**options):
    return grids.touches_of(grids.Grid(**options), grids.PlainMachine())


def moves(text):
    """All moves of a program, in mm."""
    place, result, said = {"X": 0.0, "Y": 0.0, "Z": -100.0}, [], []
    for line in text.splitlines():
        words = re.findall(r"([A-Z])(-?[0-9.]+)", re.sub(r"\(.*\)", "", line))
        codes = [letter + number for letter, number in words if letter == "G"]
        numbers = {letter: float(number) for letter, number in words if letter != "G"}
        assert len(codes) <= 1
        if codes in (["G21"], ["G90"]):
            said += codes
        elif codes:
            assert said == ["G21", "G90"]
            feed = numbers.pop("F", None)
            start = tuple(place.values())
            place.update(numbers)
            result.append(Move(codes[0], start, tuple(place.values()), feed))
    return result


def plunges(text):
    return [move for move in moves(text) if move.end[2] < 0]


def lands_at(move, x, y):
    return math.dist(move.end[:2], (x, y)) < 1e-6


@pytest.mark.parametrize("options", GRIDS)
def test_each_mark_is_touched_once_and_each_extreme_mark_once_more_per_repeat(options):
    grid = grids.Grid(**options)
    marks = touches(**options)
    counted = Counter(mark.name for mark in marks)
    assert set(counted) == {str(n + 1) for n in range(grid.columns * grid.rows)}
    again = {name for name, count in counted.items() if count == 1 + grid.repeats}
    corners = (1, grid.columns, grid.columns * (grid.rows - 1) + 1, grid.columns * grid.rows)
    middles = (grid.columns % 2) * 2 + (grid.rows % 2) * 2
    assert {str(corner) for corner in corners} <= again
    if grid.repeats:
        assert len(again) == 4 + middles
        assert all(count == 1 for name, count in counted.items() if name not in again)
    made = plunges(gcode(**options))
    assert len(made) == len(marks)
    assert all(lands_at(move, mark.x, mark.y) for move, mark in zip(made, marks, strict=True))


@pytest.mark.parametrize("options", CHOICES)
def test_marks_are_entered_along_the_approach_and_plunged_straight_down(options):
    grid = grids.Grid(**options)
    made = moves(gcode(**options))
    for before, move in pairwise(made):
        if move.start[:2] != move.end[:2]:
            assert move.start[2] == move.end[2] == grid.safe_height
        if move.end[2] < 0:
            assert (move.code, move.feed) == ("G1", 40) and move.start[:2] == move.end[:2]
            assert (move.start[2], move.end[2]) == (grid.safe_height, -grid.depth)
            way = (before.end[0] - before.start[0], before.end[1] - before.start[1])
            assert way == pytest.approx((0, 40), abs=0.002)
            assert before.code == "G1" and before.feed == grid.feed


@pytest.mark.parametrize("options", CHOICES)
def test_the_program_starts_by_raising_the_bit_and_ends_raised_where_the_sled_hides_no_mark(
    options,
):
    grid = grids.Grid(**options)
    made = moves(gcode(**options))
    assert made[0].start[:2] == made[0].end[:2]
    assert made[0].end[2] == grid.safe_height
    x, y, z = made[-1].end
    assert z == grid.safe_height and y <= 0
    clear = min(math.dist((x, y), (mark.x, mark.y)) for mark in touches(**options))
    assert clear > (SLED if grid.columns < 7 else 190)  # 7 x 5 marks leave no room for a sled


def test_the_sled_rests_near_the_middle_and_never_on_a_mark_though_marks_are_dense():
    def rest(*places):
        return grids.rest_after([grids.Touch("", *place, 0) for place in places])

    assert rest((900, 400), (-900, -400)) == (0, 0)
    assert rest((0, 0), (-900, -400)) == (-250, -100)
    dense = [(x, y) for x in range(-300, 301, 100) for y in range(-300, 301, 100)]
    x, y = rest(*dense)
    assert min(math.dist((x, y), place) for place in dense) == pytest.approx(math.hypot(50, 50))


@pytest.mark.parametrize("options", CHOICES)
def test_every_line_is_one_that_all_firmware_accepts(options):
    text = gcode(**options)
    number = r"-?\d+(\.\d{1,3})?"
    code = rf"G21|G90|G[01]( X{number} Y{number}| Z{number})( F{number})?"
    comment = r"\([A-Za-z0-9 .,:\-]*\)"
    assert text.endswith("\n") and "\r" not in text and text.isascii()
    for line in text.splitlines():
        assert re.fullmatch(f"{code}|{comment}", line), line
        assert len(line) < 60
    assert not re.search(r"-0(?![.\d])", re.sub(r"\(.*\)", "", text))


def test_every_mark_is_announced_just_before_it_is_made():
    marks = touches(columns=3)
    lines = gcode(columns=3).splitlines()
    said = [line for line in lines if line.startswith("(mark")]
    assert said[0] == "(mark 1 at x -1119.2 y 509.6)"
    assert said[-1] == "(mark 1 again at x -1099.2 y 509.6)"
    assert said == [f"({mark} at x {mark.x:.1f} y {mark.y:.1f})" for mark in marks]
    place = lines.index(said[4]) + 2
    assert lines[place] == "G1 X0 Y0 F700"


def test_tensions_agree_with_published_ones():
    def pulls(x, y):
        return grids.tensions(grids.PlainMachine(), x, y)

    # Straight lines between the centres leave out the radius of the sprocket.
    assert pulls(0, 550) == pytest.approx((145, 145), rel=0.03)
    assert pulls(0, 0) == pytest.approx((83, 83), rel=0.03)
    assert pulls(1150, -550) == pytest.approx((20.7, 88.8), rel=0.03)
    assert pulls(-1150, -550) == pytest.approx(pulls(1150, -550)[::-1])


REFUSALS = [
    ("--margin 20", "the lead-in of mark 11 at x -1199.2 y -629.6 is outside the sheet: raise"),
    ("--margin 610", "--margin is 610"),
    ("--margin nan", "--margin: 'nan' is not a length, like 100 or 4in"),
    ("--feed 0", "--feed is 0"),
    ("--depth 25", "--depth is 25"),
    ("--safe-height -5", "--safe-height is -5"),
    *((f"--{name} 3", f"--{name}") for name in ("columns", "repeats", "approach", "mode")),
]
MACHINES = [
    ({"sled_weight_n": 150}, "N on a chain, more than 200: raise --margin, or lighten the sled"),
    ({"motor_offset": 60}, "mark 1 at x -1119.2 y 509.6 puts 216 N on a chain"),
    ({"motor_spacing": 2250}, "N on the right chain, less than 18: raise --margin, or move the"),
    ({"motor_spacing": 2500, "rotation_radius": 500}, "ring and sprocket within"),
    ({"sheet_width": 250}, "repeats reach more than half of the 12 mm to the next column"),
]


@pytest.mark.parametrize("numbers, hint", MACHINES)
def test_a_grid_that_the_machine_cannot_make_is_refused_with_the_reason(numbers, hint):
    with pytest.raises(grids.GridError, match=re.escape(hint)):
        gcode(grids.PlainMachine(**numbers))


def test_the_path_between_two_corners_is_checked_too():
    heavy, corners = grids.PlainMachine(sled_weight_n=136), ((-1100.0, 565.0), (1100.0, 565.0))
    for corner in corners:
        assert gcode(heavy, places=(corner,), repeats=False)
    with pytest.raises(grids.GridError, match="the way to the lead-in of mark 2"):
        gcode(heavy, places=corners, repeats=False)


@pytest.mark.parametrize("words, hint", REFUSALS)
def test_a_bad_request_gets_one_line_exit_code_2_and_no_file(words, hint, tmp_path, run):
    files = ["--output", tmp_path / "grid.nc", "--marks", tmp_path / "marks.toml"]
    code, said, complaint = run("grid", *words.split(), *files)
    assert code == 2
    assert said == ""
    assert complaint.count("\n") == 1 and complaint.endswith("\n")
    assert hint in complaint
    assert list(tmp_path.iterdir()) == []


def test_readings_already_written_are_overwritten_by_force_alone(tmp_path, run):
    readings = tmp_path / "marks.toml"
    readings.write_text("an hour's work")
    words = ("grid", "--marks", readings, "--output", tmp_path / "g.nc")
    code, _, complaint = run(*words)
    assert code == 2 and "exists" in complaint
    assert readings.read_text() == "an hour's work"
    assert list(tmp_path.iterdir()) == [readings]
    assert run(*words, "--force")[0] == 0


def test_the_list_of_marks_holds_every_target_and_approach_in_the_sheet_frame():
    grid, machine = grids.Grid(), grids.PlainMachine()
    listed = tomllib.loads(grids.marks_list(grid, machine))
    assert listed["frame"] == "sheet-top-left"
    made = sorted(grids.touches_of(grid, machine), key=lambda mark: (int(mark.name), mark.visit))
    assert [entry["name"] for entry in listed["mark"]] == [mark.name for mark in made]
    for entry, mark in zip(listed["mark"], made, strict=True):
        assert entry["target"] == pytest.approx([mark.x + 1219.2, 609.6 - mark.y])
        assert entry["approach"] == [0.0, -40.0]
        assert "measured" not in entry


def test_the_tool_writes_a_grid_without_any_installation(tmp_path):
    tool = Path(__file__).resolve().parents[2] / "calibration_grid.py"

    def made(*words):
        command = [sys.executable, "-I", "-S", tool, *words]
        return subprocess.run(command, capture_output=True, text=True)

    whole = grids.program(grids.PRESETS["nine"], grids.PlainMachine())
    assert made("--preset", "nine").stdout == whole
    path = tmp_path / "grid.nc"
    assert made("--preset", "nine", "--output", path).returncode == 0 and path.read_text() == whole
    again = made("--output", path)
    assert again.returncode == 2 and "exists" in again.stderr and path.read_text() == whole
    narrow = made("--margin", "700")
    assert narrow.returncode == 2 and "--margin is 700" in narrow.stderr


def test_only_the_given_places_are_cut_in_their_order(run):
    code, said, _ = run("grid", "--places=-900.5,400 900,420 0,-400")
    assert code == 0 and "(pattern: places, 3 marks with repeats)" in said
    cut = [line for line in said.splitlines() if line.startswith("G1 X")]
    assert cut == ["G1 X-900.5 Y400 F700", "G1 X900 Y420 F700", "G1 X0 Y-400 F700"]
