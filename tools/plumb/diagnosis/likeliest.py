"""The likeliest accounts of the marks, as explanations with their odds.

They are asked for where the tests of single effects have no answer: where the settings leave out
what every machine has, so that it acts next to whatever else is wrong, and where only several
effects together fit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache

import numpy as np

from plumb.diagnosis.explanation import Explanation, explain
from plumb.diagnosis.misfit import LEVEL as MISFIT_LEVEL
from plumb.diagnosis.misfit import misfit_chance
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.sizes import possible
from plumb.diagnosis.weighing import TOGETHER, weigh
from plumb.model.ranks import ascending

Array = np.ndarray
LISTED = 0.95  # of all weight that the listed accounts hold together
MOST = 8  # accounts


@dataclass(frozen=True)
class Likely:
    """An explanation, and how likely it is among all accounts."""

    explanation: Explanation
    share: float


@dataclass(frozen=True)
class Likeliest:
    """What the marks most likely show."""

    accounts: tuple[Likely, ...]  # likeliest first, of sizes that real machines can have
    field_chance: float  # how likely a field is that no effect of the library draws


def likeliest(frame: Explanation, felt: Sequence[str], noise: Noise) -> Likeliest:
    """The accounts that leave no misfit, refitted in full."""
    weighed = weigh(frame, felt, noise, with_slips=False)
    accounts = []
    for listed in listing(weighed.effects, weighed.clean):
        explanation = explain(frame.board, listed.effects, start=frame)
        if misfit_chance(explanation, noise) > MISFIT_LEVEL and possible(explanation, noise):
            accounts.append(Likely(explanation, listed.share))
    return Likeliest(tuple(accounts), weighed.field_chance)


@dataclass(frozen=True)
class Listed:
    """A set of effects that is worth naming."""

    effects: tuple[str, ...]
    share: float  # how likely it is, with all sets that count with it
    members: tuple[int, ...]  # these sets, and itself, by their places among all


def listing(effects: tuple[tuple[str, ...], ...], evidences: Array) -> list[Listed]:
    """Sets of a few effects, likeliest first, as far as LISTED; by the logarithms of the weights of
    all sets.

    A set with more effects than a likelier set adds nothing that the marks ask for: it counts with
    that one.
    """
    weights = np.exp(evidences - np.logaddexp.reduce(evidences))
    order = ascending(-evidences)
    before = np.cumsum(weights[order]) - weights[order]
    within = _within(effects)
    bases: list[int] = []
    for i in order[before < LISTED]:
        if len(bases) < MOST and len(effects[i]) <= TOGETHER and not within[bases, i].any():
            bases.append(int(i))
    if not bases:
        return []
    # Each set counts with the likeliest that it holds.
    holds = within[bases]
    belongs = np.where(holds.any(axis=0), holds.argmax(axis=0), -1)
    members = [np.flatnonzero(belongs == place) for place in range(len(bases))]
    counted = np.array([weights[each].sum() for each in members])
    best = ascending(-counted)
    so_far = np.cumsum(counted[best]) - counted[best]
    return [
        Listed(effects[bases[i]], float(counted[i]), tuple(members[i].tolist()))
        for i in best[so_far < LISTED]
    ]


@cache
def _within(effects: tuple[tuple[str, ...], ...]) -> Array:
    """Whether each set (rows) is part of each (columns)."""
    names = sorted({name for each in effects for name in each})
    has = np.array([[name in each for name in names] for each in effects], dtype=int)
    part: Array = has @ (1 - has).T == 0
    return part
