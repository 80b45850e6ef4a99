"""`plumb diagnose`: what it prints, and its exit codes."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from published_marks import MARKS, SETTINGS
from synthetic import BELIEVED, TRUE, csv_of, grid, marks_on


def test_clean_marks_are_called_clean(run, file, maker):
    clean = marks_on(BELIEVED, BELIEVED, grid(5, 3), noise=0.5, seed=4)
    words = ("diagnose", maker, file("clean.csv", csv_of(clean)), "--sigma", "0.5")
    code, said, _ = run(*words)
    assert code == 0 and said.startswith("The machine is as good as")
    said = run(*words, "--details")[1]
    assert "may act too" in said and "these marks say nothing of a sled that rubs" in said


def test_a_slip_is_bad_news(run, ask, file, maker):
    marks = list(marks_on(BELIEVED, BELIEVED, grid(5, 3), noise=0.3, seed=4))
    marks[7] = replace(marks[7], measured=tuple(np.add(marks[7].measured, (5.1, 0.0))))
    path = file("slip.csv", csv_of(marks))
    code, said, _ = run("diagnose", maker, path, "--sigma", "0.3")
    assert code == 1 and "One reading disagrees with every explanation" in said
    assert "off to the right" in said
    code, answer = ask("diagnose", maker, path, "--sigma", "0.3")
    assert code == 1 and answer["suspects"] == [] and answer["slips"][0]["name"] == "7"
    assert np.hypot(*answer["slips"][0]["offset_mm"]) == pytest.approx(5.1, abs=1.2)


def test_suspects_come_with_size_and_remedy(run, ask, file, maker):
    path = file("m.csv", csv_of(marks_on(TRUE, BELIEVED, grid(5, 5), noise=0.2, seed=1)))
    code, said, _ = run("diagnose", maker, path, "--sigma", "0.2", "--details")
    assert code == 0 and "To be sure" in said and "over 100 to 1" in said
    code, answer = ask("diagnose", maker, path, "--sigma", "0.2")
    assert answer["sigma_mm"] == 0.2 and answer["sigma_from"] == "stated"
    assert set(answer["suspects"]) >= {"chain_pitch", "chain_sag"}


ROOT = Path(__file__).resolve().parents[3]
BOARDS = {
    "the example": ("docs/example/groundcontrol.ini", "docs/example/marks.toml"),
    "nine marks": (SETTINGS, MARKS),
}


@pytest.mark.parametrize("board", BOARDS)
def test_each_size_lies_in_its_interval(ask, board):
    """Also a size that no real machine has, such as a sag below zero."""
    _, answer = ask("diagnose", *(ROOT / name for name in BOARDS[board]))
    sizes = [size for each in answer["ranking"] for size in each["parameters"]]
    assert sizes
    for size in sizes:
        if size["low"] is not None:
            assert size["low"] <= size["value"] <= size["high"], size
