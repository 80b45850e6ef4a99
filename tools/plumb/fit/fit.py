"""Fitting the model to what was measured: estimates with intervals, and honest errors."""

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from plumb.fit.observations import LAB_NAMES, SHEET_ROTATION, Observations, last_turn_of, rms
from plumb.fit.problem import PRIORS, USUAL_SIGMA, Checked, Problem, Solution, solve
from plumb.model.catalogue import parameter_names
from plumb.model.predict import Array, settings_of
from plumb.settings.machine import MachineSettings

UNFELT = 1e-6  # [sigmas of a reading] that an unknown moves by its typical size, at most
LIVE = 1e-9  # of chi-square: a smaller step changes less than 1e-4 sigmas
SMALLEST_SIGMA = 1e-9  # [mm] for marks that a model explains completely


@dataclass(frozen=True)
class Estimate:
    """A fitted number: its value, 95 % interval, and what was known of it before."""

    name: str
    value: float
    low: float
    high: float
    before: float
    prior_sigma: float | None  # None: free
    felt: bool = True  # False: no measured number depends on it


@dataclass(frozen=True)
class Fit:
    """A model fitted to observations."""

    settings: MachineSettings
    sheet_rotation: float  # [rad]
    # Fitted, but no setting holds them.
    lab_effects: Mapping[str, Mapping[str, float]]
    estimates: tuple[Estimate, ...]
    predicted: Array  # (k, 2) [mm] of the marks, on the sheet
    errors: Array  # (k, 2) [mm] measured - predicted
    left_out_errors: Array  # (k, 2) [mm] of each mark when it takes no part in the fit
    distance_errors: Array  # (m,) [mm]
    left_out_distance_errors: Array  # (m,) [mm]
    spent: float  # how many numbers the fit took from the data
    noise_rms: float  # [mm] what noise alone would leave, as `rms` counts it
    sigma: float  # [mm] of one number, stated or estimated
    sigma_from: str  # "stated" or "residuals"
    settled: bool  # False: the search stopped at its limit of tries
    covariance: Array  # (u, u) of the unknowns, in the order of `estimates` and in their units

    @property
    def shows_sheet_rotation(self) -> bool:
        """Whether the measured numbers depend on it: distances alone do not."""
        return any(each.name == SHEET_ROTATION and each.felt for each in self.estimates)

    @property
    def last_sheet_rotation(self) -> float:
        """The rotation of the last sheet [rad]: that of the first and the difference."""
        last = last_turn_of(each.name for each in self.estimates)
        return self.sheet_rotation + sum(each.value for each in self.estimates if each.name == last)

    @property
    def proves_sheet_rotation(self) -> bool:
        """Whether the last sheet is turned for certain: its interval leaves out zero."""
        names = [each.name for each in self.estimates]
        turns = [
            names.index(each) for each in (SHEET_ROTATION, last_turn_of(names)) if each in names
        ]
        felt = [self.estimates[i] for i in turns if self.estimates[i].felt]
        if not felt:
            return False
        sigma = float(self.covariance[np.ix_(turns, turns)].sum()) ** 0.5
        alone = float(self.covariance[turns[0], turns[0]]) ** 0.5
        half = (self.estimates[turns[0]].high - self.estimates[turns[0]].low) / 2
        return bool(abs(self.last_sheet_rotation) * alone > half * sigma)

    @property
    def rms(self) -> float:
        """Root mean square error of the marks (as vectors), or of distances without marks."""
        return rms(self.errors if len(self.errors) else self.distance_errors)

    @property
    def left_out_rms(self) -> float:
        """The same for marks that took no part: what to expect at a new place."""
        return rms(self.left_out_errors if len(self.errors) else self.left_out_distance_errors)

    @property
    def corrected_rms(self) -> float:
        """The fit's error scaled up for the numbers it took from the data."""
        count = self.errors.size + self.distance_errors.size
        return self.rms * float(np.sqrt(count / max(count - self.spent, 1e-9)))


def fit(
    settings: MachineSettings,
    observations: Observations,
    *,
    effects: Iterable[str] = (),
    priors: Mapping[str, float] = PRIORS,
    sigma: float | None = None,
    degrees: float = np.inf,
    checked: Sequence[Checked] = (),
    held: Mapping[str, float] | None = None,
    near: Fit | None = None,
) -> Fit:
    """Fit the frame within its priors and the parameters of `effects` to the observations.

    `settings` is the model to start from; sigma [mm] of one coordinate, estimated if None, and the
    degrees of freedom that it is known with. `checked` are numbers that were measured directly;
    those of what is not fitted do not count. `held` are parameters, by full name, that keep these
    sizes. The search begins at the numbers of `near` and ends a little earlier: for live
    pictures.
    """
    names = tuple(effects)
    fitted = {*priors, *(parameter for name in names for parameter in parameter_names(name))}
    fitted -= {*(held or ())}
    known = [check for check in checked if check.name in fitted and priors.get(check.name, 1.0) > 0]
    sigma_used = sigma or USUAL_SIGMA
    problem = Problem.of(settings, observations, names, priors, sigma_used, known, held)
    return _fit_of(problem, _solved(problem, near), sigma, degrees)


def _solved(problem: Problem, near: Fit | None) -> Solution:
    """Return the least chi-square, searched from the numbers of another fit if the sled hangs
    there.
    """
    if near is None:
        return solve(problem)
    known = {estimate.name: estimate.value for estimate in near.estimates}
    starts = zip(problem.names, problem.start, strict=True)
    values = np.array([known.get(name, at) for name, at in starts])
    at_start = problem.at((values - problem.start) / problem.scale)
    return solve(problem, at_start=at_start, close_enough=LIVE)


def _fit_of(problem: Problem, solution: Solution, stated: float | None, degrees: float) -> Fit:
    """Return the fit with its intervals and left-out errors; `stated` is the sigma, if it
    is known.
    """
    rows, here = problem.observations, solution.at
    slopes, errors = here.slopes[: rows.count], here.residual[: rows.count] * problem.sigma
    held = here.slopes[rows.count :]  # by priors and direct checks
    priors = held.T @ held
    leverage = slopes @ np.linalg.pinv(slopes.T @ slopes + priors, hermitian=True) @ slopes.T
    spent = float(np.trace(leverage))
    spare = max(len(errors) - spent, 1e-9)
    sigma = stated or max(float(np.sqrt(errors @ errors / spare)), SMALLEST_SIGMA)
    known = spare if stated is None else degrees
    width = 1.96 if np.isinf(known) else float(scipy.special.stdtrit(known, 0.975))
    # Intervals for the noise as estimated; what a prior or a check holds grows no wider than that.
    normal = slopes.T @ slopes * (problem.sigma / sigma) ** 2 + priors
    covariance = np.linalg.pinv(normal, hermitian=True)
    deviation = np.sqrt(np.diag(covariance))
    marks, distances = errors[: rows.measured.size].reshape(-1, 2), errors[rows.measured.size :]
    left_marks, left_distances = _left_out(rows.names, marks, distances, leverage)
    # What no measured number depends on stays where it was, to the last bit.
    felt = np.linalg.norm(slopes, axis=0) > UNFELT
    unknowns = np.where(felt, here.unknowns, 0.0)
    values, outside = problem.values(unknowns)
    return Fit(
        settings=settings_of(values, like=problem.settings),
        sheet_rotation=outside.get(SHEET_ROTATION, 0.0),
        lab_effects=_by_effect(outside),
        estimates=_estimates(problem, unknowns, width * deviation, felt),
        predicted=here.predicted,
        errors=marks,
        left_out_errors=left_marks,
        distance_errors=distances,
        left_out_distance_errors=left_distances,
        spent=spent,
        noise_rms=sigma * rows.rms_of_noise(np.diag(leverage)),
        sigma=sigma,
        sigma_from="residuals" if stated is None else "stated",
        settled=solution.settled,
        covariance=covariance * np.outer(problem.scale, problem.scale),
    )


def _estimates(
    problem: Problem, unknowns: Array, half_widths: Array, felt: Array
) -> tuple[Estimate, ...]:
    """Return each unknown with its interval of these half-widths, in its unit."""
    values = problem.start + problem.scale * unknowns
    reach = problem.scale * half_widths
    return tuple(
        Estimate(
            name=name,
            value=float(values[i]),
            low=float(values[i] - reach[i]),
            high=float(values[i] + reach[i]),
            before=float(problem.start[i]),
            prior_sigma=float(problem.scale[i]) if problem.held[i] else None,
            felt=bool(felt[i]),
        )
        for i, name in enumerate(problem.names)
    )


def _by_effect(outside: Mapping[str, float]) -> dict[str, dict[str, float]]:
    """Parameters of lab effects by effect and name."""
    by_effect: dict[str, dict[str, float]] = {}
    for name in LAB_NAMES:
        if name in outside:
            effect, _, parameter = name.rpartition(".")
            by_effect.setdefault(effect, {})[parameter] = outside[name]
    return by_effect


def _left_out(
    names: tuple[str, ...], marks: Array, distances: Array, leverage: Array
) -> tuple[Array, Array]:
    """Errors of each mark or distance in a fit without it: (1 - its leverage)^-1 error.

    Repeats of a mark are left out together, or each would be predicted by its twin.
    """
    left_marks = np.zeros_like(marks)
    places: dict[str, list[int]] = {}
    for place, name in enumerate(names):
        places.setdefault(name, []).append(place)
    for repeats in map(np.array, places.values()):
        block = np.stack([2 * repeats, 2 * repeats + 1], axis=1).ravel()
        kept = np.eye(len(block)) * (1 + 1e-12) - leverage[np.ix_(block, block)]
        left_marks[repeats] = np.linalg.solve(kept, marks[repeats].ravel()).reshape(-1, 2)
    of_distances = np.diag(leverage)[2 * len(marks) :]
    return left_marks, distances / np.maximum(1 - of_distances, 1e-12)
