"""expected_error: how far off a job would be, against machines made by chance."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.diagnosis.expected_error import expected_error, model_by, rival_error
from plumb.diagnosis.explanation import Board, explain
from plumb.fit.expected import places_over
from plumb.fit.observations import observe
from plumb.marks.read import Measurements
from plumb.model.predict import lengths, places
from synthetic import BELIEVED, TRUE, grid, marks_on

SIGMA = 0.5


def board_of(seed, *, columns=5, rows=3, noise=SIGMA, sigma=SIGMA):
    marks = marks_on(BELIEVED, BELIEVED, grid(columns, rows), noise=noise, seed=seed)
    return Board.of(BELIEVED, observe(BELIEVED, Measurements(marks)), sigma=sigma)


def errors_with_the_sheet_laid_anew(spots, there):
    """How far places (n, 2) are from spots (n,) [mm], after the best shift and turn of them."""
    middle, centre = spots.mean(axis=0), there.mean(axis=0)
    left, _, right = np.linalg.svd((there - centre).T @ (spots - middle))
    return np.linalg.norm((there - centre) @ (left @ right) - (spots - middle), axis=1)


def test_the_error_of_a_fit_is_the_scatter_of_fits_to_noise():
    spots = places_over(BELIEVED.sheet)
    missed = []
    for seed in range(60):
        fitted = model_by(explain(board_of(seed)))
        # The true machine is BELIEVED: where it goes when the fitted machine aims at the spots.
        where, _ = places(BELIEVED, lengths(fitted, spots)[0])
        missed.append(errors_with_the_sheet_laid_anew(spots, where))
    scattered, said = np.sqrt(np.mean(np.square(missed))), expected_error(explain(board_of(1)))
    # The priors of the frame count as knowledge, though here the frame is exactly as stated.
    assert 0.6 * said < scattered < 1.25 * said


def test_rivals_count_by_their_share_as_far_as_they_lead_elsewhere():
    marks = marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.3)
    board = Board.of(BELIEVED, observe(BELIEVED, Measurements(marks)), sigma=SIGMA)
    frame = explain(board)
    used = explain(board, ("chain_pitch",), start=frame)
    rival = explain(board, ("chain_stretch",), start=frame)
    alone, half, same = (
        expected_error(used, given) for given in ((), [(rival, 0.5)], [(used, 0.5)])
    )
    assert same == pytest.approx(alone)
    spots = places_over(model_by(used).sheet)
    there = places(model_by(rival), lengths(model_by(used), spots)[0])[0]
    apart = errors_with_the_sheet_laid_anew(spots, there)
    assert half**2 - alone**2 == pytest.approx(0.5 * np.mean(apart**2), rel=1e-3)


# By how much, and where, the settings of rivals differ.


def explained(effects):
    """An explanation in which a machine has these sizes, in typical sizes; nothing else is off."""
    board = board_of(1)
    frame = explain(board)
    unknowns = np.zeros(len(frame.unknowns))
    for name, size in effects.items():
        unknowns[board.columns([name])] = size
    at = replace(frame.at, unknowns=unknowns)
    return replace(frame, effects=tuple(effects), at=at)


def test_rivals_differ_by_what_is_left_when_the_sheet_is_laid_anew():
    used, rival = explained({}), explained({"chain_pitch": np.array([2.0, 2.0])})
    difference = rival_error([used, rival], 0.0)
    model, other = model_by(used), model_by(rival)
    spots = places_over(model.sheet)
    there = places(other, lengths(model, spots)[0])[0]
    apart = errors_with_the_sheet_laid_anew(spots, there)
    cells = np.abs(spots) > np.array(model.sheet) / 6
    sides = [
        apart[(np.sign(spots[:, 0]) * cells[:, 0] == x) & (np.sign(spots[:, 1]) * cells[:, 1] == y)]
        for x in (-1, 0, 1)
        for y in (-1, 0, 1)
    ]
    assert difference.mm == pytest.approx(
        max(np.sqrt(np.mean(side**2)) for side in sides), rel=0.02
    )
    assert f"{difference.mm:.1f} mm" in difference.sentence
    assert difference.where in difference.sentence
    assert rival_error([used, rival], difference.mm * 1.01) is None
    assert rival_error([used, rival], difference.mm * 0.99) == difference
