"""An explanation: the frame and some effects refitted together, and the slopes at that fit."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.board.observations import Observations
from plumb.fit.problem import PRIORS, Checked, Linearized, Problem
from plumb.fit.solver import AT_REST, solve
from plumb.model.catalogue import effect_names, parameter_names
from plumb.settings.machine import MachineSettings

Array = np.ndarray
INVISIBLE = 1e-5  # share of a column's length below which its rest is rounding


@dataclass(frozen=True)
class Board:
    """A measured board with every effect of the catalogue as an unknown."""

    problem: Problem
    effect_columns: Mapping[str, tuple[int, ...]]  # in the catalogue's order

    @staticmethod
    def of(
        settings: MachineSettings,
        rows: Observations,
        *,
        sigma: float,
        priors: Mapping[str, float] = PRIORS,
        checked: Sequence[Checked] = (),
    ) -> Board:
        """The board of a model that starts from these settings; sigma [mm] whitens it."""
        problem = Problem.of(settings, rows, effect_names(), priors, sigma, checked)
        effect_columns = {
            effect: tuple(problem.names.index(name) for name in parameter_names(effect))
            for effect in effect_names()
        }
        return Board(problem, effect_columns)

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

    def columns(self, effects: Iterable[str]) -> Array:
        """Columns of these effects' parameters."""
        return np.array([i for effect in effects for i in self.effect_columns[effect]], dtype=int)

    def with_rows(self, rows: Observations, *, sigma: float | None = None) -> Board:
        """The same machine with other observations, and another sigma [mm] if it is given."""
        sigma = self.sigma if sigma is None else sigma
        return replace(self, problem=replace(self.problem, observations=rows, sigma=sigma))


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
        """What is left, whitened: measured numbers, priors, direct checks."""
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
        """What is left of the measured numbers (n,) [mm]."""
        return self.residual[: self.board.rows.count] * self.board.sigma

    @property
    def rms(self) -> float:
        """Root mean square error of the marks (as vectors), or of distances without marks [mm]."""
        marks = self.board.rows.measured
        counted = self.numbers[: marks.size] if len(marks) else self.numbers
        return float(np.sqrt(counted @ counted / max(len(marks) or len(counted), 1)))

    @property
    def basis(self) -> Array:
        """Orthonormal columns of what was fitted."""
        return span(self.slopes[:, self.free])

    def beyond_fit(self, effects: Iterable[str], basis: Array | None = None) -> Array:
        """Columns of effects without what the fitted columns can imitate."""
        columns = self.slopes[:, self.board.columns(effects)]
        fitted = self.basis if basis is None else basis
        beyond: Array = columns - fitted @ (fitted.T @ columns)
        return beyond


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
