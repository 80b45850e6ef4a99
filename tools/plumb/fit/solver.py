"""The solver: Gauss-Newton, with steps halved where a whole one overshoots."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plumb.fit.problem import Array, Linearized, Problem
from plumb.text.errors import InputError

MOST_STEPS = 30
MOST_HALVINGS = 8
CLOSE_ENOUGH = 1e-12  # of chi-square: a step that promises less is not made
ROUNDING = 1e-13  # share of chi-square that is lost in its sum


@dataclass(frozen=True)
class Solution:
    """Where the search came to rest."""

    at: Linearized
    settled: bool  # False: no step helped any more, or the search stopped at its limit of steps


def solve(
    problem: Problem,
    *,
    free: Array | None = None,
    start: Array | None = None,
    close_enough: float = CLOSE_ENOUGH,
) -> Solution:
    """The least chi-square over the unknowns in the columns `free` (None: all of them).

    Raises InputError where the sled of the start cannot hang.
    """
    here = problem.at(np.zeros(len(problem.names)) if start is None else start)
    if here is None:
        raise InputError("with these settings the sled cannot hang where the marks were sent")
    columns = np.arange(len(problem.names)) if free is None else free
    for _ in range(MOST_STEPS):
        slopes = here.slopes[:, columns]
        step = np.linalg.lstsq(slopes, here.residual, rcond=1e-10)[0]
        promised = 2 * step @ (slopes.T @ here.residual) - np.sum((slopes @ step) ** 2)
        if promised < max(close_enough, ROUNDING * here.cost):
            return Solution(here, settled=True)
        better = _lower(problem, here, columns, step)
        if better is None:
            break
        here = better
    return Solution(here, settled=False)


def _lower(problem: Problem, here: Linearized, columns: Array, step: Array) -> Linearized | None:
    """The first of ever shorter steps that lowers chi-square; None if none does."""
    for halvings in range(MOST_HALVINGS):
        unknowns = here.unknowns.copy()
        unknowns[columns] += step / 2**halvings
        there = problem.at(unknowns)
        if there is not None and there.cost < here.cost:
            return there
    return None
