"""suspect_curves: what an explanation adds to the frame's fit, in chain."""

from dataclasses import replace

import numpy as np
import pytest
from chain_views import chain_view
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.suspect_curves import (
    suspect_curves,
)
from plumb.fit.observations import observe
from plumb.marks.read import Measurements
from synthetic import BELIEVED, TRUE, grid, marks_on

RUNOUT = {"left_sine": 0.4, "left_cosine": 0.0, "right_sine": 0.0, "right_cosine": 0.0}


def board_of(true, *, marks=None, **how):
    made = marks or marks_on(true, BELIEVED, grid(7, 5), **how)
    return Board.of(BELIEVED, observe(BELIEVED, Measurements(tuple(made))), sigma=0.5)


@pytest.fixture(scope="module")
def stretched():
    """A board of a machine with three effects, its frame fitted, and two of them with it."""
    board = board_of(TRUE, rotation=0.001, noise=0.2)
    frame = explain(board)
    return frame, explain(board, ("chain_pitch", "chain_stretch"), start=frame)


def test_the_suspects_share_and_the_rest_add_up_to_what_the_frame_leaves(stretched):
    frame, both = stretched
    rows = frame.board.rows
    added = suspect_curves(frame, both, rows).chains
    assert np.abs(added).max() > 0.5
    alone, less = (
        chain_view(*problem.values(each.unknowns), rows, problem.settings).chains
        for each in (frame, both)
        for problem in (each.board.problem,)
    )
    assert alone == pytest.approx(added + less, abs=0.02)


def test_a_runout_is_a_wave_against_the_phase_and_nothing_against_the_rest():
    board = board_of(replace(BELIEVED, effects={"sprocket_runout": RUNOUT}))
    frame = explain(board)
    drawn = suspect_curves(frame, explain(board, ("sprocket_runout",), start=frame), board.rows)
    left, right = drawn.curves["phase"]
    assert left.middle == pytest.approx(-0.4 * np.sin(left.at), abs=0.12)
    assert np.abs(right.middle).max() < 0.1
    for name in ("tension", "length", "angle", "wrap", "y"):
        assert np.abs(drawn.curves[name][0].middle).max() < 0.25, name
