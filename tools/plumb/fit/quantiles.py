"""Residuals against noise: each as large as it is, and as large as noise alone would make it."""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np
from numpy.typing import NDArray
from scipy.special import betainc, betaincinv
from scipy.stats import norm

from plumb.model.plain import ascending
from plumb.model.predict import Array

DRAWS, NUMBERS = 2000, 400_000  # of noise at most, for the band
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
        """The coordinates outside the band."""
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

    Each point leaves the band equally often: its place among the others follows a beta
    distribution. How often that may be follows from draws: a draw leaves it if any point does.
    """
    place = np.arange(1, count + 1)
    spread = place, place[::-1]
    draws = min(DRAWS, NUMBERS // max(1, count))
    drawn = np.sort(np.random.default_rng(1).random((draws, count)), axis=1)
    below = betainc(*spread, drawn)
    rarest = np.minimum(below, 1 - below).min(axis=1, initial=1.0)
    high = norm.ppf(betaincinv(*spread, 1 - np.quantile(rarest, 1 - SHARE)))
    return norm.ppf((place - 0.5) / count), -high[::-1], high
