"""Lack of fit: whether an explanation leaves more of the measured numbers than noise would."""

from __future__ import annotations

import numpy as np

from plumb.diagnosis.explanation import Explanation, span
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.significance import tail

Array = np.ndarray
LEVEL = 0.015  # chance at which noise alone is called a misfit


def misfit_chance(explanation: Explanation, noise: Noise) -> float:
    """Chance that noise alone leaves as much as this explanation does; 1 if nothing can tell.

    Chi-square for a known sigma. With repeats in sigma, F of what is left between places over
    sigma, and what is left within repeats does not count: sigma was made of it.
    """
    left, spare = _left_over(explanation, explanation.basis, explanation.residual)
    return _chance(explanation, left, spare, noise)


def spare_numbers(explanation: Explanation) -> float:
    """How many measured numbers the fit left over."""
    return _left_over(explanation, explanation.basis, explanation.residual)[1]


def library_misfit_chance(explanation: Explanation, noise: Noise) -> float:
    """The same beyond everything that all effects of the library could draw at once."""
    return _chance(explanation, *beyond_library(explanation), noise)


def beyond_library(explanation: Explanation) -> tuple[float, float]:
    """Chi-square that no combination of effects takes away, and its degrees of freedom."""
    basis = library_basis(explanation)
    rest = explanation.residual - basis @ (basis.T @ explanation.residual)
    return _left_over(explanation, basis, rest)


def library_basis(explanation: Explanation) -> Array:
    """Orthonormal columns of what was fitted and of every effect of the library."""
    raw = explanation.slopes[:, explanation.board.columns(explanation.board.effect_columns)]
    fitted = explanation.basis
    return np.hstack([fitted, span(raw - fitted @ (fitted.T @ raw), against=raw)])


def _left_over(explanation: Explanation, basis: Array, residual: Array) -> tuple[float, float]:
    """Chi-square of the measured numbers alone, and the numbers less those that the fit took.

    The rows of the priors do not count: how near the frame is to what was stated says nothing of
    how well the marks are explained.
    """
    count = explanation.board.rows.count
    return float(residual[:count] @ residual[:count]), count - float(np.sum(basis[:count] ** 2))


def _chance(explanation: Explanation, left: float, spare: float, noise: Noise) -> float:
    within = noise.within
    spare, left = spare - within.degrees, left - within.squares / explanation.board.sigma**2
    if spare < 0.5 or not noise.testable:
        return 1.0
    return float(tail(left, spare, noise.degrees))
