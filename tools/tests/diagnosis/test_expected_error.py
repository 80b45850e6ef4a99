"""expected_error: how far off a job would be, against machines made by chance."""

import numpy as np
import pytest
from plumb.diagnosis.expected_error import expected_error
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.suspect_curves import model_by
from plumb.fit.observations import observe
from plumb.marks.read import Measurements
from plumb.model.predict import lengths, places
from synthetic import BELIEVED, TRUE, grid, marks_on

SIGMA = 0.5


def board_of(seed, *, columns=5, rows=3, noise=SIGMA, sigma=SIGMA):
    marks = marks_on(BELIEVED, BELIEVED, grid(columns, rows), noise=noise, seed=seed)
    return Board.of(BELIEVED, observe(BELIEVED, Measurements(marks)), sigma=sigma)


def test_it_is_what_fits_to_noise_alone_scatter_by():
    expected = expected_error(explain(board_of(1)))
    spots = np.stack(np.meshgrid(expected.x[::10], expected.y[::10]), axis=-1).reshape(-1, 2)
    missed = []
    for seed in range(60):
        fitted = model_by(explain(board_of(seed)))
        # The true machine is BELIEVED: where it goes when the fitted machine aims at the spots.
        where, _ = places(BELIEVED, lengths(fitted, spots)[0])
        missed.append(np.sum((where - spots) ** 2, axis=1))
    scattered = np.sqrt(np.mean(missed, axis=0))
    said = expected.sigma[::10, ::10].ravel()
    # The priors of the frame count as knowledge, though here the frame is exactly as stated.
    assert np.all(scattered < 1.25 * said)
    assert np.sqrt(np.mean(scattered**2)) > 0.6 * np.sqrt(np.mean(said**2))


def test_more_marks_and_better_readings_leave_less():
    few, many = (expected_error(explain(board_of(1, columns=n, rows=n))) for n in (3, 7))
    fine = expected_error(explain(board_of(1, columns=3, rows=3, noise=0.1, sigma=0.1)))
    assert few.rms > 1.5 * many.rms and few.rms > 1.5 * fine.rms
    assert few.worst >= few.rms > 0


def test_rivals_count_by_their_share_as_far_as_they_lead_elsewhere():
    marks = marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.3)
    board = Board.of(BELIEVED, observe(BELIEVED, Measurements(marks)), sigma=SIGMA)
    frame = explain(board)
    used = explain(board, ("chain_pitch",), start=frame)
    rival = explain(board, ("chain_stretch",), start=frame)
    alone, half, same = (
        expected_error(used, given) for given in ((), [(rival, 0.5)], [(used, 0.5)])
    )
    assert same.sigma == pytest.approx(alone.sigma)
    middle = (len(alone.y) // 2, len(alone.x) // 2)
    chains, _ = lengths(model_by(used), [[0.0, 0.0]])
    apart = places(model_by(rival), chains)[0][0]
    assert half.sigma[middle] ** 2 - alone.sigma[middle] ** 2 == pytest.approx(
        0.5 * np.sum(apart**2), rel=1e-3
    )


def test_the_grid_covers_the_sheet_from_the_top_down():
    expected = expected_error(explain(board_of(1)))
    assert expected.y[0] == pytest.approx(BELIEVED.sheet_height / 2)
    assert expected.x[-1] == pytest.approx(BELIEVED.sheet_width / 2)
    assert expected.sigma.shape == (len(expected.y), len(expected.x))
    # Marks settle the middle better than the corners.
    assert expected.sigma[10, 20] < expected.sigma[0, 0]
