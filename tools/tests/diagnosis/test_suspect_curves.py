"""suspect_curves: what an explanation adds to the frame's fit, in chain."""

from dataclasses import replace

import numpy as np
import pytest
from chain_views import chain_view
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.suspect_curves import (
    BINS,
    added_chains,
    model_by,
    suspect_curves,
    visits_all_over,
)
from plumb.fit.covariates import covariates
from plumb.fit.observations import observe
from plumb.marks.read import Mark, Measurements
from plumb.model.plain import ascending
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


def test_what_the_frame_leaves_is_what_the_suspect_adds_and_what_it_leaves(stretched):
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


def test_four_fifths_of_the_places_lie_in_the_shade(stretched):
    frame, both = stretched
    sheet = visits_all_over(model_by(frame), frame.board.rows)
    drawn = added_chains(frame, both, sheet)[:, 0]
    heights = next(each for each in covariates(model_by(frame), sheet) if each.name == "y")
    curve = suspect_curves(frame, both, frame.board.rows).curves["y"][0]
    order = ascending(heights.values[:, 0])
    bins = np.array_split(order, BINS)
    inside = [
        np.mean((drawn[part] >= low) & (drawn[part] <= high))
        for part, low, high in zip(bins, curve.low, curve.high, strict=True)
    ]
    assert inside == pytest.approx([0.8] * BINS, abs=0.03)
    assert curve.middle == pytest.approx([drawn[part].mean() for part in bins])


def test_a_runout_is_a_wave_against_the_phase_and_nothing_against_the_rest():
    board = board_of(replace(BELIEVED, effects={"sprocket_runout": RUNOUT}))
    frame = explain(board)
    drawn = suspect_curves(frame, explain(board, ("sprocket_runout",), start=frame), board.rows)
    left, right = drawn.curves["phase"]
    assert left.middle == pytest.approx(-0.4 * np.sin(left.at), abs=0.12)
    assert np.abs(right.middle).max() < 0.1
    for name in ("tension", "length", "angle", "wrap", "y"):
        assert np.abs(drawn.curves[name][0].middle).max() < 0.25, name


def test_each_place_of_the_sheet_is_visited_as_the_nearest_mark_was():
    up = [
        Mark(str(x), (x, 0.0), (x, 0.0), approach=(0.0, 1.0), sled_weight=weight)
        for x, weight in ((-800.0, 100.0), (0.0, 100.0), (800.0, 150.0), (800.0, 120.0))
    ]
    # Chains that stretch let a heavier sled hang a little lower at the same target.
    rows = observe(TRUE, Measurements(tuple(up)))
    sheet = visits_all_over(TRUE, rows)
    weights = dict(zip(map(tuple, sheet.targets), sheet.sled_weights, strict=True))
    assert {weight for (x, _), weight in weights.items() if x < 300} == {100.0}
    # Marks of the same place take turns.
    for side, up_or_down in ((1, 1), (1, -1), (-1, 1), (-1, -1)):
        quarter = {
            weight
            for (x, y), weight in weights.items()
            if x > 500 and side * (x - 800) > 0 and up_or_down * y > 0
        }
        assert quarter == {150.0, 120.0}
    assert np.all(sheet.approaches == [0.0, 1.0])
    assert len(sheet.targets) == len(sheet.chains) == len(sheet.mark_rows) > 800
