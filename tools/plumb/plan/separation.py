"""A measure of how well a plan distinguishes two effects, and the visits that do it best.

lambda = squared length, in sigmas, of what one effect draws and neither the refitted frame nor the
other effect can imitate. A pair is distinguished nearly always at 12, so more of it counts no more:
no single pair may eat the whole effort (T-optimal design, capped).
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.explanation import Board, Explanation
from plumb.model.catalogue import every_effect
from plumb.model.plain import greatest
from plumb.plan.case import Case, Hypothesis, seen_on
from plumb.plan.planned_visits import Visits
from plumb.text.values import in_both_units

Array = np.ndarray
ENOUGH = 12.0  # lambda at which two effects are distinguished in more than nine of ten cases
MOST_TRUTHS = 6  # hypotheses among which visits are chosen
_RIDGE = 1e-9  # for unknowns that nothing feels


@dataclass(frozen=True)
class Pair:
    """An effect that acts, and the effects that must not be able to imitate it."""

    at: Explanation
    drawn: Array  # (u, d) what is there, by unknowns
    fitted: Array  # columns that are refitted
    weight: float


def pairs_of(case: Case) -> list[Pair]:
    """Return every suspect against every other; where nothing is proved, every effect against the
    frame alone.
    """
    board, truths = case.board, case.hypotheses[:MOST_TRUTHS]
    if case.verdict == "nothing_provable":
        return [
            Pair(hypothesis.at, drawn_by(hypothesis), board.frame, hypothesis.weight)
            for hypothesis in case.hypotheses
        ]
    if len(truths) == 1:
        truth = truths[0]
        rivals = [name for name in case.posterior.felt if name not in truth.effects]
        return [Pair(truth.at, drawn_by(truth), _fitted(board, (rival,)), 1.0) for rival in rivals]
    return [
        Pair(truth.at, drawn_by(truth), _fitted(board, other.effects), truth.weight + other.weight)
        for truth in truths
        for other in truths
        if truth is not other
    ]


def drawn_by(hypothesis: Hypothesis) -> Array:
    """Return what a hypothesis draws (u, d): as it fits, or each parameter at its typical size."""
    columns = hypothesis.at.board.columns(hypothesis.effects)
    width = len(hypothesis.at.unknowns)
    if not hypothesis.at.effects:
        return np.eye(width)[:, columns]
    drawn = np.zeros((width, 1))
    drawn[columns, 0] = hypothesis.at.unknowns[columns]
    return drawn


def _fitted(board: Board, effects: Sequence[str]) -> Array:
    return np.concatenate([board.frame, board.columns(effects)])


def apart(slopes: Array, drawn: Array, fitted: Array) -> float:
    """lambda of what is drawn beyond the fitted columns, both by these whitened slopes."""
    both = np.hstack([slopes[:, fitted], slopes @ drawn])
    return float(_schur((both.T @ both)[np.newaxis], drawn.shape[1])[0])


def _schur(gram: Array, last: int) -> Array:
    """Trace of what is left of the last columns beyond the first, of Gram matrices (v, p, p)."""
    first = gram.shape[1] - last
    fitted, mixed = gram[:, :first, :first], gram[:, :first, first:]
    size = np.trace(fitted, axis1=1, axis2=2)[:, np.newaxis, np.newaxis]
    solved = np.linalg.solve(fitted + _RIDGE * size * np.eye(first), mixed)
    taken = np.einsum("vpd,vpd->v", mixed, solved)
    left: Array = np.maximum(np.trace(gram[:, first:, first:], axis1=1, axis2=2) - taken, 0.0)
    return left


class Chooser:
    """Chooses visits of a pool that raise the capped lambdas most."""

    def __init__(self, case: Case, pool: Visits) -> None:
        """Work out what each visit of the pool adds to each pair."""
        self._pairs = pairs_of(case)
        slopes = {id(pair.at): seen_on(pair.at, pool)[1] for pair in self._pairs}
        self._start, self._each = [], []
        for pair in self._pairs:
            now = np.hstack([pair.at.slopes[:, pair.fitted], pair.at.slopes @ pair.drawn])
            of_visits = slopes[id(pair.at)]
            more = np.concatenate([of_visits[:, :, pair.fitted], of_visits @ pair.drawn], axis=2)
            self._start.append(now.T @ now)
            self._each.append(np.einsum("vkp,vkq->vpq", more, more))

    def worth(self, chosen: Sequence[int]) -> float:
        """Sum of the capped lambdas with these visits."""
        none = np.zeros(0, dtype=int)
        return float(self._worths(list(chosen), none)[0])

    def best(self, allowed: Sequence[int], count: int) -> list[int]:
        """Return a number of visits of those allowed, none twice: one after the other, then each
        replaced once.
        """
        options = np.array(allowed, dtype=int)
        chosen: list[int] = []
        for _ in range(count):
            chosen.append(self._best_with(chosen, options))
        for i in range(count):
            others = chosen[:i] + chosen[i + 1 :]
            other = self._best_with(others, options)
            if self.worth([*others, other]) > self.worth(chosen) + 1e-9:
                chosen = [*others, other]
        return chosen

    def _best_with(self, chosen: list[int], options: Array) -> int:
        left = options[~np.isin(options, chosen)]
        return int(left[greatest(self._worths(chosen, left))])

    def _worths(self, chosen: list[int], options: Array) -> Array:
        """Return the worth of the chosen visits with each of the options, or without any."""
        total = np.zeros(max(len(options), 1))
        for pair, start, each in zip(self._pairs, self._start, self._each, strict=True):
            gram = start + each[chosen].sum(axis=0)
            grams = gram + (each[options] if len(options) else np.zeros((1, *gram.shape)))
            total += pair.weight * np.minimum(_schur(grams, pair.drawn.shape[1]), ENOUGH)
        return total


# Numbers of the machine that its owner can measure directly, how well, and how long it takes.
#
# Effects bring their checks along. The accuracies are what a careful owner gets with the tool that
# is named.


@dataclass(frozen=True)
class NumberCheck:
    """Direct measurements of the machine's numbers, without marks on a sheet."""

    title: str
    steps: str  # what to do, and how exactly
    value: str  # how the numbers follow from what was measured
    minutes: float
    sigmas: Mapping[str, float]  # of each parameter, or number of the frame [its unit]


def effect_checks() -> dict[str, NumberCheck]:
    """Return the checks of all effects that have any."""
    return {
        effect["name"]: NumberCheck(
            **effect["check"],
            sigmas={
                parameter["name"]: parameter["sigma"]
                for parameter in effect["parameters"]
                if parameter["sigma"]
            },
        )
        for effect in every_effect()
        if effect["check"]
    }


FRAME_CHECKS: Mapping[str, NumberCheck] = {
    "motor_gap": NumberCheck(
        "the gap between the motors",
        in_both_units(
            "Measure between the sprocket centres to {1 mm|0.039 inch}, with a chain pulled tight "
            "or a steel tape."
        ),
        "mm",
        10.0,
        {"motor_gap": 1.0},
    ),
    "motor_height": NumberCheck(
        "the motors above the top edge of the sheet",
        in_both_units(
            "Measure from the sheet's top edge up to the sprocket centres to {1 mm|0.039 inch}, on "
            "both sides."
        ),
        "the mean of both sides and half the sheet's height, mm",
        8.0,
        {"motor_height": 1.0},
    ),
    "rotation_radius": NumberCheck(
        "the rotation radius",
        in_both_units(
            "Measure from the bit to the first link pin of each chain to {0.5 mm|0.02 inch}."
        ),
        "mm",
        5.0,
        {"rotation_radius": 0.5},
    ),
}
