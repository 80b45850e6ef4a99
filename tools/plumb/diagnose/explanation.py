"""An explanation: the frame and some effects refitted together, and the slopes at that fit.

All is whitened: rows are measured numbers over sigma, then the priors of the frame, then what was
checked directly; columns are unknowns in their typical sizes. Then noise alone is a vector of
independent standard normals.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.board.observations import Observations
from plumb.fit.problem import PRIORS, Problem
from plumb.model.catalogue import effect_names, parameter_names
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

Array = np.ndarray
MOST_STEPS = 12
CLOSE_ENOUGH = 1e-5  # of chi-square: a step that gains less is the last
INVISIBLE = 1e-5  # share of a column's length below which its rest is rounding


@dataclass(frozen=True)
class Checked:
    """A number of the machine that was measured directly, like the tape against a steel rule."""

    name: str  # of a parameter or of the frame
    value: float  # [its unit]
    sigma: float  # [its unit]


@dataclass(frozen=True)
class Board:
    """What is diagnosed: a model, what was measured, and the sigma [mm] that whitens it."""

    problem: Problem  # of the frame and every effect
    own: Mapping[str, tuple[int, ...]]  # columns of each effect, in the catalogue's order
    checked: tuple[Checked, ...] = ()  # each is one more row, after those of the priors

    @staticmethod
    def of(
        settings: MachineSettings,
        rows: Observations,
        *,
        sigma: float,
        priors: Mapping[str, float] = PRIORS,
        checked: Sequence[Checked] = (),
    ) -> Board:
        """A board with every effect of the catalogue as an unknown."""
        problem = Problem.of(settings, rows, effect_names(), priors, sigma)
        own = {
            effect: tuple(problem.names.index(name) for name in parameter_names(effect))
            for effect in effect_names()
        }
        return Board(problem, own, tuple(checked))

    @property
    def rows(self) -> Observations:
        """What was measured."""
        return self.problem.observations

    @property
    def sigma(self) -> float:
        """[mm] of one number."""
        return self.problem.sigma

    @property
    def frame(self) -> Array:
        """Columns of the frame and the sheet's pose, which every explanation refits."""
        return np.flatnonzero(self.problem.held)

    def checks(self, unknowns: Array) -> tuple[Array, Array]:
        """What is left of the direct measurements (c,), and their slopes (c, u), both whitened."""
        problem = self.problem
        slopes, left = (
            np.zeros((len(self.checked), len(problem.names))),
            np.zeros(len(self.checked)),
        )
        for i, one in enumerate(self.checked):
            column = problem.names.index(one.name)
            slopes[i, column] = problem.scale[column] / one.sigma
            value = problem.start[column] + problem.scale[column] * unknowns[column]
            left[i] = (one.value - value) / one.sigma
        return left, slopes

    def columns(self, effects: Iterable[str]) -> Array:
        """Columns of these effects' parameters."""
        return np.array([i for effect in effects for i in self.own[effect]], dtype=int)


@dataclass(frozen=True)
class Explanation:
    """Frame and effects as they fit best together."""

    board: Board
    effects: tuple[str, ...]
    unknowns: Array  # (u,) of every name, those not fitted at their start
    residual: Array  # (n + frame,) whitened
    slopes: Array  # (n + frame, u) whitened, by every name
    predicted: Array  # (k, 2) [mm] of the marks
    settled: bool

    @property
    def free(self) -> Array:
        """Columns that were fitted."""
        return np.concatenate([self.board.frame, self.board.columns(self.effects)])

    @property
    def cost(self) -> float:
        """Chi-square of what is left."""
        return float(self.residual @ self.residual)

    @property
    def numbers(self) -> Array:
        """What is left of the measured numbers (n,) [mm]."""
        return self.residual[: self.board.rows.count] * self.board.sigma

    @property
    def rms(self) -> float:
        """Root mean square error of the marks (as vectors), or of distances without marks [mm]."""
        marks = self.board.rows.measured
        own = self.numbers[: marks.size] if len(marks) else self.numbers
        return float(np.sqrt(own @ own / max(len(marks) or len(own), 1)))

    @property
    def basis(self) -> Array:
        """Orthonormal columns of what was fitted."""
        return span(self.slopes[:, self.free])

    def beside(self, effects: Iterable[str], basis: Array | None = None) -> Array:
        """Columns of effects without what the fitted columns can imitate."""
        own = self.slopes[:, self.board.columns(effects)]
        fitted = self.basis if basis is None else basis
        return own - fitted @ (fitted.T @ own)


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
    """Refit the frame and these effects (Gauss-Newton with halved steps where one overshoots)."""
    problem = board.problem
    unknowns = np.zeros(len(problem.names)) if start is None else start.unknowns.copy()
    here = _look(board, effects, unknowns)
    if here is None:
        raise InputError("with these settings the sled cannot hang where the marks were sent")
    for _ in range(MOST_STEPS):
        columns = here.slopes[:, here.free]
        step = np.linalg.lstsq(columns, here.residual, rcond=1e-10)[0]
        promised = 2 * step @ (columns.T @ here.residual) - np.sum((columns @ step) ** 2)
        if promised < CLOSE_ENOUGH:
            return here
        better = _step(board, here, step)
        if better is None:
            break
        here = better
    return replace(here, settled=False)


def _step(board: Board, here: Explanation, step: Array) -> Explanation | None:
    """The first of ever shorter steps that lowers the cost."""
    for _ in range(8):
        unknowns = here.unknowns.copy()
        unknowns[here.free] += step
        there = _look(board, here.effects, unknowns)
        if there is not None and there.cost < here.cost:
            return there
        step = step / 2
    return None


def _look(board: Board, effects: tuple[str, ...], unknowns: Array) -> Explanation | None:
    """Residuals and slopes at these unknowns; None where the sled cannot hang."""
    problem = board.problem
    sighting, reached = problem.predict(unknowns)
    if not reached:
        return None
    marks, distances = problem.errors(sighting)
    errors = np.concatenate([marks.ravel(), distances]) / problem.sigma
    priors = np.eye(len(problem.names))[problem.held]
    left, by_check = board.checks(unknowns)
    return Explanation(
        board=board,
        effects=effects,
        unknowns=unknowns,
        residual=np.concatenate([errors, -unknowns[problem.held], left]),
        slopes=np.vstack([problem.data_slopes(sighting) / problem.sigma, priors, by_check]),
        predicted=sighting.read.where[problem.observations.mark_rows],
        settled=True,
    )
