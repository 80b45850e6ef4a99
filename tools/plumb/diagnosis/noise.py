"""The noise of a reading: what is stated, repeats and scatter say of it, as one posterior."""

from dataclasses import dataclass

import numpy as np
import scipy

from plumb.diagnosis.evidence import NOISE_STEP
from plumb.diagnosis.explanation import Explanation, beyond, span
from plumb.diagnosis.priors import NOISE_DEGREES, noise_prior
from plumb.fit.inputs import Stated
from plumb.fit.observations import Observations
from plumb.text.errors import to_do
from plumb.text.values import Unit

Array = np.ndarray
KNOWN = np.inf  # degrees of freedom of a noise that needs no estimate
KNOWN_QUANTILE = 1.96  # half-width of a 95 % interval where the noise is known
ORIGINS = {
    "stated": "as stated",
    "stated and marks": "as stated, and from the scatter of the marks",
    "marks": "from the scatter of the marks",
}
FEWEST_SPARE = 0.5  # numbers that a fit must leave over to say anything of its misfit
DRAWN = 99  # noises of the prior
SURPRISING = 2.5  # spreads of what was stated by which the marks may differ from it


@dataclass(frozen=True)
class Noise:
    """Standard deviation of one coordinate or distance, and how well it is known."""

    sigma: float  # [mm]
    degrees: float  # of freedom; KNOWN if it was not estimated
    source: str  # one of ORIGINS
    notes: tuple[str, ...] = ()

    @property
    def quantile(self) -> float:
        """Half-width of a 95 % interval, in standard deviations."""
        return (
            KNOWN_QUANTILE
            if np.isinf(self.degrees)
            else float(scipy.special.stdtrit(self.degrees, 0.975))
        )

    @property
    def upper_quantile(self) -> float:
        """Distance of a 95 % upper limit, in standard deviations."""
        return 1.645 if np.isinf(self.degrees) else float(scipy.special.stdtrit(self.degrees, 0.95))


def noise_by(sigmas: Array, weights: Array, stated: Stated | None, unit: Unit) -> Noise:
    """Return the noise by log weights (m,) of some standard deviations [mm].

    The logarithm of a standard deviation that is known with n degrees of freedom spreads by
    1 / sqrt(2 n), so Student's t with as many degrees follows for what is fitted.
    """
    if not noise_prior(stated)[1]:
        return Noise(float(sigmas[0]), KNOWN, "stated")
    chances = np.exp(weights - np.logaddexp.reduce(weights))
    logs = np.log(sigmas)
    middle = float(chances @ logs)
    variance = float(chances @ (logs - middle) ** 2)
    variance = variance or NOISE_STEP**2 / 12  # where one is left, it is known to a step
    noise = Noise(float(np.exp(middle)), 0.5 / variance, "stated and marks" if stated else "marks")
    return noise if stated is None else _compared(noise, stated, unit)


def _compared(noise: Noise, stated: Stated, unit: Unit) -> Noise:
    """Return the noise with a note if the marks contradict what was stated."""
    _, spread = noise_prior(stated)
    off = np.log(noise.sigma / stated.sigma)
    if abs(off) < SURPRISING * spread:
        return noise
    than = "more" if off > 0 else "less"
    note = (
        f"the marks scatter by {unit.worded(noise.sigma)}, {than} than the stated "
        f"{unit.worded(stated.sigma)}: read three marks three times, "
        + to_do("or say with --sigma what holds", page="or correct what your tape is good to")
    )
    return Noise(noise.sigma, noise.degrees, noise.source, (note,))


# Lack of fit: the last guard, whether an account leaves more than noise ever would.


def misfit_chance(explanation: Explanation, stated: Stated | None) -> float:
    """Return the chance that noise leaves as much as this explanation does, over all noises that
    were likely before the marks (a posterior-predictive check, Gelman, Meng and Stern 1996).

    Repeats that scatter more than was stated make noises likelier. Repeats that scatter less do
    not: they share what is wrong with a mark, and say nothing of how marks differ.
    """
    basis, count = explanation.basis, explanation.board.rows.count
    # How near the frame is to what was stated says nothing of how well the marks are explained.
    left = float(explanation.numbers @ explanation.numbers)
    spare = count - float(np.sum(basis[:count] ** 2))
    if spare < FEWEST_SPARE:
        return 1.0
    middle, spread = noise_prior(stated)
    logs = spread * scipy.special.stdtrit(NOISE_DEGREES, (np.arange(DRAWN) + 0.5) / DRAWN)
    variances = (middle * np.exp(logs)) ** 2
    squares, degrees = _repeats(explanation.board.rows)
    by_repeats = -(degrees * np.log(variances) + squares / variances) / 2
    by_repeats = np.exp(by_repeats - np.logaddexp.reduce(by_repeats))
    tails = scipy.special.chdtrc(spare, left / variances)
    return float(max(tails.mean(), by_repeats @ tails))


def _repeats(rows: Observations) -> tuple[float, int]:
    """Return the sum of squares [mm^2] of readings of a mark in a round about their mean, and its
    degrees of freedom.
    """
    errors = rows.measured - rows.targets
    alike: dict[object, list[int]] = {}
    for i, row in enumerate(rows.mark_rows):
        alike.setdefault((rows.names[i], *rows.chains[row], rows.rounds[row]), []).append(i)
    groups = [errors[group] for group in alike.values()]
    squares = sum(float(np.sum((group - group.mean(axis=0)) ** 2)) for group in groups)
    return squares, 2 * (len(errors) - len(groups))


def left_by_noise(explanation: Explanation, noise: Noise) -> float:
    """Return what noise alone would leave of a fit [mm], as `Explanation.rms` counts it."""
    leverages = np.sum(explanation.basis**2, axis=1)
    return noise.sigma * explanation.board.rows.rms_of_noise(leverages)


def library_basis(explanation: Explanation) -> Array:
    """Orthonormal columns of what was fitted and of every effect of the library."""
    raw = explanation.slopes[:, explanation.board.columns(explanation.board.effect_columns)]
    basis = explanation.basis
    return np.hstack([basis, span(beyond(basis, raw), against=raw)])
