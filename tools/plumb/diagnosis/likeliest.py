"""The likeliest accounts of the marks, as explanations with their odds.

They are asked for where the tests of single effects have no answer: where the settings leave out
what every machine has, so that it acts next to whatever else is wrong, and where only several
effects together fit.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.explanation import Explanation, explain
from plumb.diagnosis.misfit import LEVEL as MISFIT_LEVEL
from plumb.diagnosis.misfit import misfit_chance
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.sizes import possible
from plumb.diagnosis.weighing import TOGETHER, Weighed, weigh

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
    for effects, share in shares(weighed):
        explanation = explain(frame.board, effects, start=frame)
        if misfit_chance(explanation, noise) > MISFIT_LEVEL and possible(explanation, noise):
            accounts.append(Likely(explanation, share))
    return Likeliest(tuple(accounts), weighed.field_chance)


def shares(weighed: Weighed) -> list[tuple[tuple[str, ...], float]]:
    """Sets of a few effects with how likely each is, likeliest first, as far as LISTED.

    A set with more effects than a likelier one adds nothing that the marks ask for: it counts with
    that one.
    """
    weights = np.exp(weighed.clean - np.logaddexp.reduce(weighed.clean))
    listed: list[tuple[tuple[str, ...], float]] = []
    counted = 0.0
    for i in np.argsort(-weights, kind="stable"):
        effects = weighed.effects[i]
        base = next((j for j, (names, _) in enumerate(listed) if {*names} <= {*effects}), None)
        if base is not None:
            listed[base] = (listed[base][0], listed[base][1] + float(weights[i]))
        elif len(effects) <= TOGETHER and counted < LISTED and len(listed) < MOST:
            listed.append((effects, float(weights[i])))
        counted += float(weights[i])
    listed.sort(key=lambda account: -account[1])
    before = np.cumsum([0.0, *(share for _, share in listed)])
    return [account for account, so_far in zip(listed, before[:-1], strict=True) if so_far < LISTED]
