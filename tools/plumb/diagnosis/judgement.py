"""The verdict: what stands its tests, and what to go on with."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import cache
from itertools import combinations

import numpy as np
import scipy

from plumb.diagnosis.clean import CleanReadings
from plumb.diagnosis.explanation import Explanation, explain, negative_log_p, span, tail
from plumb.diagnosis.gain import (
    BELIEVABLE,
    LEVEL,
    Search,
    bases_beyond_fit,
    chance_of_imitation,
    complete,
)
from plumb.diagnosis.noise import LEVEL as MISFIT_LEVEL
from plumb.diagnosis.noise import Noise, library_misfit_chance, misfit_chance, spare_numbers
from plumb.diagnosis.sizes import possible
from plumb.diagnosis.weighing import TOGETHER, left_out, weigh
from plumb.model.plain import ascending, greatest, ranked

EVEN = 0.5  # chance of a Gaussian process beyond which it is likelier than all else


@dataclass(frozen=True)
class Judgement:
    """The verdict and the suspects that it rests on."""

    verdict: str  # one of answer.VERDICTS
    suspects: Suspects
    to_add: tuple[str, ...]  # effects to go on with
    shares: tuple[float, ...] = ()  # how likely each explanation is among all, where it was weighed

    @property
    def explanations(self) -> tuple[Explanation, ...]:
        """Those that stood their tests, best first."""
        return tuple(survivor.explanation for survivor in self.suspects.survivors)

    @property
    def none_possible(self) -> bool:
        """Whether something stood, but only with sizes that no real machine has."""
        survivors = self.suspects.survivors
        return bool(survivors) and not any(survivor.possible for survivor in survivors)


def judge(readings: CleanReadings, detection: Search) -> Judgement:
    """Judge: an outlier comes first, then the detection threshold, then the suspects."""
    if readings.outliers:
        return Judgement("slip", Suspects((), True), ())
    if not detection.proved:
        return _without_proof(readings)
    if left_out(readings.frame):
        # What every machine has acts next to whatever else does: single effects say little.
        likely = _likely(readings, EVEN)
        if likely:
            return likely
    felt = [readings.singles[name] for name in readings.felt]
    suspects = find_suspects(readings.frame, felt, readings.felt, readings.noise)
    if suspects.believable:
        verdict = "one_suspect" if len(suspects.survivors) == 1 else "cannot_tell"
        return Judgement(verdict, suspects, _to_add(readings, suspects))
    nothing = Judgement("not_in_library", suspects, _to_add(readings, suspects))
    return _likely(readings, BELIEVABLE) or nothing


def _likely(readings: CleanReadings, most: float) -> Judgement | None:
    """Return the likeliest accounts; None if none fits, or if a Gaussian process is likelier than
    `most`.
    """
    answer = likeliest(readings.frame, readings.felt, readings.noise)
    if not answer.accounts or answer.process_chance > most:
        return None
    if not any(account.explanation.effects for account in answer.accounts):
        return Judgement("nothing_provable", Suspects((), True), ())
    survivors = tuple(Survivor(account.explanation, True) for account in answer.accounts)
    return Judgement(
        "one_suspect" if len(survivors) == 1 else "cannot_tell",
        Suspects(survivors, True),
        survivors[0].explanation.effects,
        tuple(account.share for account in answer.accounts),
    )


def _without_proof(readings: CleanReadings) -> Judgement:
    """No effect adds more than noise would: either nothing is there, or nothing in the library."""
    missing = misfit_chance(readings.frame, readings.noise) <= MISFIT_LEVEL
    suspects = Suspects((), not missing)
    if not missing:
        return Judgement("nothing_provable", suspects, ())
    return Judgement("not_in_library", suspects, _to_add(readings, suspects))


def _to_add(readings: CleanReadings, suspects: Suspects) -> tuple[str, ...]:
    """Return the best explanation, or the effects that come nearest where none stands."""
    if suspects.survivors:
        return suspects.survivors[0].explanation.effects
    return best_at_hand(readings.frame, readings.felt)


# Suspects: explanations to which nothing else in the library adds more than noise would.
#
# Single effects are tried first, then two at once, then three, until one stands whose sizes a real
# machine can have. Impossible suspects stay in the list, marked: they are the sign of a stand-in.
#
# This is the max-gain test turned round. Whatever the truth is, it stays in the set in about 95 %
# of all cases; look-alikes protect each other, so they stay together; better data make the set
# smaller.

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
    """Return combinations that might stand, by the slopes at the frame's fit; best first.

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
    """Return how surprising the effect's gain over the frame is after its full refit."""
    visible = single.basis.shape[1] - frame.basis.shape[1]
    return negative_log_p(frame.cost - single.cost, visible, noise.degrees)


# The likeliest accounts of the marks, as explanations with their odds.
#
# They are asked for where the tests of single effects have no answer: where the settings leave out
# what every machine has, so that it acts next to whatever else is wrong, and where only several
# effects together fit.

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
    process_chance: float  # that no effect of the library draws it


def likeliest(frame: Explanation, felt: Sequence[str], noise: Noise) -> Likeliest:
    """Return the accounts that leave no misfit, refitted in full."""
    weighed = weigh(frame, felt, noise, with_outliers=False)
    accounts = []
    for listed in listing(weighed.effects, weighed.clean):
        explanation = explain(frame.board, listed.effects, start=frame)
        if misfit_chance(explanation, noise) > MISFIT_LEVEL and possible(explanation, noise):
            accounts.append(Likely(explanation, listed.share))
    return Likeliest(tuple(accounts), weighed.process_chance)


@dataclass(frozen=True)
class Listed:
    """A set of effects that is worth naming."""

    effects: tuple[str, ...]
    share: float  # how likely it is, with all sets that count with it
    members: tuple[int, ...]  # these sets, and itself, by their places among all


def listing(effects: tuple[tuple[str, ...], ...], evidences: Array) -> list[Listed]:
    """Return sets of a few effects, likeliest first, as far as LISTED; by the logarithms of the
    weights of all sets.

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
    """Return whether each set (rows) is part of each (columns)."""
    names = sorted({name for each in effects for name in each})
    has = np.array([[name in each for name in names] for each in effects], dtype=int)
    part: Array = has @ (1 - has).T == 0
    return part
