"""One least-squares problem: the frame within its priors, parameters of effects, direct checks.

All is whitened, so that noise alone is a vector of independent standard normals. Rows are the
measured numbers over sigma, then the priors, then what was checked directly; columns are the
unknowns in typical sizes. A residual is measured - predicted, and slopes are those of what is
predicted: small changes `u` of the unknowns take `slopes @ u` off the residual.

The frame is held by stated priors: nine marks cannot tell spacing, rotation radius and chain
zeros apart, so what was measured on the machine stays near its measured value. The radius is a
solid part and is not fitted at all.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from plumb.fit.observations import SHEET_ROTATION, Observations, Sighting, round_priors, sighted
from plumb.model.catalogue import parameter_names, parameter_words
from plumb.model.predict import FOUND, NAMES, Array, values_of, with_parameters
from plumb.settings.machine import FRAME_FIELDS, MachineSettings
from plumb.text.errors import InputError, to_do
from plumb.text.values import refuse_unknown

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
