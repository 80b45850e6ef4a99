"""Residuals against noise: a band that noise stays in, and that a pattern leaves."""

import numpy as np
import pytest
from plumb.fit.quantiles import quantiles

MARKS = 25


def inside(errors, noise_rms):
    """Whether all points lie in the band."""
    return not quantiles(errors, noise_rms).beyond.any()


def test_noise_stays_in_the_band_as_often_as_stated():
    noise = np.random.default_rng(7)
    boards = [noise.normal(0, 0.4, (MARKS, 2)) for _ in range(4000)]
    placed = [quantiles(errors, 0.4 * np.sqrt(2)) for errors in boards]
    below, above = (
        np.mean([beyond.any() for beyond in sides])
        for sides in (
            [each.values < each.low for each in placed],
            [each.values > each.high for each in placed],
        )
    )
    assert below == pytest.approx(above, abs=0.012)
    outside = np.mean([each.beyond.any() for each in placed])
    assert outside == pytest.approx(0.05, abs=0.01) and outside > max(below, above) + 0.01


def test_noise_that_is_larger_or_has_a_tail_leaves_it():
    noise = np.random.default_rng(8)
    errors = noise.normal(0, 0.4, (MARKS, 2))
    assert inside(errors, 0.4 * np.sqrt(2))
    assert not inside(2 * errors, 0.4 * np.sqrt(2))
    for far, place in ((2.4, -1), (-2.4, 0)):
        errors[3, 1] = far
        assert np.flatnonzero(quantiles(errors, 0.4 * np.sqrt(2)).beyond) == [place % errors.size]
