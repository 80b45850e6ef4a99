"""The chance that a planned measurement settles the question, by simulating what it would bring.

Each hypothesis is taken for the truth as often as it is probable. Its frame and sizes are drawn
from what the marks so far leave open, new readings are drawn with noise, and the diagnosis is
repeated on all rows by the slopes at hand. Where it would weigh accounts of the marks, it weighs
them; else detection threshold, max-gain test of every single effect (and of the combinations that
stand now), lack of fit. It is settled when only the true explanation is left.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.explanation import Spread, negative_log_ps, span, tail
from plumb.diagnosis.gain import detection_threshold
from plumb.diagnosis.noise import FEW_REPEATS, STATEMENT, Noise, repeats_of
from plumb.diagnosis.noise import LEVEL as MISFIT_LEVEL
from plumb.diagnosis.sizes import possible_sizes
from plumb.diagnosis.weighing import left_out
from plumb.plan.case import Ahead, Case, Effects, Hypothesis, Planned, accounts_then
from plumb.plan.planned_visits import Visits

Array = np.ndarray
DRAWS = 240  # of all hypotheses together: a chance is then right to about 3 in 100
FEWEST = 12  # draws of one hypothesis
HOPELESS = 5.0  # above the threshold by so much -log p, an explanation does not come back
SEED = 1847
_TINY = 1e-8  # share of a column's squared length below which its rest is rounding


@dataclass(frozen=True)
class Outlook:
    """What to expect after a measurement."""

    chance: float  # that it settles the question, or finds what is hidden
    left: float | None  # explanations on average; None where they are not counted


def outlook(case: Case, planned: Planned, *, draws: int = DRAWS) -> Outlook:
    """Return what to expect of a planned measurement.

    Suspects: the chance that the true one is left alone. Nothing provable: that an effect of its
    usual size would be proved, if one is there.
    """
    alone = case.verdict != "nothing_provable"
    noise = noise_after(case, planned.visits)
    tests = _tests(case, planned, noise)
    trials = []
    for number, hypothesis in enumerate(case.truths):
        source = np.random.default_rng([SEED, number])
        count = max(FEWEST, round(draws * hypothesis.weight))
        boards = tests[id(hypothesis.at)].boards(hypothesis, source, count)
        trials.append((hypothesis, boards))
    listed = accounts_then(case, planned, noise, trials) if case.is_weighed else None
    settled = left = 0.0
    for number, (hypothesis, boards) in enumerate(trials):
        test = tests[id(hypothesis.at)]
        if listed is None:
            right, stand = test.judged(hypothesis, boards, alone=alone)
        else:
            right, stand = test.weighed(hypothesis, boards, listed[number])
        settled += hypothesis.weight * right
        left += hypothesis.weight * stand
    return Outlook(float(settled), float(left) if alone else None)


def _tests(case: Case, planned: Planned, noise: Noise) -> dict[int, Rediagnosis]:
    """Return the diagnosis to come, by the slopes of each hypothesis."""
    tests: dict[int, Rediagnosis] = {}
    for hypothesis in case.truths:
        if id(hypothesis.at) not in tests:
            twin = next(iter(tests.values()), None)
            rows = planned.ahead(hypothesis.at)
            tests[id(hypothesis.at)] = Rediagnosis(case, rows, noise, twin)
    return tests


@dataclass(frozen=True)
class _Boards:
    """Simulated boards in the rows of a Rediagnosis."""

    few: Array  # (rows, count)
    beyond: Array  # (count,) squares of the readings beyond those rows


class Rediagnosis:
    """The diagnosis of many simulated boards with the same rows.

    What is read of marks is turned so that few rows hold all that any unknown can change; what is
    beyond those only adds to the misfit.
    """

    def __init__(self, case: Case, rows: Ahead, noise: Noise, twin: Rediagnosis | None) -> None:
        """`twin`: the same rows by another explanation's slopes, whose limit serves here too."""
        board = case.board
        self.rows, self.board = rows, board
        self.noise = noise
        self.turned, few = np.linalg.qr(rows.slopes[rows.marks])
        self.slopes = np.vstack([few, rows.slopes[~rows.marks]])
        self.marks = np.arange(len(self.slopes)) < len(few)
        self.is_left_out = bool(left_out(case.frame))
        self.frame = span(self.slopes[:, board.frame])
        self.nothing = len(board.effect_columns)  # explanations left where nothing is proved
        self.columns = {name: board.columns([name]) for name in board.effect_columns}
        self.felt = [
            name for name, columns in self.columns.items() if rows.slopes[:, columns].any()
        ]
        self.lengths = np.linalg.norm(self.slopes, axis=0)
        felt_columns = {
            name: columns[self.lengths[columns] > 0]
            for name, columns in self.columns.items()
            if name in self.felt
        }
        self.single = {name: each[0] for name, each in felt_columns.items() if len(each) == 1}
        self.several = {name: each for name, each in felt_columns.items() if len(each) > 1}
        several = [
            hypothesis.effects for hypothesis in case.hypotheses if len(hypothesis.effects) > 1
        ]
        self.names = [*((name,) for name in self.felt), *several]
        self.names += [
            hypothesis.effects
            for hypothesis in case.hypotheses
            if hypothesis.effects not in self.names
        ]
        # With an explanation fitted it is lower by so little that the chances stay the same.
        self.threshold: float = twin.threshold if twin else self._threshold()

    def _threshold(self) -> float:
        """Return the -log p that noise hardly exceeds beyond the frame."""
        bases = {}
        for name in self.felt:
            raw = self.slopes[:, self.board.columns([name])]
            bases[name] = span(raw - self.frame @ (self.frame.T @ raw), against=raw)
        return detection_threshold(bases, self.noise)

    def boards(self, truth: Hypothesis, source: np.random.Generator, count: int) -> Array:
        """Whitened readings (rows, count) of boards drawn from a truth; those so far stay."""
        rows = self.rows
        drawn = rows.slopes[rows.so_far :, truth.columns] @ truth.drawn(source, count)
        drawn += source.standard_normal(drawn.shape)
        return np.vstack([np.repeat(truth.data[:, np.newaxis], count, axis=1), drawn])

    def judged(self, truth: Hypothesis, drawn: Array, *, alone: bool) -> tuple[float, float]:
        """On what share of boards the truth is proved (alone among all), and how many explanations
        stand on average."""
        boards = self._turned(drawn)
        proved = self._gains(self.frame, (), boards.few)[0] > self.threshold
        stands = self._stands(truth.effects, boards)
        if not alone:
            return float((proved & stands).mean()), float("nan")
        others = [self._stands(rival, boards) for rival in self.names if rival != truth.effects]
        counts = stands + np.sum(others, axis=0)
        left = np.where(proved, np.maximum(counts, 1), self.nothing)
        return float((proved & stands & (counts == 1)).mean()), float(left.mean())

    def weighed(
        self, truth: Hypothesis, drawn: Array, listed: Sequence[tuple[Effects, ...]]
    ) -> tuple[float, float]:
        """Return the same where accounts are weighed: those listed on each board count if they fit.
        An account that leaves out a small effect of the truth is right too.
        """
        boards = self._turned(drawn)
        proved = self._gains(self.frame, (), boards.few)[0] > self.threshold
        counts, right = np.zeros(len(listed), dtype=int), np.zeros(len(listed), dtype=bool)
        for effects in {effects for accounts in listed for effects in accounts}:
            there = np.array([effects in accounts for accounts in listed])
            there[there] = self._fits(effects, boards)[there]
            counts += there
            right |= there & ({*truth.counts_with} <= {*effects} <= {*truth.effects})
        if not self.is_left_out:
            # A single effect that explains all by itself is asked for nothing else.
            singles = [self._stands((name,), boards) for name in self.felt]
            alone = np.sum(singles, axis=0)
            counts = np.where(alone > 0, alone, counts)
            right &= alone == 0
        left = np.where(proved, np.maximum(counts, 1), self.nothing)
        return float((proved & right & (counts == 1)).mean()), float(left.mean())

    def _turned(self, drawn: Array) -> _Boards:
        read = drawn[self.rows.marks]
        few = self.turned.T @ read
        beyond = np.sum(read**2, axis=0) - np.sum(few**2, axis=0)
        return _Boards(np.vstack([few, drawn[~self.rows.marks]]), np.maximum(beyond, 0.0))

    def _spare(self, fitted: Array) -> float:
        """Return how many measured numbers orthonormal columns of what is fitted leave over."""
        return float(self.rows.marks.sum() - np.sum(fitted[self.marks] ** 2))

    def _fits(self, effects: Effects, boards: _Boards) -> Array:
        """Return whether an account leaves no misfit and has sizes that a machine can have
        (count,).
        """
        slopes, columns = self.slopes, self.board.columns(effects)
        drawn = slopes[:, columns] - self.frame @ (self.frame.T @ slopes[:, columns])
        inverse = np.linalg.pinv(drawn, rcond=1e-6)
        sizes = inverse @ boards.few
        left = boards.few - self.frame @ (self.frame.T @ boards.few) - drawn @ sizes
        spare = self._spare(span(slopes[:, [*self.board.frame, *columns]]))
        half = self.noise.quantile * np.sqrt(np.sum(inverse**2, axis=1))
        fits: Array = self._misfit(left, boards.beyond, spare) > MISFIT_LEVEL
        fits &= possible_sizes(self.board, columns, sizes, half)
        return fits

    def _stands(self, effects: Effects, boards: _Boards) -> Array:
        """Return whether nothing is to be added to an explanation, and it fits (count,)."""
        columns = np.concatenate([self.board.frame, self.board.columns(effects)])
        fitted, count = span(self.slopes[:, columns]), boards.few.shape[1]
        sample = boards.few[:, :: max(1, count // FEWEST)]
        if self._gains(fitted, effects, sample)[0].min() > self.threshold + HOPELESS:
            return np.zeros(count, dtype=bool)
        best, left = self._gains(fitted, effects, boards.few)
        misfit = self._misfit(left, boards.beyond, self._spare(fitted))
        return (best <= self.threshold) & (misfit > MISFIT_LEVEL)

    def _misfit(self, left: Array, beyond: Array, spare: float) -> Array:
        """Return the chance of as much misfit (count,) by what a fit leaves in the rows and
        beyond.
        """
        squares = beyond + np.sum(left[self.marks] ** 2, axis=0)
        within = self.noise.within
        spare, squares = spare - within.degrees, squares - within.squares / self.noise.sigma**2
        if spare < 0.5 or not self.noise.testable:
            return np.ones(left.shape[1])
        chances: Array = np.asarray(tail(squares, spare, self.noise.degrees))
        return chances

    def _gains(self, fitted: Array, effects: Effects, readings: Array) -> tuple[Array, Array]:
        """Return the largest -log p of any other effect (count,), and what the fit leaves."""
        left = readings - fitted @ (fitted.T @ readings)
        slopes = self.slopes
        beyond = slopes - fitted @ (fitted.T @ slopes)
        gram, along = beyond.T @ beyond, beyond.T @ left
        # Among effects with as many parameters the largest drop has the largest -log p.
        drops: dict[int, Array] = {1: self._single_drop(gram, along, effects)}
        for name, columns in self.several.items():
            if name in effects:
                continue
            block = gram[columns[:, np.newaxis], columns]
            seen, drop = _drop(block, along[columns], self.lengths[columns])
            if seen:
                drops[seen] = np.maximum(drops.get(seen, 0.0), drop)
        best = np.zeros(readings.shape[1])
        for seen, drop in drops.items():
            best = np.maximum(best, negative_log_ps(drop, seen, self.noise.degrees))
        return best, left

    def _single_drop(self, gram: Array, along: Array, effects: Effects) -> Array:
        """Return the largest drop of chi-square (count,) by an effect of a single parameter."""
        columns = np.array([self.single[name] for name in self.single if name not in effects], int)
        seen = columns[np.diag(gram)[columns] > _TINY * self.lengths[columns] ** 2]
        drops = along[seen] ** 2 / np.diag(gram)[seen, np.newaxis]
        largest: Array = drops.max(axis=0, initial=0.0)
        return largest


def _drop(gram: Array, along: Array, lengths: Array) -> tuple[int, Array | float]:
    """Return how many parameters of an effect are seen beyond what is fitted, and the drop of
    chi-square (count,) that they bring.
    """
    values, turned = np.linalg.eigh(gram / np.outer(lengths, lengths))
    seen = values > _TINY
    parts = turned[:, seen].T @ (along / lengths[:, np.newaxis])
    return int(seen.sum()), np.sum(parts**2 / values[seen, np.newaxis], axis=0)


def noise_after(case: Case, visits: Visits) -> Noise:
    """Return the noise as it will be known: marks that are visited again in the same way tell of
    it.
    """
    rows, noise = case.board.rows, case.noise
    known = {
        (name, *rows.chains[row], rows.sled_weights[row], rows.swapped[row])
        for name, row in zip(rows.names, rows.mark_rows, strict=True)
    }
    planned = zip(visits.names, visits.chains, visits.sled_weights, visits.swapped, strict=True)
    again = sum(
        (name, *chains, weight, swapped) in known for name, chains, weight, swapped in planned
    )
    if not again:
        return noise
    more = 2.0 * again + (noise.within if noise.within.degrees else repeats_of(rows)).degrees
    within = Spread(more * noise.sigma**2, more)
    if noise.source in ("stated", "stated and repeats"):
        return Noise(noise.sigma, STATEMENT + more, "stated and repeats", within=within)
    if more < FEW_REPEATS:
        return noise
    return Noise(noise.sigma, more, "repeats", within=within)
