"""How surprising a gain is: tail probabilities for a known noise and for one that was estimated."""

from __future__ import annotations

from functools import lru_cache

import numpy as np
import scipy

Array = np.ndarray
KNOWN = np.inf  # degrees of freedom of a noise that needs no estimate
_FAR = 200.0  # a gain beyond which the tail is taken from its expansion, or it would be zero


def tail(gain: Array | float, parameters: float, degrees: float) -> Array:
    """Chance of a gain this large from noise alone, for an effect of some parameters.

    gain = drop of the sum of squares over sigma squared; chi-square for a known sigma, F for one
    that was estimated with `degrees` of freedom.
    """
    above = np.maximum(gain, 0.0)
    if np.isinf(degrees):
        return scipy.special.chdtrc(parameters, above)
    return scipy.special.fdtrc(parameters, degrees, above / parameters)


def surprise(gain: float, parameters: int, degrees: float) -> float:
    """-log of `tail`, finite however large the gain: the scale on which effects are compared."""
    if parameters < 1 or gain <= 0:
        return 0.0
    if not np.isinf(degrees):
        return float(-np.log(max(float(tail(gain, parameters, degrees)), 1e-300)))
    if gain < _FAR:
        return float(-np.log(tail(gain, parameters, degrees)))
    # Q(a, x) = x^(a - 1) exp(-x) / Gamma(a) * (1 + (a - 1) / x + ...)
    a, x = parameters / 2, gain / 2
    return float(x - (a - 1) * np.log(x) + scipy.special.gammaln(a) - np.log1p((a - 1) / x))


def surprises(gains: Array, parameters: int, degrees: float) -> Array:
    """`surprise` of many gains, from a table: right to about a thousandth, and fast."""
    table = _table(parameters, degrees)
    interpolated: Array = np.interp(gains, _GAINS, table)
    return interpolated


_GAINS = np.concatenate([[0.0], np.geomspace(1e-3, 1e5, 1500)])


@lru_cache(maxsize=64)
def _table(parameters: int, degrees: float) -> Array:
    return np.array([surprise(float(gain), parameters, degrees) for gain in _GAINS])
