"""Evidence against the same worked out with full covariances, and orthants against integrals."""

from dataclasses import replace

import numpy as np
import pytest
import scipy.special
import scipy.stats
from boards import PUBLISHED, cut
from linear_boards import covariance_of
from plumb.diagnosis.evidence import (
    UNLIKELY,
    LinearBoard,
    Metric,
    Noises,
    accounts_of,
    felt_effects,
    fitted,
    outlier_weights,
    smooth_fields,
)
from plumb.diagnosis.explanation import explain, measured_board
from plumb.diagnosis.priors import OUTLIER_SPREADS, PITCH_CORRELATION, PITCH_SPREAD, size_priors
from plumb.fit.inputs import Inputs
from plumb.hidden import Hidden, causes_of, plan

SIGMA = 0.6
LIKELIEST = 5  # accounts of each part that are worked out by force
FRAME = explain(
    measured_board(
        Inputs(
            PUBLISHED,
            cut(Hidden(((causes_of("sled_swing")[0], 2.0),)), plan(3, 3), seed=4).measurements,
        )
    )
)
BOARD = LinearBoard.of(FRAME, felt_effects(FRAME))
ACCOUNTS = accounts_of(BOARD, 2)
READ = BOARD.read[:, 0]
FIELD = smooth_fields(FRAME, SIGMA)[4]


def covariance(*, off=(), spread=0.0, **more):
    """Of the readings with noise, frame and one other thing."""
    whole = covariance_of(BOARD, SIGMA, **more)
    for row in off:
        whole[row, row] += spread**2
    return whole


def by_force(index, variance, **more):
    """Log density of the readings but for 2 pi, and the log ratio of the masses of its signs."""
    drawn, without = BOARD.effects[:, index], covariance(**more)
    whole = without + drawn @ np.diag(variance) @ drawn.T
    density = -(np.linalg.slogdet(whole)[1] + READ @ np.linalg.solve(whole, READ)) / 2
    solved = np.linalg.solve(without, np.c_[drawn, READ])
    after = np.linalg.inv(drawn.T @ solved[:, :-1] + np.diag(1 / variance))
    mean = after @ drawn.T @ solved[:, -1]
    edge = (BOARD.sizes.mean - BOARD.sizes.least)[index]
    held = np.isfinite(edge)
    before = scipy.special.log_ndtr(edge[held] / np.sqrt(variance[held])).sum()
    normal = scipy.stats.multivariate_normal(
        -(mean + edge)[held], after[np.ix_(held, held)], maxpts=20_000, abseps=1e-5, seed=1
    )
    return density, np.log(normal.cdf(np.zeros(held.sum()))) - before


@pytest.mark.parametrize(
    "more", [{}, {"pitch": True}, {"other": FIELD}], ids=["nothing", "pitch", "field"]
)
def test_the_evidence_of_sets_is_the_density_of_the_readings(more):
    metric = Metric.of(BOARD, np.array([SIGMA]), more.get("other"), pitch=more.get("pitch", False))
    for part in ACCOUNTS.parts:
        fit = fitted(part, metric)
        # Impossible signs are weighed only for what is likely.
        likely = np.flatnonzero(fit.evidence[0] > fit.evidence[0].max() - UNLIKELY + 1)
        for place in likely[np.argsort(-fit.evidence[0, likely])[:LIKELIEST]]:
            density, signs = by_force(part.index[place], part.variance[place], **more)
            assert fit.loose[0, place] - part.log_prior[place] == pytest.approx(density, abs=1e-6)
            assert fit.possible[0, place] == pytest.approx(signs, abs=0.1)


def test_pitches_of_both_chains_are_as_alike_as_chains_of_a_reel():
    """By the covariance of the two: sum and difference, as the board has them, draw the same."""
    columns = FRAME.board.columns(["chain_pitch"])
    inside = FRAME.slopes[: BOARD.measured, columns] * FRAME.board.sigma
    turned, sizes = BOARD.columns["chain_pitch"], BOARD.sizes
    drawn = BOARD.effects[: BOARD.measured, turned]
    for spread, largest in ((sizes.typical, 1.0), (sizes.largest, 6.0)):
        alike = largest**2 * np.array([[1.0, PITCH_CORRELATION], [PITCH_CORRELATION, 1.0]])
        whole = drawn @ np.diag(spread[turned] ** 2) @ drawn.T
        assert whole == pytest.approx(inside @ alike @ inside.T, rel=1e-9, abs=1e-12)
    by_itself = (PITCH_SPREAD / 0.001) ** 2 * np.eye(2)
    usual = drawn @ np.diag(sizes.pitch[turned] ** 2) @ drawn.T
    assert usual == pytest.approx(inside @ by_itself @ inside.T, rel=1e-9, abs=1e-12)


@pytest.mark.parametrize("known", [("left", "right"), ("left",)])
def test_settings_that_have_a_pitch_have_no_usual_drift(known):
    settings = replace(PUBLISHED, effects={"chain_pitch": dict.fromkeys(known, 0.001)})
    marks = cut(Hidden(((causes_of("sled_swing")[0], 2.0),)), plan(3, 3), seed=4).measurements
    board = measured_board(Inputs(settings, marks))
    assert not size_priors(board, board.columns(["chain_pitch"])).pitch.any()


def test_the_evidence_of_a_reading_that_is_off_is_that_of_a_shift_of_its_rows():
    few = ACCOUNTS.up_to(1)
    marks = len(FRAME.board.rows.measured)
    numbers = np.arange(2 * marks).reshape(-1, 2)
    known = Noises(np.array([SIGMA]), np.zeros(1))
    weights = np.atleast_2d(outlier_weights(BOARD, few, known, numbers))[0]
    for reading in (0, 4):
        several = [
            log_prior + sum(by_force(index, variance, pitch=True, off=numbers[reading], spread=mm))
            for mm in OUTLIER_SPREADS
            for part in few.parts
            for index, variance, log_prior in zip(
                part.index, part.variance, part.log_prior, strict=True
            )
        ]
        whole = np.logaddexp.reduce(several) - np.log(marks * len(OUTLIER_SPREADS))
        assert weights[reading] == pytest.approx(whole, abs=0.03)
