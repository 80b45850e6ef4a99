"""Targets and readings in each other's columns are asked about, and nothing else is."""

import random
import re
from pathlib import Path

import pytest
from plumb.marks.read import read_marks
from plumb.text.errors import InputError

ROOT = Path(__file__).resolve().parents[3]
MARKS = ROOT / "docs/example/marks.toml"
SHEET = (2438.4, 1219.2)
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
