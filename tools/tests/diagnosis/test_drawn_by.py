"""drawn_by: what an explanation adds to the frame's fit, in chain."""

import numpy as np
import pytest
from chain_views import chain_view
from plumb.diagnosis.drawn import drawn_by
from plumb.diagnosis.explanation import Board, explain
from plumb.fit.observations import observe
from plumb.marks.read import Measurements
from synthetic import BELIEVED, TRUE, grid, marks_on


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
    added = drawn_by(frame, both, rows).chains
    assert np.abs(added).max() > 0.5
    alone, less = (
        chain_view(*problem.values(each.unknowns), rows, problem.settings).chains
        for each in (frame, both)
        for problem in (each.board.problem,)
    )
    assert alone == pytest.approx(added + less, abs=0.02)
