"""Knowledge before the next measurement, and what a measurement would be worth by it."""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.diagnosis.diagnosis import Diagnosis, is_silent
from plumb.diagnosis.evidence import (
    FEWER,
    AccountGroup,
    Accounts,
    Effects,
    LinearBoard,
    Metric,
    Noise,
    Noises,
    accounts_of,
    asked_for,
    clean_of,
    pitches,
    variants,
)
from plumb.diagnosis.explanation import Board, Explanation
from plumb.diagnosis.posterior import Posterior, listing, together
from plumb.diagnosis.priors import PITCH, TOGETHER, SizePriors, turned
from plumb.fit.inputs import Inputs
from plumb.model.catalogue import EVERY_MACHINE, effect_names
from plumb.model.plain import ascending
from plumb.model.predict import FOUND
from plumb.plan.planned_visits import Visits
from plumb.settings import MachineSettings

# Knowledge before the next measurement: the accounts that are likely, and the next machine.


Array = np.ndarray


@dataclass(frozen=True)
class Hypothesis:
    """One account of the marks so far."""

    effects: tuple[str, ...]
    at: Explanation  # whose slopes it goes by
    weight: float  # how likely it is among all


@dataclass(frozen=True)
class Case:
    """A diagnosed board, and the machine that will cut the next marks."""

    settings: MachineSettings  # in force when the next marks are cut
    controller: str
    verdict: str
    posterior: Posterior
    frame: Explanation  # whitened by the noise
    best: Explanation
    hypotheses: tuple[Hypothesis, ...]  # likeliest first
    spans: tuple[str, ...] = ()  # the names of both ends of each distance

    @property
    def board(self) -> Board:
        """The marks so far."""
        return self.frame.board

    @property
    def noise(self) -> Noise:
        """Of a reading."""
        return self.posterior.noise

    @property
    def usual_weight(self) -> float:
        """The sled's [N] when nothing extra hangs on it."""
        return float(np.median(self.board.rows.sled_weights))

    @property
    def effects(self) -> tuple[str, ...]:
        """The effects of all hypotheses, likeliest first."""
        return tuple(
            dict.fromkeys(name for hypothesis in self.hypotheses for name in hypothesis.effects)
        )


def case_of(diagnosis: Diagnosis, inputs: Inputs) -> Case:
    """Return the case of a diagnosis, with the inputs it was made of."""
    # New marks belong to the first round: its settings, its zeros and its sheet.
    measurements = inputs.measurements
    in_force = measurements.rounds[0].cut_with or inputs.cut_with or inputs.settings
    both = zip(diagnosis.explanations, diagnosis.fits, strict=True)
    likely = tuple(
        Hypothesis(together.effects, fitted, together.share)
        for together, fitted in both
        if together.effects
    )
    return Case(
        settings=in_force,
        controller=inputs.controller or measurements.controller or in_force.controller,
        verdict=diagnosis.verdict,
        posterior=diagnosis.readings.posterior,
        frame=diagnosis.readings.frame,
        best=diagnosis.best,
        hypotheses=likely or hidden_hypotheses(diagnosis.readings.frame),
        spans=tuple(" - ".join(distance.between) for distance in measurements.distances),
    )


def hidden_hypotheses(frame: Explanation) -> tuple[Hypothesis, ...]:
    """Return where nothing is proved: each effect there in its typical size, all as likely."""
    names = effect_names()
    return tuple(Hypothesis((name,), frame, 1 / len(names)) for name in names)


# What a planned measurement would add: rows of slopes below those of the marks so far.


@dataclass(frozen=True)
class PlannedCheck:
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


class PlannedMeasurement:
    """A planned measurement; what it adds by an explanation is worked out once."""

    def __init__(self, visits: Visits, checks: Sequence[PlannedCheck] = ()) -> None:
        self.visits, self.checks = visits, tuple(checks)
        self._known: dict[int, tuple[Explanation, Ahead]] = {}

    def ahead(self, at: Explanation) -> Ahead:
        """Return the rows after the measurement, by the slopes of an explanation."""
        if id(at) not in self._known:
            self._known[id(at)] = at, self._ahead(at)
        return self._known[id(at)][1]

    def _ahead(self, at: Explanation) -> Ahead:
        where, marks = seen_on(at, self.visits)
        problem = at.board.problem
        checked = np.zeros((len(self.checks), len(problem.names)))
        for row, check in zip(checked, self.checks, strict=True):
            column = problem.names.index(check.name)
            row[column] = problem.scale[column] / check.sigma
        read = np.arange(len(at.slopes)) < at.board.rows.count
        return Ahead(
            slopes=np.vstack([at.slopes, marks.reshape(-1, at.slopes.shape[1]), checked]),
            so_far=len(at.slopes),
            marks=np.r_[read, np.full(marks[:, :, 0].size, True), np.full(len(checked), False)],
            where=where,
        )


def seen_on(at: Explanation, visits: Visits) -> tuple[Array, Array]:
    """Return where visits would be read (n * 2,), and the slopes of that (n, 2, u), both whitened;
    of a visit where the explanation's sled could not hang NaN, and zero: nothing is expected of it.
    """
    problem = replace(at.board.problem, observations=visits.rows())
    width = len(problem.names)
    if not len(visits):
        return np.zeros(0), np.zeros((0, 2, width))
    sighting, _ = problem.predict(at.unknowns)
    slopes = (problem.data_slopes(sighting) / problem.sigma).reshape(-1, 2, width)
    hangs = sighting.outcome == FOUND
    where = np.where(hangs[:, np.newaxis], sighting.read.where / problem.sigma, np.nan)
    return where.ravel(), np.where(hangs[:, np.newaxis, np.newaxis], slopes, 0.0)


# Worth of a planned measurement, by simulating its readings under the posterior.
#
# Truths are drawn from the posterior: an account as often as it is likely, then its sizes and the
# frame as the marks so far leave them, then new readings with noise. Each simulated board is
# weighed as the diagnosis weighs it, by the slopes at the frame's fit. Two numbers are read off:
# the chance that the verdict then names what the marks can show and nothing that is not there, and
# the expected information, the mean rise of the logarithm of the truth's probability (Lindley
# 1956).


DRAWS = 120  # a chance is then right to about 4 in 100
LIKELY = 0.99  # of all weight, in the sets that are weighed again; single effects always are
MOST_LOOKED_AT = 60  # sets of a simulated board that its verdict is read from
SEED = 1847
LEAST_GAIN, GAIN_PER_PARAMETER = 9.0, 2.0  # of chi-square, from which on marks can show an effect
BACKGROUND = (*EVERY_MACHINE, PITCH)  # what may be named too: it is there on every machine


@dataclass(frozen=True)
class Outlook:
    """Expectation after a measurement."""

    chance: float  # that it settles the question, or finds what is hidden
    left: float | None  # explanations on average; None where they are not counted
    bits: float  # expected information on which account holds


class Outlooks:
    """The outlooks of planned measurements on one case."""

    def __init__(self, case: Case, draws: int = DRAWS) -> None:
        self.case, self.draws = case, draws
        self.noises = _two_noises(case.noise)
        self.is_hidden = case.verdict == "nothing_provable"
        self._so_far: dict[Effects, SoFar] = {}

    def of(self, planned: PlannedMeasurement) -> Outlook:
        """Return what to expect of a planned measurement."""
        rows = planned.ahead(self.case.frame)
        board = self.case.board
        felt = tuple(
            name for name in board.effect_columns if rows.slopes[:, board.columns([name])].any()
        )
        if felt not in self._so_far:
            known = LinearBoard.of(self.case.frame, felt)
            sigma = self.case.noise.sigma
            self._so_far[felt] = SoFar.of(known, self.noises, sigma, is_hidden=self.is_hidden)
        so_far = self._so_far[felt]
        source = np.random.default_rng(SEED)
        then, truths, sizes = so_far.simulated(rows, board, self.draws, source)
        shown = _shown(then, self.case.noise.sigma, sizes)
        clean = clean_of(then, so_far.accounts, self.noises)
        after = clean.total - np.logaddexp.reduce(clean.total, axis=0)
        gained = after[truths, np.arange(len(truths))] - so_far.log_chances[truths]
        settled, left = 0.0, 0.0
        for i, truth in enumerate(truths):
            few = ascending(-clean.total[:, i])[:MOST_LOOKED_AT]
            asked = asked_for(then, so_far.accounts, clean.on(i), few)
            named = _named(asked, clean.total[few, i])
            acting = so_far.accounts.effects[truth]
            settled += _is_right(named, acting, [name for name in acting if shown[name][i]])
            left += max(len(named), 1)
        return Outlook(
            chance=settled / len(truths),
            left=None if self.is_hidden else left / len(truths),
            bits=float(max(gained.mean(), 0.0) / np.log(2)),
        )


def _two_noises(noise: Noise) -> Noises:
    """Return two noises that stand for all: with their mean and their spread (Gauss's rule)."""
    if np.isinf(noise.degrees):
        return Noises(np.array([noise.sigma]), np.zeros(1))
    off = np.sqrt(0.5 / noise.degrees)
    return Noises(noise.sigma * np.exp([-off, off]), np.full(2, -np.log(2)))


def _named(asked: list[Effects], weights: Array) -> list[Effects]:
    """Return the explanations that a verdict lists; none where it names nothing."""
    several, each = together(asked, weights)
    is_nothing = np.array([not effects for effects in several])
    nothing = np.logaddexp.reduce(each[is_nothing]) - np.logaddexp.reduce(each)
    if is_silent(float(np.exp(nothing))):
        return []
    return [several[place] for place, _ in listing(several, each)]


def _is_right(named: list[Effects], acting: Effects, shown: Iterable[str]) -> bool:
    """Return whether a verdict names a single explanation: all that the marks can show of what
    acts, and nothing that is not there. What every machine has is there; nothing is named where
    nothing acts.
    """
    if not named:
        return not acting
    there = {*acting, *BACKGROUND}
    return len(named) == 1 and {*shown} <= {*named[0]} <= there


def _shown(board: LinearBoard, sigma: float, sizes: Array) -> Mapping[str, Array]:
    """Return of each effect in which draws the marks can show it: where it lowers chi-square by
    LEAST_GAIN and GAIN_PER_PARAMETER for each parameter, beyond the frame and all else that acts.
    sizes (p, draws), 0 where an effect does not act.
    """
    gram = Metric.of(board, np.array([sigma])).gram[0]
    acts = {name: np.any(sizes[columns] != 0, axis=0) for name, columns in board.columns.items()}
    shown = {name: np.zeros(sizes.shape[1], dtype=bool) for name in acts}
    for pattern in np.unique(np.array(list(acts.values())), axis=1).T:
        alike = np.all([there == at for there, at in zip(acts.values(), pattern, strict=True)], 0)
        acting = [name for name, there in zip(acts, pattern, strict=True) if there]
        for name in acting:
            mine = board.columns[name]
            others = [board.columns[other] for other in acting if other != name]
            kept = _beyond(gram, mine, np.concatenate([np.zeros(0, dtype=int), *others]))
            gain = np.einsum("id,ij,jd->d", sizes[mine][:, alike], kept, sizes[mine][:, alike])
            shown[name][alike] = gain >= LEAST_GAIN + GAIN_PER_PARAMETER * len(mine)
    return shown


def _beyond(gram: Array, mine: Array, others: Array) -> Array:
    """Return the Gram matrix of some columns beyond what others draw."""
    mixed = gram[np.ix_(others, mine)]
    solved = np.linalg.lstsq(gram[np.ix_(others, others)], mixed, rcond=1e-9)[0]
    kept: Array = gram[np.ix_(mine, mine)] - mixed.T @ solved
    return kept


# The marks so far, the sets of effects that are likely by them, and boards drawn from both.


@dataclass(frozen=True)
class Truths:
    """Variants of accounts that may be true."""

    part: AccountGroup
    chances: Array  # (a,)
    is_drifting: bool  # whether the chains are as makers sell them, or nominal

    def loose(self, frame: Array, effects: Array, sizes: SizePriors) -> Array:
        """Return the columns of what is loose on each machine: of the frame, and of such chains."""
        drifting = np.flatnonzero(sizes.pitch) if self.is_drifting else np.zeros(0, dtype=int)
        return np.hstack([frame, effects[:, drifting] * sizes.pitch[drifting]])


def _truths(
    board: LinearBoard, accounts: Accounts, noises: Noises, *, is_hidden: bool
) -> tuple[Truths, ...]:
    """Return the variants with their chances; `is_hidden`: single effects, all as likely."""
    alone = np.array([len(names) == 1 for names in accounts.effects])
    weighed = []
    for is_drifting, log_chance in pitches(board):
        metric = Metric.of(board, noises.sigmas, pitch=is_drifting)
        for part, weight in variants(accounts, metric, noises):
            evidence = np.logaddexp.reduce(weight, axis=1)
            if is_hidden:
                evidence = np.where(alone[part.sets], 0.0, -np.inf)
            weighed.append(Truths(part, evidence + log_chance, is_drifting))
    whole = np.logaddexp.reduce(np.concatenate([each.chances for each in weighed]))
    return tuple(replace(each, chances=np.exp(each.chances - whole)) for each in weighed)


@dataclass(frozen=True)
class SoFar:
    """The linear board of the marks so far, and what it says of sets of effects."""

    board: LinearBoard
    noises: Noises
    sigma: float  # [mm] of new readings
    accounts: Accounts  # those that are worth weighing again
    log_chances: Array  # (sets,)
    truths: tuple[Truths, ...]  # to draw from

    @staticmethod
    def of(board: LinearBoard, noises: Noises, sigma: float, *, is_hidden: bool) -> SoFar:
        """Weigh the marks so far; `is_hidden`: the truth is then one effect of about usual size."""
        accounts = accounts_of(board, TOGETHER if board.measured <= FEWER else 2)
        total = clean_of(board, accounts, noises).total[:, 0]
        total = total - np.logaddexp.reduce(total)
        order = ascending(-total)
        weight = np.exp(total[order])
        kept = np.array([len(names) < 2 for names in accounts.effects])
        kept[order[np.cumsum(weight) - weight < LIKELY]] = True
        accounts = accounts.among(kept)
        truths = _truths(board, accounts, noises, is_hidden=is_hidden)
        return SoFar(board, noises, sigma, accounts, np.where(kept, total, -np.inf), truths)

    def simulated(
        self, rows: Ahead, known: Board, draws: int, source: np.random.Generator
    ) -> tuple[LinearBoard, Array, Array]:
        """Return the board with planned readings drawn (rows, draws), the set of each draw, and the
        sizes (p, draws) of its effects; 0 where an effect does not act.
        """
        new, is_read = rows.slopes[rows.so_far :], rows.marks[rows.so_far :]
        new = np.where(is_read[:, np.newaxis], known.sigma, 1.0) * new
        columns = known.columns(tuple(self.board.columns))
        frame, effects = new[:, known.frame], turned(known, columns, new[:, columns])
        read, truths, drawn_sizes = [], [], []
        noise = np.where(is_read[:, np.newaxis], self.sigma, 1.0)
        wanted = np.concatenate([each.chances for each in self.truths]) * draws
        # Whole numbers whose sums stay within one of what is wanted.
        counts = np.diff(np.floor(np.cumsum(wanted) + 0.5), prepend=0.0).astype(int)
        starts = np.cumsum([0, *(len(each.chances) for each in self.truths)])
        for each, start, end in zip(self.truths, starts[:-1], starts[1:], strict=True):
            loose = each.loose(frame, effects, self.board.sizes)
            for place in np.flatnonzero(counts[start:end]):
                count = int(counts[start + place])
                of_frame, sizes = self._unknowns(each, int(place), count, source)
                seen = noise * source.standard_normal((len(new), count))
                read.append(loose @ of_frame + effects[:, each.part.index[place]] @ sizes + seen)
                truths += [int(each.part.sets[place])] * count
                drawn_sizes.append(self._of_acting(each.part, int(place), sizes))
        drawn = np.hstack(read)
        then = self._with(frame, effects, drawn, is_read)
        return then, np.array(truths), np.hstack(drawn_sizes)

    def _of_acting(self, part: AccountGroup, place: int, sizes: Array) -> Array:
        """Return sizes (k, count) of a variant as those (p, count) of the effects that act."""
        every = np.zeros((self.board.effects.shape[1], sizes.shape[1]))
        every[part.index[place]] = sizes
        of_acting = np.zeros_like(every)
        for name in self.accounts.effects[part.sets[place]]:
            columns = self.board.columns[name]
            of_acting[columns] = every[columns]
        return of_acting

    def _with(self, frame: Array, effects: Array, read: Array, is_read: Array) -> LinearBoard:
        measured, board = self.board.measured, self.board

        def joined(old: Array, added: Array) -> Array:
            return np.vstack([old[:measured], added[is_read], old[measured:], added[~is_read]])

        return replace(
            board,
            measured=measured + int(is_read.sum()),
            frame=joined(board.frame, frame),
            effects=joined(board.effects, effects),
            read=joined(np.repeat(board.read[:, :1], read.shape[1], axis=1), read),
        )

    def _unknowns(
        self, truths: Truths, place: int, count: int, source: np.random.Generator
    ) -> tuple[Array, Array]:
        """Draw what is loose (f, count) and the sizes (k, count) as the marks so far leave them."""
        board, part = self.board, truths.part
        index = part.index[place]
        weight = np.ones(len(board.frame))
        weight[: board.measured] /= self.sigma
        loose = truths.loose(board.frame, board.effects, board.sizes)
        rows = np.hstack([loose, board.effects[:, index]]) * weight[:, np.newaxis]
        prior = np.r_[np.ones(loose.shape[1]), 1 / part.variance[place]]
        lower = np.linalg.cholesky(rows.T @ rows + np.diag(prior))
        mean = np.linalg.solve(lower, rows.T @ (weight * board.read[:, 0]))
        noise = source.standard_normal((len(mean), count))
        drawn = np.linalg.solve(lower.T, mean[:, np.newaxis] + noise)
        split = loose.shape[1]
        least = (board.sizes.least - board.sizes.mean)[index]
        return drawn[:split], np.maximum(drawn[split:], least[:, np.newaxis])
