"""`tools/calibration_grid.py`: marks at given places, and forms that wait for distances."""

import re
import tomllib

import pytest
from plumb.grid import main


def run(words, capsys):
    """Exit code, screen and complaint of the tool."""
    code = main(words)
    said = capsys.readouterr()
    return code, said.out, said.err


def test_places_are_cut_in_their_order_and_nothing_else(capsys):
    code, said, _ = run(["--places=-900.5,400 900,420 0,-400"], capsys)
    assert code == 0 and "(pattern: places, 3 marks with repeats)" in said
    cut = [line for line in said.splitlines() if line.startswith("G1 X")]
    assert cut == ["G1 X-900.5 Y400 F700", "G1 X900 Y420 F700", "G1 X0 Y-400 F700"]


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        (["--places=0,0 0,700"], "mark 2 at x 0.0 y 660.0 is outside the sheet"),
        (["--places=0,0", "--columns", "3"], "--columns is of a grid"),
        (["--places=0,0", "--pattern", "benchmark"], "--pattern is of a grid"),
    ],
)
def test_places_that_cannot_be_are_refused(words, hint, capsys):
    code, said, complaint = run(words, capsys)
    assert code == 2 and said == "" and hint in complaint


def test_a_form_waits_for_sides_diagonals_and_halves(tmp_path, capsys):
    def spans(*words):
        form, cut = tmp_path / "form.toml", tmp_path / "cut.nc"
        to = ["--marks", str(form), "--output", str(cut), "--force", "--distances"]
        code, _, complaint = run([*words, *to], capsys)
        assert code == 0, complaint
        listed = tomllib.loads(re.sub(r"^# (?=\[\[dist|between)", "", form.read_text(), flags=re.M))
        return [tuple(each["between"]) for each in listed["distance"]]

    assert len(spans("--columns", "3", "--rows", "3")) == 12
    assert spans("--columns", "4", "--rows", "2", "--repeats", "0") == [
        *[("1", "4"), ("4", "8"), ("8", "5"), ("5", "1")],
        *[("1", "8"), ("4", "5")],
    ]
    five = spans("--columns", "5", "--rows", "3")
    assert five[6:] == [("3", "13"), ("6", "10"), ("1", "3"), ("6", "8"), ("8", "10"), ("3", "8")]
    code, _, complaint = run(["--places=0,0", "--distances", "--marks", "no.toml"], capsys)
    assert code == 2 and "--distances is for marks in columns and rows" in complaint
