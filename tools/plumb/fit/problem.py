"""Fitting the model to what was measured: parameters with priors, intervals and honest errors.

The frame is held by stated priors: nine marks cannot tell spacing, rotation radius and chain
zeros apart, so what was measured on the machine stays near its measured value. The radius is a
solid part and is not fitted at all.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from scipy.optimize import least_squares
from scipy.special import stdtrit

from plumb.board.observations import Observations
from plumb.board.rounds import round_priors
from plumb.board.sighting import OUTSIDE_NAMES, SHEET_ROTATION, Sighting, sighted
from plumb.model.catalogue import parameter_names, parameter_words
from plumb.model.predict import FOUND, NAMES, Array, settings_of, values_of
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

USUAL_SIGMA = 0.5  # [mm] of one coordinate read with a tape by hand
# Standard deviations of what an owner states: spacing by tape or pulled chain; the sheet may lie
# anywhere near where it was meant to.
PRIORS: Mapping[str, float] = {
    "motor_gap": 3.0,
    "motor_height": 20.0,
    "motor_center_x": 20.0,
    SHEET_ROTATION: 0.02,
}
SMALLEST_SIGMA = 1e-9  # [mm] for marks that a model explains completely
UNREACHABLE = 1e6  # residual of a trial machine on which the sled could not hang


@dataclass(frozen=True)
class Estimate:
    """One fitted number: its value, 95 % interval, and what was known of it before."""

    name: str
    value: float
    low: float
    high: float
    before: float
    prior_sigma: float | None  # None: free


@dataclass(frozen=True)
class Fit:
    """A model fitted to observations."""

    settings: MachineSettings
    sheet_rotation: float  # [rad]
    lab_effects: Mapping[
        str, Mapping[str, float]
    ]  # fitted, but no setting holds them; sketches too
    estimates: tuple[Estimate, ...]
    predicted: Array  # (k, 2) [mm] of the marks, on the sheet
    errors: Array  # (k, 2) [mm] measured - predicted
    left_out_errors: Array  # (k, 2) [mm] of each mark when it takes no part in the fit
    distance_errors: Array  # (m,) [mm]
    left_out_distance_errors: Array  # (m,) [mm]
    spent: float  # how many numbers the fit took from the data
    sigma: float  # [mm] of one number, stated or estimated
    sigma_from: str  # "stated" or "residuals"
    settled: bool  # False: the search stopped at its limit of tries

    @property
    def rms(self) -> float:
        """Root mean square error of the marks (as vectors), or of distances without marks."""
        return rms(self.errors if len(self.errors) else self.distance_errors)

    @property
    def left_out_rms(self) -> float:
        """The same for marks that took no part: what to expect at a new place."""
        own = self.left_out_errors if len(self.errors) else self.left_out_distance_errors
        return rms(own)

    @property
    def priced_rms(self) -> float:
        """The fit's error scaled up for the numbers it took from the data."""
        count = self.errors.size + self.distance_errors.size
        return self.rms * float(np.sqrt(count / max(count - self.spent, 1e-9)))


def rms(errors: Array) -> float:
    """Root mean square length of errors (n, 2), or of numbers (n,) [mm]."""
    if len(errors) == 0:
        return float("nan")
    return float(np.sqrt(np.mean(np.sum(np.atleast_2d(errors.T).T ** 2, axis=1))))


def fit(
    settings: MachineSettings,
    observations: Observations,
    *,
    effects: Iterable[str] = (),
    priors: Mapping[str, float] = PRIORS,
    sigma: float | None = None,
) -> Fit:
    """Fit the frame within its priors and the parameters of `effects` to the observations.

    `settings` is the model to start from; sigma [mm] of one coordinate, estimated if None.
    """
    problem = Problem.of(settings, observations, effects, priors, sigma or USUAL_SIGMA)
    if not problem.names:
        return problem.result(np.zeros(0), sigma, settled=True)
    solution = least_squares(
        problem.residuals,
        np.zeros(len(problem.names)),
        jac=problem.slopes,
        x_scale=1.0,
        xtol=1e-12,
        ftol=1e-12,
        gtol=1e-10,
        max_nfev=100,
    )
    return problem.result(solution.x, sigma, settled=solution.status > 0)


@dataclass(frozen=True)
class Problem:
    """Least squares in scaled unknowns u: value = start + scale * u."""

    settings: MachineSettings
    observations: Observations
    names: tuple[str, ...]
    start: Array
    scale: Array  # typical size, or the prior's standard deviation
    held: Array  # True where a prior holds the unknown
    sigma: float

    @staticmethod
    def of(
        settings: MachineSettings,
        observations: Observations,
        effects: Iterable[str],
        priors: Mapping[str, float],
        sigma: float,
    ) -> Problem:
        typical = {name: own["typical"] for name, own in parameter_words().items()}
        free = [name for effect in effects for name in parameter_names(effect)]
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
            held=np.array([True] * len(kept) + [False] * len(free)),
            sigma=sigma,
        )

    def values(self, unknowns: Array) -> tuple[Array, dict[str, float]]:
        """The model's values array, and what lies outside of the machine by name."""
        values = values_of(self.settings)
        outside = {}
        for name, value in zip(self.names, self.start + self.scale * unknowns, strict=True):
            if name in NAMES:
                values[NAMES.index(name)] = value
            else:
                outside[name] = float(value)
        return values, outside

    def predict(self, unknowns: Array) -> tuple[Sighting, bool]:
        """What should have been measured, with slopes by the values of `names`, and success."""
        values, outside = self.values(unknowns)
        found = sighted(
            values,
            outside,
            self.observations,
            over_top=self.settings.feed == "top",
            usual_weight=self.settings.sled_weight,
            names=self.names,
        )
        return found, bool((found.found == FOUND).all())

    def errors(self, predicted: Sighting) -> tuple[Array, Array]:
        """Measured less predicted: marks (k, 2) and distances (m,) [mm]."""
        rows = self.observations
        ends = predicted.taped.where[rows.distance_rows]
        spans = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
        return rows.measured - predicted.read.where[rows.mark_rows], rows.distances - spans

    def residuals(self, unknowns: Array) -> Array:
        """Errors over sigma, then how far held unknowns left their priors, in theirs."""
        predicted, reached = self.predict(unknowns)
        if not reached:
            return np.full(self.observations.count + int(self.held.sum()), UNREACHABLE)
        marks, distances = self.errors(predicted)
        return np.concatenate(
            [marks.ravel() / self.sigma, distances / self.sigma, unknowns[self.held]]
        )

    def slopes(self, unknowns: Array) -> Array:
        """Exact slopes of the residuals by the unknowns."""
        predicted, _ = self.predict(unknowns)
        return np.vstack(
            [-self.data_slopes(predicted) / self.sigma, np.eye(len(self.names))[self.held]]
        )

    def data_slopes(self, predicted: Sighting) -> Array:
        """Slopes of all predicted numbers by the unknowns, (2k + m, u) [mm]."""
        rows, taped = self.observations, predicted.taped
        marks = predicted.read.slopes[rows.mark_rows].reshape(rows.measured.size, len(self.names))
        ends, own = taped.where[rows.distance_rows], taped.slopes[rows.distance_rows]
        along = ends[:, 1] - ends[:, 0]
        along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
        spans = np.einsum("mi,miu->mu", along, own[:, 1] - own[:, 0])
        return np.vstack([marks, spans]) * self.scale

    def result(self, unknowns: Array, stated: float | None, *, settled: bool) -> Fit:
        """The finished fit with its intervals and left-out errors."""
        predicted, reached = self.predict(unknowns)
        if not reached:
            raise InputError("with these settings the sled cannot hang where the marks were sent")
        marks, distances = self.errors(predicted)
        slopes = self.data_slopes(predicted) / self.sigma
        normal = slopes.T @ slopes + np.diag(self.held.astype(float))
        covariance = np.linalg.pinv(normal, hermitian=True)
        leverage = slopes @ covariance @ slopes.T
        spent = float(np.trace(leverage))
        errors = np.concatenate([marks.ravel(), distances])
        spare = max(len(errors) - spent, 1e-9)
        sigma = stated or max(float(np.sqrt(errors @ errors / spare)), SMALLEST_SIGMA)
        width = float(stdtrit(spare, 0.975)) if stated is None else 1.96
        # Intervals for the noise that was found; what a prior holds grows no wider than the prior.
        found = slopes.T @ slopes * (self.sigma / sigma) ** 2 + np.diag(self.held.astype(float))
        deviation = np.sqrt(np.diag(np.linalg.pinv(found, hermitian=True))) * self.scale
        values = self.start + self.scale * unknowns
        left_marks, left_distances = _left_out(self.observations.names, marks, distances, leverage)
        fitted, outside = self.values(unknowns)
        return Fit(
            settings=settings_of(fitted, like=self.settings),
            sheet_rotation=outside.get(SHEET_ROTATION, 0.0),
            lab_effects=_by_effect(outside),
            estimates=tuple(
                Estimate(
                    name,
                    float(v),
                    float(v - width * d),
                    float(v + width * d),
                    float(b),
                    float(s) if h else None,
                )
                for name, v, d, b, s, h in zip(
                    self.names, values, deviation, self.start, self.scale, self.held, strict=True
                )
            ),
            predicted=predicted.read.where[self.observations.mark_rows],
            errors=marks,
            left_out_errors=left_marks,
            distance_errors=distances,
            left_out_distance_errors=left_distances,
            spent=spent,
            sigma=sigma,
            sigma_from="residuals" if stated is None else "stated",
            settled=settled,
        )


def _by_effect(outside: Mapping[str, float]) -> dict[str, dict[str, float]]:
    """Parameters of lab effects and sketches by effect and name."""
    found: dict[str, dict[str, float]] = {}
    for name in OUTSIDE_NAMES:
        if name in outside:
            effect, _, parameter = name.rpartition(".")
            found.setdefault(effect, {})[parameter] = outside[name]
    return found


def _left_out(
    names: tuple[str, ...], marks: Array, distances: Array, leverage: Array
) -> tuple[Array, Array]:
    """Errors of each mark or distance in a fit without it: (1 - its own leverage)^-1 error.

    Repeats of a mark are left out together, or each would be predicted by its twin.
    """
    left_marks = np.zeros_like(marks)
    for name in set(names):
        own = np.flatnonzero(np.array(names) == name)
        block = np.stack([2 * own, 2 * own + 1], axis=1).ravel()
        kept = np.eye(len(block)) * (1 + 1e-12) - leverage[np.ix_(block, block)]
        left_marks[own] = np.linalg.solve(kept, marks[own].ravel()).reshape(-1, 2)
    own = np.diag(leverage)[2 * len(marks) :]
    return left_marks, distances / np.maximum(1 - own, 1e-12)
