"""Residuals against noise: each as large as it is, and as large as noise alone would make it."""

from __future__ import annotations

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from plumb.model.plain import ascending
from plumb.model.predict import Array

DRAWS = 2000  # of noise, for the band
SHARE = 0.95  # of the draws that lie in the band with all their points


@dataclass(frozen=True)
class Quantiles:
    """The coordinates of residuals, the smallest first."""

    order: NDArray[np.int_]  # (2k,) whose coordinate it is: that of x or y, 2 * mark + 0 or 1
    values: Array  # (2k,) [mm] how large it is
    at: Array  # (2k,) [mm] what noise alone would make of it
    low: Array  # (2k,) [mm] band that noise leaves at no point, 95 times of 100
    high: Array  # (2k,) [mm]

    @property
    def beyond(self) -> NDArray[np.bool_]:
        """Which coordinates lie outside of the band."""
        return (self.values < self.low) | (self.values > self.high)


def quantiles(errors: Array, noise_rms: float) -> Quantiles:
    """Return residuals (k, 2) [mm] against noise that leaves `noise_rms` [mm] of their vectors."""
    at, low, high = _of_noise(errors.size)
    sigma = noise_rms / np.sqrt(2)
    order = ascending(errors.ravel())
    return Quantiles(order, errors.ravel()[order], sigma * at, sigma * low, sigma * high)


@lru_cache(maxsize=8)
def _of_noise(count: int) -> tuple[Array, Array, Array]:
    """Return the quantiles of this many numbers, and the band, in sigmas.

    Each point leaves the band equally often. How often that may be follows from draws: a draw
    counts as outside if any of its points is.
    """
    if count == 0:
        return np.zeros(0), np.zeros(0), np.zeros(0)
    at = norm.ppf((np.arange(count) + 0.5) / count)
    draws = np.sort(np.random.default_rng(1).normal(size=(DRAWS, count)), axis=1)
    ranks = np.argsort(np.argsort(draws, axis=0), axis=0)
    outermost = np.minimum(ranks, DRAWS - 1 - ranks).min(axis=1)
    depth = int(np.quantile(outermost, 1 - SHARE))
    sides = np.sort(draws, axis=0)
    return at, sides[depth], sides[DRAWS - 1 - depth]
