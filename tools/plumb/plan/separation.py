"""How well two effects are told apart by a plan, and the visits that tell them apart best.

lambda = squared length, in sigmas, of what one effect draws and neither the refitted frame nor the
other effect can imitate. A pair is told apart nearly always at 12, so more of it counts no more:
no single pair may eat the whole effort (T-optimal design, capped).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.diagnose.explanation import Board, Explanation
from plumb.plan.ahead import visit_slopes
from plumb.plan.case import Case, Hypothesis
from plumb.plan.visits import Visits

Array = np.ndarray
ENOUGH = 12.0  # lambda at which two effects are told apart in more than nine of ten cases
MOST_TRUTHS = 6  # hypotheses among which visits are chosen
_RIDGE = 1e-9  # for unknowns that nothing feels


@dataclass(frozen=True)
class Pair:
    """What is there, and what must not be able to imitate it."""

    at: Explanation
    drawn: Array  # (u, d) what is there, by unknowns
    fitted: Array  # columns that are refitted
    weight: float


def pairs_of(case: Case) -> list[Pair]:
    """Every suspect against every other; where nothing is proved, every effect against the frame
    alone."""
    board, truths = case.board, case.hypotheses[:MOST_TRUTHS]
    if case.verdict == "nothing_provable":
        return [Pair(one.at, drawn_by(one), board.frame, one.weight) for one in case.hypotheses]
    if len(truths) == 1:
        one = truths[0]
        rivals = [name for name in case.singles if name not in one.effects]
        return [Pair(one.at, drawn_by(one), _fitted(board, (rival,)), 1.0) for rival in rivals]
    return [
        Pair(one.at, drawn_by(one), _fitted(board, other.effects), one.weight + other.weight)
        for one in truths
        for other in truths
        if one is not other
    ]


def drawn_by(one: Hypothesis) -> Array:
    """What a hypothesis draws (u, d): as it fits, or each parameter at its typical size."""
    own = one.at.board.columns(one.effects)
    width = len(one.at.unknowns)
    if not one.at.effects:
        return np.eye(width)[:, own]
    drawn = np.zeros((width, 1))
    drawn[own, 0] = one.at.unknowns[own]
    return drawn


def _fitted(board: Board, effects: Sequence[str]) -> Array:
    return np.concatenate([board.frame, board.columns(effects)])


def apart(slopes: Array, drawn: Array, fitted: Array) -> float:
    """lambda of what is drawn beside the fitted columns, both by these whitened slopes."""
    both = np.hstack([slopes[:, fitted], slopes @ drawn])
    return float(_schur((both.T @ both)[np.newaxis], drawn.shape[1])[0])


def _schur(gram: Array, last: int) -> Array:
    """Trace of what is left of the last columns beside the first, of Gram matrices (v, p, p)."""
    first = gram.shape[1] - last
    fitted, mixed = gram[:, :first, :first], gram[:, :first, first:]
    size = np.trace(fitted, axis1=1, axis2=2)[:, np.newaxis, np.newaxis]
    solved = np.linalg.solve(fitted + _RIDGE * size * np.eye(first), mixed)
    taken = np.einsum("vpd,vpd->v", mixed, solved)
    return np.maximum(np.trace(gram[:, first:, first:], axis1=1, axis2=2) - taken, 0.0)


class Chooser:
    """Chooses visits of a pool that raise the capped lambdas most."""

    def __init__(self, case: Case, pool: Visits) -> None:
        """Work out what each visit of the pool adds to each pair."""
        self._pairs = pairs_of(case)
        slopes = {id(pair.at): visit_slopes(pair.at, pool) for pair in self._pairs}
        self._start, self._each = [], []
        for pair in self._pairs:
            now = np.hstack([pair.at.slopes[:, pair.fitted], pair.at.slopes @ pair.drawn])
            own = slopes[id(pair.at)]
            more = np.concatenate([own[:, :, pair.fitted], own @ pair.drawn], axis=2)
            self._start.append(now.T @ now)
            self._each.append(np.einsum("vkp,vkq->vpq", more, more))

    def worth(self, chosen: Sequence[int]) -> float:
        """Sum of the capped lambdas with these visits."""
        none = np.zeros(0, dtype=int)
        return float(self._worths(list(chosen), none)[0])

    def best(self, allowed: Sequence[int], count: int) -> list[int]:
        """So many visits of those allowed, none twice: one after the other, then each exchanged
        once."""
        options, chosen = np.array(allowed, dtype=int), []
        for _ in range(count):
            chosen.append(self._best_beside(chosen, options))
        for i in range(count):
            others = chosen[:i] + chosen[i + 1 :]
            other = self._best_beside(others, options)
            if self.worth([*others, other]) > self.worth(chosen) + 1e-9:
                chosen = [*others, other]
        return chosen

    def _best_beside(self, chosen: list[int], options: Array) -> int:
        left = options[~np.isin(options, chosen)]
        return int(left[np.argmax(self._worths(chosen, left))])

    def _worths(self, chosen: list[int], options: Array) -> Array:
        """The worth of the chosen visits with each of the options, or without any."""
        total = np.zeros(max(len(options), 1))
        for pair, start, each in zip(self._pairs, self._start, self._each, strict=True):
            gram = start + each[chosen].sum(axis=0)
            grams = gram + (each[options] if len(options) else np.zeros((1, *gram.shape)))
            total += pair.weight * np.minimum(_schur(grams, pair.drawn.shape[1]), ENOUGH)
        return total
