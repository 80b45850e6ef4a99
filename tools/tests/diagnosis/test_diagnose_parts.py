"""The parts of a diagnosis, each against a number from elsewhere."""

import numpy as np
import pytest
from chain_views import chain_view
from plumb.diagnosis.diagnosis import hidden_share, sizes_of
from plumb.diagnosis.evidence import KNOWN, Noise
from plumb.diagnosis.expected_error import drawn_by
from plumb.diagnosis.explanation import Board, explain
from plumb.fit.expected import plausible_range
from plumb.fit.fit import fit
from plumb.fit.observations import observe
from plumb.marks.read import Measurements
from plumb.model.catalogue import effect_names
from synthetic import BELIEVED, TRUE, grid, marks_on

STATED = Noise(0.5, KNOWN, "stated")


def rows_of(*, noise=0.5, seed=1, columns=5, rows=3, true=TRUE):
    marks = marks_on(true, BELIEVED, grid(columns, rows), noise=noise, seed=seed)
    return observe(BELIEVED, Measurements(marks))


def board_of(**options):
    return Board.of(BELIEVED, rows_of(**options), sigma=0.5)


@pytest.mark.parametrize(
    "effects", [(), ("chain_pitch",), ("chain_sag", "chain_stretch"), ("tape_scale",)]
)
def test_an_explanation_is_the_fit_of_plumb_add(effects):
    rows = rows_of()
    ours = explain(Board.of(BELIEVED, rows, sigma=0.5), effects)
    theirs = fit(BELIEVED, rows, effects=effects, sigma=0.5)
    assert ours.settled and ours.rms == pytest.approx(theirs.rms, abs=1e-4)
    sizes = [size for name in effects for size in sizes_of(ours, name, STATED)]
    wanted = theirs.estimates[len(theirs.estimates) - len(sizes) :]
    for size, estimate in zip(sizes, wanted, strict=True):
        width = estimate.high - estimate.low
        assert size.value == pytest.approx(estimate.value, abs=1e-3 * width)
        assert size.high == pytest.approx(estimate.high, abs=1e-3 * width)
        # An interval ends where no machine can be, unless the size lies beyond.
        least = 0.0 if min(plausible_range(estimate.name).low, size.value) >= 0 else -np.inf
        assert size.low == pytest.approx(max(estimate.low, least), abs=1e-3 * width)


def test_the_frame_swallows_what_it_can():
    frame = explain(board_of(columns=5, rows=5))
    shares = {name: hidden_share(frame, name) for name in effect_names()}
    assert shares["sled_friction"] is None  # no mark has an approach
    assert shares["sprocket_runout"] < 0.2 < shares["motor_level"]
    assert shares["frame_flex"] > 0.8 and shares["chain_stretch"] > 0.5


def board_made_by(true, *, marks=None, **how):
    made = marks or marks_on(true, BELIEVED, grid(7, 5), **how)
    return Board.of(BELIEVED, observe(BELIEVED, Measurements(tuple(made))), sigma=0.5)


@pytest.fixture(scope="module")
def stretched():
    """A board of a machine with three effects, its frame fitted, and two of them with it."""
    board = board_made_by(TRUE, rotation=0.001, noise=0.2)
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
