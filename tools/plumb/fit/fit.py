"""Fitting the model to what was measured: one least-squares problem, its solution, and intervals
with honest errors.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
import scipy
from numpy.typing import NDArray

from plumb.fit.observations import (
    LAB_NAMES,
    SHEET_ROTATION,
    Observations,
    Sighting,
    last_turn_of,
    rms,
    round_priors,
    sighted,
)
from plumb.model.catalogue import parameter_names, parameter_words
from plumb.model.predict import FOUND, NAMES, Array, settings_of, values_of, with_parameters
from plumb.settings import FRAME_FIELDS, MachineSettings
from plumb.text.errors import InputError, to_do
from plumb.text.values import refuse_unknown

# One least-squares problem: the frame within its priors, parameters of effects, direct checks.
#
# All is whitened, so that noise alone is a vector of independent standard normals. Rows are the
# measured numbers over sigma, then the priors, then what was checked directly; columns are the
# unknowns in typical sizes. A residual is measured - predicted, and slopes are those of what is
# predicted: small changes `u` of the unknowns take `slopes @ u` off the residual.
#
# The frame is held by stated priors: nine marks cannot tell spacing, rotation radius and chain
# zeros apart, so what was measured on the machine stays near its measured value. The radius is a
# solid part and is not fitted at all.


USUAL_SIGMA = 0.5  # [mm] of one coordinate read with a tape by hand
# Standard deviations of what an owner states: spacing by tape or pulled chain; the sheet may lie
# anywhere near where it was meant to.
PRIORS: Mapping[str, float] = {
    "motor_gap": 3.0,
    "motor_height": 20.0,
    "motor_center_x": 20.0,
    SHEET_ROTATION: 0.02,
}


@dataclass(frozen=True)
class Checked:
    """A number of the machine that was measured directly, like the tape against a steel rule."""

    name: str  # of a parameter or of the frame
    value: float  # [its unit]
    sigma: float  # [its unit]


@dataclass(frozen=True)
class Linearized:
    """A problem at some unknowns: what is left there, and how predictions change from there."""

    unknowns: Array  # (u,)
    residual: Array  # (n + priors + checks,) whitened, measured - predicted
    slopes: Array  # (n + priors + checks, u) whitened, of what is predicted
    predicted: Array  # (k, 2) [mm] of the marks

    @property
    def cost(self) -> float:
        """Chi-square of what is left."""
        return float(self.residual @ self.residual)


@dataclass(frozen=True)
class Problem:
    """Least squares in scaled unknowns u: value = start + scale * u."""

    settings: MachineSettings
    observations: Observations
    names: tuple[str, ...]
    start: Array
    scale: Array  # typical size, or the prior's standard deviation
    held: Array  # True where a prior holds the unknown
    sigma: float  # [mm] of one measured number
    checked: tuple[Checked, ...] = ()
    outside: Mapping[str, float] = field(default_factory=dict)  # held, though no setting holds it

    @staticmethod
    def of(
        settings: MachineSettings,
        observations: Observations,
        effects: Iterable[str],
        priors: Mapping[str, float],
        sigma: float,
        checked: Sequence[Checked] = (),
        held: Mapping[str, float] | None = None,
    ) -> Problem:
        """Return the problem of a board for a model that starts from these settings.

        Checks of numbers that are not fitted do not count. `held` are parameters of effects, by
        full name, that keep these sizes.
        """
        held = held or {}
        in_model = {name: size for name, size in held.items() if name in NAMES}
        settings = with_parameters(settings, in_model) if in_model else settings
        typical = {name: words["typical"] for name, words in parameter_words().items()}
        each = (name for effect in effects for name in parameter_names(effect))
        free = [name for name in each if name not in held]
        priors = {**priors, **round_priors(observations)}
        kept = [name for name in priors if priors[name] > 0]
        names = (*kept, *free)
        values = dict(zip(NAMES, values_of(settings), strict=True))
        return Problem(
            settings=settings,
            observations=observations,
            names=names,
            start=np.array([values.get(name, 0.0) for name in names]),
            scale=np.array([priors[name] for name in kept] + [typical[name] for name in free]),
            held=np.array([True] * len(kept) + [False] * len(free), dtype=bool),
            sigma=sigma,
            checked=tuple(check for check in checked if check.name in names),
            outside={name: size for name, size in held.items() if name not in in_model},
        )

    def at(self, unknowns: Array) -> Linearized | None:
        """Return what is left at these unknowns, with exact slopes; None where the sled cannot
        hang.
        """
        sighting, reached = self.predict(unknowns)
        if not reached:
            return None
        rows = self.observations
        marks = rows.measured - sighting.read.where[rows.mark_rows]
        distances = rows.distances - sighting.taped_spans(rows.distance_rows)
        left, by_check = self._checks(unknowns)
        return Linearized(
            unknowns=unknowns,
            residual=np.concatenate(
                [marks.ravel() / self.sigma, distances / self.sigma, -unknowns[self.held], left]
            ),
            slopes=np.vstack(
                [
                    self.data_slopes(sighting) / self.sigma,
                    np.eye(len(self.names))[self.held],
                    by_check,
                ]
            ),
            predicted=sighting.read.where[rows.mark_rows],
        )

    def values(self, unknowns: Array) -> tuple[Array, dict[str, float]]:
        """Return the model's values array, and what lies outside of the machine by name."""
        values = self._of_settings.copy()
        outside = dict(self.outside)
        for name, value in zip(self.names, self.start + self.scale * unknowns, strict=True):
            if name in NAMES:
                values[NAMES.index(name)] = value
            else:
                outside[name] = float(value)
        return values, outside

    @cached_property
    def _of_settings(self) -> Array:
        return values_of(self.settings)

    def predict(self, unknowns: Array) -> tuple[Sighting, bool]:
        """Return what should have been measured, with slopes by the values of `names`, and
        success.
        """
        values, outside = self.values(unknowns)
        sighting = sighted(
            values,
            outside,
            self.observations,
            over_top=self.settings.feed == "top",
            usual_weight=self.settings.sled_weight,
            names=self.names,
        )
        return sighting, bool((sighting.outcome == FOUND).all())

    def data_slopes(self, sighting: Sighting) -> Array:
        """Slopes of all predicted numbers by the unknowns, (2k + m, u) [mm]."""
        rows, taped = self.observations, sighting.taped
        marks = sighting.read.slopes[rows.mark_rows].reshape(rows.measured.size, len(self.names))
        ends, moved = taped.where[rows.distance_rows], taped.slopes[rows.distance_rows]
        along = ends[:, 1] - ends[:, 0]
        along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
        spans = np.einsum("mi,miu->mu", along, moved[:, 1] - moved[:, 0])
        return np.vstack([marks, spans]) * self.scale

    def _checks(self, unknowns: Array) -> tuple[Array, Array]:
        """Return what is left of the direct checks (c,), and their slopes (c, u), both whitened."""
        left = np.zeros(len(self.checked))
        slopes = np.zeros((len(self.checked), len(self.names)))
        for row, check in enumerate(self.checked):
            column = self.names.index(check.name)
            slopes[row, column] = self.scale[column] / check.sigma
            value = self.start[column] + self.scale[column] * unknowns[column]
            left[row] = (check.value - value) / check.sigma
        return left, slopes


# The solver: Gauss-Newton, with steps halved where a whole step overshoots.

Columns = NDArray[np.int_]
MOST_STEPS = 30
MOST_HALVINGS = 8
CLOSE_ENOUGH = 1e-12  # of chi-square: a step that promises less is not made
AT_REST = 1e-5  # of chi-square: a search that ends where a step promises more has not settled
ROUNDING = 1e-13  # share of chi-square that is lost in its sum


@dataclass(frozen=True)
class Solution:
    """Where the search came to rest."""

    at: Linearized
    settled: bool  # False: the search ended where a step still promised more than AT_REST


def solve(
    problem: Problem,
    *,
    free: Columns | None = None,
    start: Array | None = None,
    at_start: Linearized | None = None,
    close_enough: float = CLOSE_ENOUGH,
) -> Solution:
    """Return the least chi-square over the unknowns in the columns `free` (None: all of them).

    at_start: the problem at the start, if it is known. Raises InputError where the sled of the
    start cannot hang.
    """
    zeros = np.zeros(len(problem.names))
    here = at_start or problem.at(zeros if start is None else start)
    if here is None:
        raise InputError("with these settings the sled cannot hang where the marks were sent")
    columns: Columns = np.arange(len(problem.names)) if free is None else free
    step, promised = _step(here, columns)
    for _ in range(MOST_STEPS):
        if promised < max(close_enough, ROUNDING * here.cost):
            break
        better = _lower(problem, here, columns, step)
        if better is None:
            break
        here = better
        step, promised = _step(here, columns)
    return Solution(here, settled=promised < max(close_enough, AT_REST, ROUNDING * here.cost))


def _step(here: Linearized, columns: Columns) -> tuple[Array, float]:
    """Return the step to the least of the linearized problem, and by how much it lowers
    chi-square.
    """
    slopes = here.slopes[:, columns]
    step = np.linalg.lstsq(slopes, here.residual, rcond=1e-10)[0]
    promised = 2 * step @ (slopes.T @ here.residual) - np.sum((slopes @ step) ** 2)
    return np.asarray(step, dtype=float), float(promised)


def _lower(problem: Problem, here: Linearized, columns: Columns, step: Array) -> Linearized | None:
    """Return the first of ever shorter steps that lowers chi-square; None if none does."""
    for halvings in range(MOST_HALVINGS):
        unknowns = here.unknowns.copy()
        unknowns[columns] += step / 2**halvings
        there = problem.at(unknowns)
        if there is not None and there.cost < here.cost:
            return there
    return None


def priors_with(changes: Iterable[tuple[str, float]]) -> dict[str, float]:
    """Return the usual priors with some standard deviations changed; 0 holds a number."""
    priors = dict(PRIORS)
    for name, sigma in changes:
        try:
            refuse_unknown([name], (*FRAME_FIELDS, SHEET_ROTATION))
        except ValueError as error:
            prior = to_do("--prior", page="how far off is")
            raise InputError(prior + f" {name}: {error}") from None
        priors[name] = sigma
    return priors


# Fitting the model to what was measured: estimates with intervals, and honest errors.


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
