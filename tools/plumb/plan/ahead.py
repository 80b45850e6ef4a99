"""What a planned measurement would add: rows of slopes below those of the marks so far."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.diagnosis.explanation import Explanation
from plumb.model.predict import FOUND
from plumb.plan.planned_visits import Visits

Array = np.ndarray


@dataclass(frozen=True)
class Check:
    """A number of the machine that would be measured directly."""

    name: str  # of a parameter or of the frame
    sigma: float  # [its unit]


@dataclass(frozen=True)
class Ahead:
    """All rows there would be, whitened: those so far, planned marks, planned checks."""

    slopes: Array  # (rows, u)
    so_far: int  # rows there are already
    marks: Array  # (rows,) True for what is read of marks and distances, false for priors, checks
    where: Array  # (planned marks * 2,) [sigmas] predicted; NaN where the sled could not hang


class Planned:
    """A planned measurement; what it adds by an explanation is worked out once."""

    def __init__(self, visits: Visits, checks: Sequence[Check] = ()) -> None:
        self.visits, self.checks = visits, tuple(checks)
        self._known: dict[int, tuple[Explanation, Ahead]] = {}

    def ahead(self, at: Explanation) -> Ahead:
        """The rows after the measurement, by the slopes of an explanation."""
        if id(at) not in self._known:
            self._known[id(at)] = at, ahead(at, self.visits, self.checks)
        return self._known[id(at)][1]


def ahead(at: Explanation, visits: Visits, checks: Sequence[Check] = ()) -> Ahead:
    """The rows after a planned measurement, by the slopes of an explanation."""
    where, marks = _seen(at, visits)
    checked = check_slopes(at, checks)
    read = np.zeros(len(at.slopes), dtype=bool)
    read[: at.board.rows.count] = True
    return Ahead(
        slopes=np.vstack([at.slopes, marks.reshape(-1, at.slopes.shape[1]), checked]),
        so_far=len(at.slopes),
        marks=np.concatenate([read, np.full(2 * len(visits), True), np.full(len(checks), False)]),
        where=where,
    )


def visit_slopes(at: Explanation, visits: Visits) -> Array:
    """Whitened slopes (n, 2, u) of visits at an explanation; zero, so that nothing is expected of
    it, for a visit where the explanation's sled could not hang."""
    return _seen(at, visits)[1]


def _seen(at: Explanation, visits: Visits) -> tuple[Array, Array]:
    """Where visits would be read (n * 2,), and the slopes of that (n, 2, u), both whitened."""
    problem = replace(at.board.problem, observations=visits.rows())
    width = len(problem.names)
    if not len(visits):
        return np.zeros(0), np.zeros((0, 2, width))
    sighting, _ = problem.predict(at.unknowns)
    slopes = (problem.data_slopes(sighting) / problem.sigma).reshape(-1, 2, width)
    hangs = sighting.outcome == FOUND
    where = np.where(hangs[:, np.newaxis], sighting.read.where / problem.sigma, np.nan)
    return where.ravel(), np.where(hangs[:, np.newaxis, np.newaxis], slopes, 0.0)


def check_slopes(at: Explanation, checks: Sequence[Check]) -> Array:
    """Whitened slopes (c, u) of numbers that are measured directly."""
    problem = at.board.problem
    rows = np.zeros((len(checks), len(problem.names)))
    for i, check in enumerate(checks):
        column = problem.names.index(check.name)
        rows[i, column] = problem.scale[column] / check.sigma
    return rows
