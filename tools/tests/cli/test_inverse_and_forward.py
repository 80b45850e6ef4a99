"""plumb inverse and plumb forward: places into chain lengths and back, and what they refuse."""

from pathlib import Path

import numpy as np
import pytest
from plumb.settings.toml import write_machine_toml
from synthetic import TRUE

EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"
SETTINGS = EXAMPLE / "groundcontrol.ini"


def test_inverse_and_forward_of_our_model_undo_each_other(ask, tmp_path):
    machine = tmp_path / "machine.toml"
    write_machine_toml(machine, TRUE)
    code, answer = ask("inverse", machine, "0,0", "1150,-550", "-900,400")
    assert code == 0 and answer["controller"] == "plumb"
    pairs = [f"{left!r},{right!r}" for left, right in answer["lengths"]]
    code, back = ask("forward", machine, *pairs)
    assert code == 0 and back["found"] == ["yes"] * 3
    places = np.array([[0, 0], [1150, -550], [-900, 400]])
    assert np.array(back["places"]) == pytest.approx(places, abs=1e-4)
    _, board = ask("inverse", machine, "0,0", "1150,-550", "-900,400", "--float32")
    away = np.abs(np.array(board["lengths"]) - answer["lengths"])
    assert 0 < away.max() < 0.002  # as the board computes, in float


def test_a_place_out_of_reach_is_null_and_bad_news(ask, run):
    words = ("inverse", SETTINGS, "0,0", "0,5e3", "--controller", "plumb")
    code, answer = ask(*words)
    assert code == 1 and answer["lengths"][1] is None and answer["found"] == ["yes", "out of reach"]
    code, said, _ = run(*words)
    assert code == 1 and said.startswith("1 of 2 places found") and "out of reach" in said


@pytest.mark.parametrize(
    ("words", "hint"),
    [
        (["inverse"], "X,Y"),
        (["inverse", "1;2"], "'1;2' is not X,Y"),
        (["inverse", "0,0", "--float32", "--controller", "stock"], "--float32 is how our board"),
        (["forward", "1,"], "'1,' is not X,Y"),
    ],
)
def test_a_wrong_word_is_named(run, words, hint):
    command, *others = words
    code, said, complaint = run(command, SETTINGS, *others)
    assert code == 2 and said == "" and hint in complaint
