"""The bench for effects: the numbers are those of `plumb add`, and refits are quick."""

import re

import numpy as np
import pytest
from folder import asked, got, with_marks
from plumb.bench.causes import MAKER
from plumb.cure.live_board import BoardView, Chosen, LiveBoard
from plumb.fit.inputs import Inputs
from plumb.fit.problem import Problem
from plumb.marks.read import Mark, Measurements

PITCH = {"effects": ["chain_pitch"]}


@pytest.fixture
def client(tmp_path):
    return with_marks(tmp_path)


def posted(client, path, body, status=200):
    return got(client.post(f"/api/bench/{path}", json=body), status)


def test_the_bench_opens_with_phases_in_degrees_and_possible_sizes(client):
    bench = client.get("/api/bench").json()
    phase = next(each for each in bench["covariates"] if each["name"] == "phase")
    assert phase["unit"] == "°" and 6.3 < max(map(max, phase["values"])) <= 360
    parameters = [each for effect in bench["effects"] for each in effect["parameters"]]
    assert all(each["low"] <= 0 <= each["high"] for each in parameters)


def test_a_size_of_no_fitted_effect_or_of_no_number_cannot_be_held(client):
    refused = posted(client, "fit", {"effects": [], "held": {"chain_pitch.left": 0.1}}, 422)
    assert "chain_pitch.left" in refused["error"]
    posted(client, "fit", {**PITCH, "held": {"chain_pitch.left": "much"}}, 422)


def test_each_effect_shows_the_error_that_it_would_leave(client):
    left = posted(client, "gains", PITCH)
    assert "chain_pitch" not in left and len(left) > 8
    both = {"effects": ["chain_pitch", "tape_scale"]}
    assert left["tape_scale"] == pytest.approx(posted(client, "fit", both)["fit_rms"], abs=1e-3)


def test_another_board_is_not_answered_from_the_old(client, tmp_path):
    before = posted(client, "fit", {"effects": []})["fit_rms"]
    marks = tmp_path / "marks.toml"
    farther = re.sub(
        r"measured = \[(\S+),",
        lambda m: f"measured = [{float(m[1]) + 1},",
        marks.read_text(),
        count=1,
    )
    marks.write_text(farther)
    assert posted(client, "fit", {"effects": []})["fit_rms"] != pytest.approx(before, rel=1e-4)


def test_without_marks_the_bench_says_what_is_missing(tmp_path):
    assert "settings" in asked(tmp_path).get("/api/bench").json()["error"]


def board_of(columns, rows):
    """A board of the usual machine with long chains, a skewed sheet and the noise of a tape."""
    noise = np.random.default_rng(columns)
    across, up = np.linspace(-1100, 1100, columns), np.linspace(-500, 500, rows)
    marks = []
    for i, (x, y) in enumerate((x, y) for y in up for x in across):
        dx, dy = noise.normal(0, 0.4, 2)
        read = (x + 0.001 * y + dx, y - 0.0008 * x + 2e-6 * x * x + dy)
        marks.append(Mark(str(i), (x, y), read, approach=(1.0, 0.0)))
    return LiveBoard(Inputs(MAKER, Measurements(tuple(marks))))


WALK = (
    Chosen(("chain_pitch",)),
    Chosen(("chain_pitch", "frame_flex")),
    Chosen(("chain_pitch", "frame_flex", "sheet_skew")),
    *(
        Chosen(("chain_pitch", "frame_flex", "sheet_skew"), {"chain_pitch.left": left})
        for left in (0.0, 0.0004, 0.0008, 0.0012)
    ),
    Chosen(("chain_pitch", "sheet_skew", "tape_scale", "sled_friction")),
)


def test_a_refit_asks_the_model_only_a_few_times(monkeypatch):
    """The time of a refit is the time of these."""
    board = board_of(27, 15)
    view = BoardView(board)
    asked_at = []
    at = Problem.at
    monkeypatch.setattr(Problem, "at", lambda *given: asked_at.append(1) or at(*given))
    for chosen in WALK:
        asked_at.clear()
        view.chains(board.fit(chosen).errors)
        assert len(asked_at) <= 5, chosen
