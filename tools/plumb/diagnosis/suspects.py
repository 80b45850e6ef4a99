"""Suspects: explanations to which nothing else in the library adds more than noise would.

Single effects are tried first, then two at once, then three, until one stands whose sizes a real
machine can have. Impossible suspects stay in the list, marked: they are the sign of a stand-in.

This is the max-gain test turned round. Whatever the truth is, it stays in the set in about 95 % of
all cases; look-alikes protect each other, so they stay together; better data make the set
smaller.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import scipy

from plumb.diagnosis.explanation import Explanation, explain, span
from plumb.diagnosis.gain import LEVEL, bases_beyond_fit, complete
from plumb.diagnosis.imitation import BELIEVABLE, chance_of_imitation
from plumb.diagnosis.misfit import LEVEL as MISFIT_LEVEL
from plumb.diagnosis.misfit import library_misfit_chance, misfit_chance, spare_numbers
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.significance import surprise, tail
from plumb.diagnosis.sizes import possible
from plumb.model.ranks import greatest, ranked

MOST_REFITTED = 12  # combinations that are refitted in full, the best by the frame's slopes
UNHEARD = np.log(0.01)  # of the chance that a machine is beyond all that the catalogue knows
FEWEST_SPARE = 1.5  # measured numbers that an explanation must leave over to count as one
MOST_TOGETHER = 3  # effects at once; the marks of one sheet hardly carry more


@dataclass(frozen=True)
class Survivor:
    """An explanation that stood its test."""

    explanation: Explanation
    possible: bool  # whether the intervals of all its sizes reach what a real machine can have

    @property
    def worth(self) -> float:
        """How much is to be thought of it: the marks' word, and what is known of real machines."""
        return worth(self.explanation) + (0.0 if self.possible else UNHEARD)


@dataclass(frozen=True)
class Suspects:
    """All explanations that stood their tests, best first."""

    survivors: tuple[Survivor, ...]
    library_fits: bool  # whether all effects together could explain the marks
    chance: float = 0.0  # that as many effects would also explain what none of them made

    @property
    def believable(self) -> bool:
        """Whether something stood that is not of a kind that fits anything."""
        return bool(self.survivors) and self.chance <= BELIEVABLE


def find_suspects(
    frame: Explanation, singles: Sequence[Explanation], felt: Sequence[str], noise: Noise
) -> Suspects:
    """Single effects, then pairs, then three at once, until a possible set stands."""
    survivors = _standing(singles, felt, noise)
    library_fits = library_misfit_chance(frame, noise) > MISFIT_LEVEL
    chance = 0.0
    for size in range(2, MOST_TOGETHER + 1):
        if any(survivor.possible for survivor in survivors) or not library_fits:
            break
        together = [
            explain(frame.board, effects, start=frame)
            for effects in _promising(frame, felt, size, noise)
        ]
        standing = _standing(together, felt, noise)
        # More effects draw anything better: where fewer stand they count only if possible.
        alone = not survivors
        survivors += [survivor for survivor in standing if survivor.possible or alone]
        if any(survivor.possible for survivor in survivors):
            chance = chance_of_imitation(frame, felt, size, noise, real=True)
    survivors = ranked(survivors, lambda survivor: -survivor.worth)
    if survivors and not any(survivor.possible for survivor in survivors):
        most = max(len(survivor.explanation.effects) for survivor in survivors)
        chance = chance_of_imitation(frame, felt, most, noise, real=False)
    return Suspects(tuple(survivors), library_fits, chance)


def _standing(
    explanations: Sequence[Explanation], felt: Sequence[str], noise: Noise
) -> list[Survivor]:
    """Explanations that leave no misfit and to which nothing can be added, best first."""
    standing = []
    for explanation in explanations:
        if spare_numbers(explanation) < FEWEST_SPARE:
            continue  # as many unknowns as numbers explain anything
        if misfit_chance(explanation, noise) > MISFIT_LEVEL and complete(explanation, felt, noise):
            standing.append(Survivor(explanation, possible(explanation, noise)))
    return ranked(standing, lambda survivor: -survivor.worth)


def best_at_hand(frame: Explanation, felt: Sequence[str]) -> tuple[str, ...]:
    """Effects to go on with where no explanation stands: added one by one while they are worth it.

    Leaving a large effect out because a small effect is unknown would help nobody.
    """
    best, chosen = worth(frame), frame
    while len(chosen.effects) < MOST_TOGETHER:
        more = [
            explain(frame.board, (*chosen.effects, name), start=chosen)
            for name in felt
            if name not in chosen.effects
        ]
        values = [worth(candidate) for candidate in more]
        if not more or max(values) <= best:
            break
        best, chosen = max(values), more[greatest(values)]
    return chosen.effects


def worth(explanation: Explanation) -> float:
    """Logarithm of how likely the marks are by an explanation, over all sizes that it might have.

    Sizes are taken to be spread like Cauchy's distribution about zero, half of them below the
    typical: that favours usual sizes and forbids none. The integral over sizes is Laplace's.
    """
    board, effects = explanation.board, explanation.effects
    columns = explanation.slopes[:, board.columns(effects)]
    fitted = span(explanation.slopes[:, board.frame])
    columns = columns - fitted @ (fitted.T @ columns)
    count = columns.shape[1]
    spread = np.linalg.slogdet(np.eye(count) + columns.T @ columns)[1]
    prior = sum(_log_cauchy(explanation.unknowns[board.columns([name])]) for name in effects)
    return float(prior - (explanation.cost + spread - count * np.log(2 * np.pi)) / 2)


def _log_cauchy(sizes: np.ndarray) -> float:
    """Logarithm of the density of sizes in typical sizes."""
    half = (1 + len(sizes)) / 2
    gammas = scipy.special.gammaln(half) - scipy.special.gammaln(0.5)
    constant = gammas - len(sizes) / 2 * np.log(np.pi)
    return float(constant - half * np.log1p(sizes @ sizes))


def _promising(
    frame: Explanation, felt: Sequence[str], size: int, noise: Noise
) -> list[tuple[str, ...]]:
    """Combinations that might stand, by the slopes at the frame's fit; best first.

    Their limit is Bonferroni's, which is wider than the simulated one that decides later.
    """
    bases = bases_beyond_fit(frame, felt)
    limit = LEVEL / len(felt) / 10
    promising = []
    for effects in combinations(felt, size):
        fitted = span(np.hstack([bases[name] for name in effects]))
        left = frame.residual - fitted @ (fitted.T @ frame.residual)
        worst = 1.0
        for name in felt:
            if name in effects:
                continue
            rest = bases[name] - fitted @ (fitted.T @ bases[name])
            more = span(rest)
            gain = float(np.sum((more.T @ left) ** 2))
            worst = min(worst, float(tail(gain, max(more.shape[1], 1), noise.degrees)))
            if worst < limit:
                break
        if worst >= limit:
            promising.append((float(left @ left) + 2 * fitted.shape[1], effects))
    return [effects for _, effects in ranked(promising, lambda each: each[0])[:MOST_REFITTED]]


def evidence(single: Explanation, frame: Explanation, noise: Noise) -> float:
    """How surprising the effect's gain over the frame is after its full refit."""
    visible = single.basis.shape[1] - frame.basis.shape[1]
    return surprise(frame.cost - single.cost, visible, noise.degrees)
