"""fingerprint: what an effect does, and what the refitted frame leaves of it."""

import numpy as np
import pytest
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.sizes import hidden_share
from plumb.diagnosis.suspect_curves import fingerprint_of
from plumb.fit.observations import observe
from plumb.fit.problem import PRIORS
from plumb.marks.read import Measurements
from synthetic import BELIEVED, grid, marks_on

FREE = {name: 1e3 * sigma for name, sigma in PRIORS.items()}  # a frame of which nothing is known


@pytest.fixture(scope="module")
def stretch():
    """The stretch of a machine that has nothing else wrong, on marks all over the sheet."""
    sizes = {"chain_stretch": {"compliance": 5.2e-6}}
    true = BELIEVED.__class__(**{**vars(BELIEVED), "effects": sizes})
    rows = observe(BELIEVED, Measurements(marks_on(true, BELIEVED, grid(9, 5))))
    board = Board.of(BELIEVED, rows, sigma=0.5, priors=FREE)
    return explain(board, ("chain_stretch",), start=explain(board)), explain(board)


def test_alone_it_is_what_the_effect_moves(stretch):
    explanation, _ = stretch
    drawn = fingerprint_of(explanation, "chain_stretch", explanation.board.rows)
    moved = np.hypot(*drawn.alone.T)
    assert len(drawn.places) == 45 and 0.5 < moved.mean() < 5
    assert np.all(drawn.alone[:, 1] < 0)  # longer chains let the sled down
    assert drawn.alone_rms == pytest.approx(np.sqrt(np.mean(moved**2)), rel=0.3)


def test_beyond_it_is_what_the_frame_alone_would_leave(stretch):
    explanation, frame = stretch
    drawn = fingerprint_of(explanation, "chain_stretch", explanation.board.rows)
    assert drawn.beyond_rms == pytest.approx(frame.rms, rel=0.05)
    assert np.sqrt(np.mean(np.sum(drawn.beyond**2, axis=1))) == pytest.approx(frame.rms, rel=0.6)
    share = 1 - (drawn.beyond_rms / drawn.alone_rms) ** 2
    assert share == pytest.approx(hidden_share(frame, "chain_stretch"), abs=0.01)
