"""An explanation: the frame and some effects refitted together, and the slopes at that fit."""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy

from plumb.fit.fit import AT_REST, PRIORS, USUAL_SIGMA, Checked, Linearized, Problem, solve
from plumb.fit.inputs import Inputs
from plumb.fit.observations import Observations, different_numbers
from plumb.marks.read import Measurements
from plumb.model.catalogue import effect_names, parameter_names
from plumb.settings import MachineSettings
from plumb.text.errors import InputError
from plumb.text.values import MM, Unit

Array = np.ndarray
INVISIBLE = 1e-5  # share of a column's length below which its rest is rounding


@dataclass(frozen=True)
class Board:
    """A measured board with every effect of the catalogue as an unknown."""

    problem: Problem
    effect_columns: Mapping[str, tuple[int, ...]]  # in the catalogue's order
    usual: int = 0  # the last rows of its direct checks say only what is usual
    unit: Unit = MM  # of the lengths in what is said of it

    @staticmethod
    def of(
        settings: MachineSettings,
        rows: Observations,
        *,
        sigma: float,
        priors: Mapping[str, float] = PRIORS,
        checked: Sequence[Checked] = (),
        unit: Unit = MM,
    ) -> Board:
        """Return the board of a model that starts from these settings; sigma [mm] whitens it."""
        problem = Problem.of(settings, rows, effect_names(), priors, sigma, checked)
        effect_columns = {
            effect: tuple(problem.names.index(name) for name in parameter_names(effect))
            for effect in effect_names()
        }
        return Board(problem, effect_columns, unit=unit)

    @property
    def rows(self) -> Observations:
        """Measured numbers."""
        return self.problem.observations

    @property
    def sigma(self) -> float:
        """[mm] of one number."""
        return self.problem.sigma

    @property
    def frame(self) -> Array:
        """Columns of the frame and the sheet's pose, which every explanation refits."""
        return np.flatnonzero(self.problem.held)

    def columns(self, effects: Iterable[str]) -> Array:
        """Columns of these effects' parameters."""
        return np.array([i for effect in effects for i in self.effect_columns[effect]], dtype=int)

    def with_rows(self, rows: Observations, *, sigma: float | None = None) -> Board:
        """Return the same machine with other observations, and another sigma [mm] if it is
        given.
        """
        sigma = self.sigma if sigma is None else sigma
        return replace(self, problem=replace(self.problem, observations=rows, sigma=sigma))

    @cached_property
    def fitted(self) -> Explanation:
        """The frame alone, as it fits best."""
        return explain(self)

    @property
    def usual_checks(self) -> tuple[Checked, ...]:
        """Sizes that are held near their usual values."""
        count = len(self.problem.checked)
        return self.problem.checked[count - self.usual :]

    def with_usual(self, checks: Sequence[Checked]) -> Board:
        """Return the same board on which some numbers are held near what is usual."""
        if not checks:
            return self
        made = self.problem.checked[: len(self.problem.checked) - self.usual]
        return replace(
            self, problem=replace(self.problem, checked=(*made, *checks)), usual=len(checks)
        )


@dataclass(frozen=True)
class Explanation:
    """Frame and effects as they fit best together."""

    board: Board
    effects: tuple[str, ...]
    at: Linearized  # unknowns that were not fitted are at their start
    settled: bool

    @property
    def unknowns(self) -> Array:
        """Of every name (u,)."""
        return self.at.unknowns

    @property
    def residual(self) -> Array:
        """Residuals, whitened: measured numbers, priors, direct checks."""
        return self.at.residual

    @property
    def slopes(self) -> Array:
        """Of what is predicted, whitened, by every name (rows, u)."""
        return self.at.slopes

    @property
    def cost(self) -> float:
        """Chi-square of what is left."""
        return self.at.cost

    @property
    def free(self) -> Array:
        """Columns that were fitted."""
        return free_columns(self.board, self.effects)

    @property
    def numbers(self) -> Array:
        """Residuals of the measured numbers (n,) [mm]."""
        return self.residual[: self.board.rows.count] * self.board.sigma

    @property
    def rms(self) -> float:
        """Root mean square error of the marks (as vectors), or of distances without marks [mm]."""
        return self.board.rows.rms_of(self.numbers)

    @cached_property
    def basis(self) -> Array:
        """Orthonormal columns of what was fitted."""
        return span(self.slopes[:, self.free])

    @cached_property
    def covariance(self) -> Array:
        """Of what was fitted, for readings with the noise of the board."""
        return covariance_of(self.slopes[:, self.free])

    def beyond_fit(self, effects: Iterable[str]) -> Array:
        """Columns of effects without what the fitted columns can imitate."""
        return beyond(self.basis, self.slopes[:, self.board.columns(effects)])

    def with_effects(self, effects: tuple[str, ...]) -> Explanation:
        """Return about what a refit with these effects would be, by the slopes here."""
        free = free_columns(self.board, effects)
        step = np.linalg.lstsq(self.slopes[:, free], self.residual, rcond=1e-10)[0]
        unknowns = self.unknowns.copy()
        unknowns[free] += step
        residual = self.residual - self.slopes[:, free] @ step
        at = replace(self.at, unknowns=unknowns, residual=residual)
        return Explanation(self.board, effects, at, settled=True)


def beyond(basis: Array, columns: Array) -> Array:
    """Return columns without what orthonormal columns can imitate."""
    left: Array = columns - basis @ (basis.T @ columns)
    return left


def covariance_of(columns: Array) -> Array:
    """Return the covariance of unknowns with these whitened columns."""
    return np.linalg.pinv(columns.T @ columns, rcond=1e-12, hermitian=True)


def span(columns: Array, *, against: Array | None = None) -> Array:
    """Orthonormal basis of columns; what is tiny against the columns `against` is rounding."""
    if columns.shape[1] == 0:
        return columns
    lengths = np.linalg.norm(columns if against is None else against, axis=0)
    felt = columns[:, lengths > 0] / lengths[lengths > 0]
    left, sizes, _ = np.linalg.svd(felt, full_matrices=False)
    return left[:, sizes > INVISIBLE]


def explain(
    board: Board, effects: tuple[str, ...] = (), *, start: Explanation | None = None
) -> Explanation:
    """Refit the frame and these effects."""
    solution = solve(
        board.problem,
        free=free_columns(board, effects),
        start=None if start is None else start.unknowns,
        at_start=start.at if start and start.board.problem is board.problem else None,
        close_enough=AT_REST,
    )
    return Explanation(board, effects, solution.at, solution.settled)


def free_columns(board: Board, effects: Iterable[str]) -> Array:
    """Columns of the frame and of these effects."""
    return np.concatenate([board.frame, board.columns(effects)])


# The measured board of a diagnosis: readings as numbers with weights, every effect an unknown.

FEWEST_NUMBERS = 6  # three marks: below that the frame explains everything


def measured_board(inputs: Inputs) -> Board:
    """Return the board of these inputs; raises InputError for too few marks, and for bad
    targets.
    """
    model, rows = inputs.model_and_observations()
    _refuse_too_few(inputs.measurements, rows)
    return board_of(inputs, model, rows)


def board_of(inputs: Inputs, model: MachineSettings, rows: Observations) -> Board:
    """Return the board of these observations, whitened by what is known of a reading."""
    sigma = inputs.stated.sigma if inputs.stated else USUAL_SIGMA
    return Board.of(
        model, rows, sigma=sigma, priors=inputs.priors, checked=inputs.checked, unit=inputs.unit
    )


def _refuse_too_few(measurements: Measurements, rows: Observations) -> None:
    count = different_numbers(measurements, rows)
    if count < FEWEST_NUMBERS:
        raise InputError(
            f"{measurements.source}: {count} measured numbers are too few for a diagnosis; measure "
            "at least three marks, better nine or more all over the sheet"
        )


# Gaussian processes, which no mechanics made, as they would be measured.


def gaussian_process_columns(
    frame: Explanation, widths: Sequence[float], least: float
) -> Iterator[Array]:
    """Yield for each width what independent normals move of the measured numbers (n, c) [mm],
    together as a Gaussian process of 1 mm each way does.

    widths: its length scales, in halves of what the marks span. least [mm^2]: what the columns
    may leave out of its variance at any place.
    """
    places = places_of(frame)
    half = half_span(places)
    apart = np.sum(((places[:, np.newaxis] - places[np.newaxis]) / half) ** 2, axis=2)
    for width in widths:
        root = _root(np.exp(-apart / (2 * width**2)), least)
        yield measured_columns(root, places, frame.board.rows)


def places_of(frame: Explanation) -> Array:
    """Return where each visit is by a fit (visits, 2) [mm]."""
    sighting, _ = frame.board.problem.predict(frame.unknowns)
    where: Array = sighting.taped.where
    return where


def half_span(places: Array) -> Array:
    """Halves (2,) [mm] of what places span."""
    half: Array = np.maximum(np.ptp(places, axis=0) / 2, 1.0)
    return half


def measured_columns(moved: Array, places: Array, rows: Observations) -> Array:
    """Columns (n, 2 c) of the measured numbers; each column of `moved` (visits, c) [mm] acts once
    to the right and once upwards."""
    along = places[rows.distance_rows]
    along = along[:, 1] - along[:, 0]
    along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
    stretched = moved[rows.distance_rows[:, 1]] - moved[rows.distance_rows[:, 0]]
    columns = np.zeros((rows.count, 2, moved.shape[1]))
    for axis in (0, 1):
        columns[axis : rows.measured.size : 2, axis] = moved[rows.mark_rows]
        columns[rows.measured.size :, axis] = along[:, [axis]] * stretched
    return columns.reshape(rows.count, -1)


def _root(covariance: Array, least: float) -> Array:
    """Columns whose covariance it is, but for `least`: few where places lie close together."""
    lower, pivots, rank, _ = scipy.linalg.lapack.dpstrf(covariance, tol=least, lower=1)
    root = np.zeros((len(covariance), rank))
    root[pivots - 1] = np.tril(lower)[:, :rank]
    return root
