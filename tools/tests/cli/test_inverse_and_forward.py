"""plumb inverse and plumb forward: places into chain lengths and back, and what they refuse."""

from pathlib import Path

import numpy as np
import pytest
from plumb.settings.toml import write_machine_toml
from synthetic import TRUE

EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"
SETTINGS = EXAMPLE / "groundcontrol.ini"


def test_inverse_and_forward_of_our_model_undo_each_other(ask, file, tmp_path):
    machine = tmp_path / "machine.toml"
    write_machine_toml(machine, TRUE)
    code, answer = ask("inverse", machine, "0,0", "1150,-550", "-900,400")
    assert code == 0 and answer["controller"] == "plumb"
    pairs = "\n".join(f"{left!r},{right!r}" for left, right in answer["lengths"])
    chains = file("chains.csv", f"left,right\n{pairs}\n")
    code, back = ask("forward", machine, "--lengths", chains)
    assert code == 0 and back["found"] == ["yes"] * 3
    places = np.array([[0, 0], [1150, -550], [-900, 400]])
    assert np.array(back["places"]) == pytest.approx(places, abs=1e-4)
    _, board = ask("inverse", machine, "0,0", "1150,-550", "-900,400", "--float32")
    away = np.abs(np.array(board["lengths"]) - answer["lengths"])
    assert 0 < away.max() < 0.002  # as the board computes, in float


def test_a_place_out_of_reach_is_null_and_bad_news(ask, run, file):
    points = file("points.csv", "\ufeff# two places\n X_mm , y [mm]\n\n 0 , 0 \r\n0,5e3\n")
    words = ("inverse", SETTINGS, "--points", points, "--controller", "plumb")
    code, answer = ask(*words)
    assert code == 1 and answer["lengths"][1] is None and answer["found"] == ["yes", "out of reach"]
    code, said, _ = run(*words)
    assert code == 1 and said.startswith("1 of 2 places found") and "out of reach" in said


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("x,y\n", "has no numbers"),
        ("1;2\n", "line 1: has 1 value instead of 2; write x,y on each line"),
        ("y,x\n1,2\n", "line 1: the header is 'y,x'; write x,y on each line, in mm"),
        ("x_inch,y_inch\n1,2\n", "the header is 'x_inch,y_inch'"),
        ("0,0\n1,near\n", "line 2, y"),
    ],
)
def test_points_that_cannot_be_used_are_named_with_file_and_line(text, hint, run, file):
    path = file("points.csv", text)
    code, said, complaint = run("inverse", SETTINGS, "--points", path)
    assert code == 2 and said == "" and complaint.count("\n") == 1
    assert complaint.startswith(f"plumb: {path}") and hint in complaint


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        (["inverse"], "say which places: X,Y one after the other, or --points FILE"),
        (["inverse", "1;2"], "'1;2' is not X,Y"),
        (["inverse", "0,0", "--float32", "--controller", "stock"], "--float32 is how our board"),
        (["forward", "--lengths", "none.csv"], "none.csv: there is no"),
    ],
)
def test_a_wrong_word_is_named(run, words, hint):
    command, *others = words
    code, said, complaint = run(command, SETTINGS, *others)
    assert code == 2 and said == "" and hint in complaint
