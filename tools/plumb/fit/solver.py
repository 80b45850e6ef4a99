"""The solver: Gauss-Newton, with steps halved where a whole step overshoots."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from plumb.fit.problem import Linearized, Problem
from plumb.model.predict import Array
from plumb.text.errors import InputError

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
    """The least chi-square over the unknowns in the columns `free` (None: all of them).

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
    """The step to the least of the linearized problem, and by how much it lowers chi-square."""
    slopes = here.slopes[:, columns]
    step = np.linalg.lstsq(slopes, here.residual, rcond=1e-10)[0]
    promised = 2 * step @ (slopes.T @ here.residual) - np.sum((slopes @ step) ** 2)
    return np.asarray(step, dtype=float), float(promised)


def _lower(problem: Problem, here: Linearized, columns: Columns, step: Array) -> Linearized | None:
    """The first of ever shorter steps that lowers chi-square; None if none does."""
    for halvings in range(MOST_HALVINGS):
        unknowns = here.unknowns.copy()
        unknowns[columns] += step / 2**halvings
        there = problem.at(unknowns)
        if there is not None and there.cost < here.cost:
            return there
    return None
