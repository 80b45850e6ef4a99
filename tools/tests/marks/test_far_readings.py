"""Readings that no machine can have made, and columns that are exchanged."""

import random
import re

import pytest
from example_machine import ROOT
from plumb.marks.model import Mark, Measurements
from plumb.marks.read import far_reading, read_marks
from plumb.text.errors import InputError

SHEET = (2440.0, 1220.0)
CENTRES = [(-900.0, 400.0), (0.0, 400.0), (900.0, 400.0), (-900.0, -400.0), (900.0, -400.0)]


def marks_of(readings):
    """Marks A, B, ... at the centres, read there."""
    named = zip("ABCDE", CENTRES, readings, strict=True)
    return Measurements(tuple(Mark(name, sent, read) for name, sent, read in named))


def doubts(readings):
    measurements = marks_of(readings)
    by_mark = {mark.name: far_reading(measurements, mark, SHEET) for mark in measurements.marks}
    return {name: (doubt.mistake, doubt.corrected) for name, doubt in by_mark.items() if doubt}


def test_two_exchanged_readings_are_named_with_a_correction():
    a, b, *others = [(x + 3, y - 2) for x, y in CENTRES]
    assert doubts([b, a, *others]) == {
        "A": ("the readings of A and B may be exchanged", a),
        "B": ("the readings of B and A may be exchanged", b),
    }


def test_on_a_sheet_that_was_read_turned_round_no_marks_seem_exchanged():
    said = {words for words, _ in doubts([(-x, y) for x, y in CENTRES]).values()}
    assert said == {"the measured x runs the other way; check the frame"}


@pytest.mark.parametrize(
    ("reading", "mistake", "meant"),
    [
        ((400, 900), "x and y may be exchanged", (900, 400)),
        ((2120, 210), "measured counts from the top-left corner", (900, 400)),
        ((900 / 25.4, 400 / 25.4), "measured looks like inches", (900, 400)),
    ],
)
def test_a_slip_of_the_pen_is_named_with_a_correction(reading, mistake, meant):
    ((said, corrected),) = doubts([*CENTRES[:2], reading, *CENTRES[3:]]).values()
    assert said.startswith(mistake) and corrected == pytest.approx(meant)


def test_a_reading_half_a_metre_off_is_doubted_though_nothing_explains_it():
    assert doubts([*CENTRES[:4], (900, -900.1)]) == {"E": ("", None)}
    assert doubts([*CENTRES[:4], (900, -899.9)]) == {}


def test_a_far_distance_is_refused_with_the_names_of_its_ends(tmp_path):
    path = tmp_path / "marks.toml"
    end = '[[mark]]\nname = "{}"\ntarget = [{}, 0]\nunread = true\n'
    ends = end.format("A", 0) + end.format("B", 508)
    for size, remedy in ((20, "looks like inches"), (300, "check the names and the number")):
        path.write_text(f'frame = "machine"\n{ends}[[distance]]\nbetween = ["A", "B"]\nmm = {size}')
        with pytest.raises(InputError, match=rf"distance A-B: .*508 mm apart; {remedy}"):
            read_marks(path, sheet=SHEET)


MARKS = ROOT / "docs/example/marks.toml"
HEAD = "target_x_mm,target_y_mm,measured_x_mm,measured_y_mm\n"


def board(columns, rows, *, seed=1, step=0.5, error=2.0):
    """Pairs of target and reading of a grid, read to a step of the tape [mm]."""
    chance = random.Random(seed)

    def read(place):
        return round((place + chance.gauss(0, error)) / step) * step

    places = [
        (-1100 + 2200 * i / (columns - 1), -500 + 1000 * j / (rows - 1))
        for i in range(columns)
        for j in range(rows)
    ]
    return [(place, (read(place[0]), read(place[1]))) for place in places]


def csv_of(pairs, path):
    path.write_text(HEAD + "".join(f"{a[0]},{a[1]},{b[0]},{b[1]}\n" for a, b in pairs))
    return path


@pytest.mark.parametrize(("columns", "rows"), [(3, 3), (5, 3), (7, 5)])
@pytest.mark.parametrize("seed", range(5))
def test_exchanged_columns_are_asked_about(columns, rows, seed, tmp_path):
    pairs = board(columns, rows, seed=seed)
    assert len(read_marks(csv_of(pairs, tmp_path / "marks.csv"), sheet=SHEET).marks) == len(pairs)
    turned = csv_of([(read, sent) for sent, read in pairs], tmp_path / "turned.csv")
    with pytest.raises(InputError, match="target and measured exchanged"):
        read_marks(turned, sheet=SHEET)


def exchanged(text):
    return re.sub(
        r"target = (\[.*\])\napproach(.*)\nmeasured = (\[.*\])",
        r"target = \3\napproach\2\nmeasured = \1",
        text,
    )


def test_add_and_diagnose_ask_about_exchanged_columns_too(run, file):
    marks = file("turned.toml", exchanged(MARKS.read_text()))
    settings = MARKS.with_name("groundcontrol.ini")
    for command in (["add", "--effect", "auto"], ["diagnose"], ["compare"], ["next"]):
        code, said, complaint = run(command[0], settings, marks, *command[1:])
        assert code == 2 and said == "" and "exchange" in complaint
    marks = file("steered.toml", "steered = true\n" + exchanged(MARKS.read_text()))
    assert run("compare", settings, marks)[0] == 0
    marks = file("wrong.toml", "steered = 1\n" + MARKS.read_text())
    assert "neither true nor false" in run("compare", settings, marks)[2]


@pytest.mark.parametrize("step", [0.01, 0.5, 1, 5])
@pytest.mark.parametrize("error", [0.0, 0.2, 3.0])
def test_coarse_or_perfect_readings_are_no_reason_to_ask(step, error, tmp_path):
    for seed in range(20):
        pairs = board(5, 3, seed=seed, step=step, error=error)
        assert read_marks(csv_of(pairs, tmp_path / "marks.csv"), sheet=SHEET)
