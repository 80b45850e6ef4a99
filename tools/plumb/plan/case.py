"""What is known before the next measurement: the explanations that stand, and how far each is open.

A hypothesis is one effect (or several at once) with the numbers it may have, given the marks so
far: a mean and a covariance of the frame and its parameters, by the slopes at its fit.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import pairwise

import numpy as np

from plumb.diagnosis.answer import Diagnosis
from plumb.diagnosis.clean import felt_effects
from plumb.diagnosis.explanation import Board, Explanation, explain
from plumb.diagnosis.judgement import listing
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.sizes import Size
from plumb.diagnosis.weighing import SHARES, LinearBoard, Metric, accounts, largest_met, weigh
from plumb.fit.inputs import Inputs
from plumb.model.catalogue import effect_names
from plumb.model.plain import ascending, ranked
from plumb.model.predict import FOUND
from plumb.plan.planned_visits import Visits
from plumb.settings.machine import MachineSettings

Array = np.ndarray
MOST_HYPOTHESES = 8  # the best of them; more would only cost time
LIGHT = 0.01  # explanations less probable than this are left out
LIKELY, MOST_TRUTHS = 0.9, 16  # share of all that truths hold together, and their number
IMPOSSIBLE = 0.1  # weight of an explanation whose sizes no real machine has


@dataclass(frozen=True)
class Hypothesis:
    """One account of the marks so far, and what it leaves open."""

    effects: tuple[str, ...]
    at: Explanation  # whose slopes it goes by
    data: Array  # (rows,) whitened readings so far, less what the frame alone predicts there
    columns: Array  # of the unknowns it is free in
    mean: Array  # (f,) of these, as offsets from `at` for the frame, whole for the effects
    root: Array  # (f, f) root @ root.T is their covariance
    weight: float  # how probable it is among all
    counts_with: tuple[str, ...] = ()  # effects of the account that has it, where it is another

    def drawn(self, source: np.random.Generator, count: int) -> Array:
        """Return a number of possible sets of the unknowns (f, count)."""
        noise = source.standard_normal((self.root.shape[1], count))
        return self.mean[:, np.newaxis] + self.root @ noise


@dataclass(frozen=True)
class Case:
    """A diagnosed board, and the machine that will cut the next marks."""

    settings: MachineSettings  # in force when the next marks are cut
    controller: str
    verdict: str
    board: Board
    noise: Noise
    frame: Explanation
    singles: Mapping[str, Explanation]  # each felt effect by itself, refitted
    hypotheses: tuple[Hypothesis, ...]  # most probable first
    truths: tuple[Hypothesis, ...]  # what may be there: the same, or with small effects too
    is_weighed: bool = False  # whether the diagnosis weighs accounts of several effects
    spans: tuple[str, ...] = ()  # the names of both ends of each distance

    @property
    def usual_weight(self) -> float:
        """The sled's [N] when nothing extra hangs on it."""
        return float(np.median(self.board.rows.sled_weights))

    @property
    def effects(self) -> tuple[str, ...]:
        """The effects of all hypotheses, most probable first."""
        return tuple(
            dict.fromkeys(name for hypothesis in self.hypotheses for name in hypothesis.effects)
        )


def case_of(
    diagnosis: Diagnosis,
    inputs: Inputs,
) -> Case:
    """Return the case of a diagnosis, with the inputs it was made of."""
    model, rows = inputs.model_and_observations()
    sigma = diagnosis.noise.sigma
    board = Board.of(model, rows, sigma=sigma, priors=inputs.priors, checked=inputs.checked)
    frame = explain(board)
    felt = felt_effects(frame)
    singles = {name: explain(board, (name,), start=frame) for name in felt}
    # New marks belong to the first round: its settings, its zeros and its sheet.
    measurements = inputs.measurements
    in_force = measurements.rounds[0].cut_with or inputs.cut_with or inputs.settings
    truths: tuple[Hypothesis, ...] = ()
    is_weighed = bool(diagnosis.explanations) and diagnosis.explanations[0].share is not None
    if is_weighed:
        whole = sum(each.share or 0.0 for each in diagnosis.explanations)
        hypotheses = tuple(
            _as_fitted(explain(board, each.effects, start=frame), (each.share or 0.0) / whole)
            for each in diagnosis.explanations
        )
        truths = _with_small_ones(hypotheses, frame, felt, diagnosis.noise)
    elif diagnosis.explanations:
        several = [
            explanation for explanation in diagnosis.explanations if len(explanation.effects) > 1
        ]
        together = [explain(board, explanation.effects, start=frame) for explanation in several]
        hypotheses = _weighed([*singles.values(), *together], _possible(diagnosis))
    else:
        hypotheses = hidden_hypotheses(frame)
    return Case(
        settings=in_force,
        controller=inputs.controller or measurements.controller or in_force.controller,
        verdict=diagnosis.verdict,
        board=board,
        noise=diagnosis.noise,
        frame=frame,
        singles=singles,
        hypotheses=hypotheses,
        truths=truths or hypotheses,
        is_weighed=is_weighed,
        spans=tuple(" - ".join(distance.between) for distance in measurements.distances),
    )


def _possible(diagnosis: Diagnosis) -> set[tuple[str, ...]]:
    """Return the explanations whose sizes a real machine can have, or nearly so."""
    sizes: dict[tuple[str, ...], tuple[Size, ...]] = {
        (ranked.effect,): ranked.sizes for ranked in diagnosis.ranking
    }
    for explanation in diagnosis.explanations:
        sizes[explanation.effects] = tuple(
            size for sizes_of_effect in explanation.sizes.values() for size in sizes_of_effect
        )
    return {
        effects for effects, own_sizes in sizes.items() if all(size.possible for size in own_sizes)
    }


def _weighed(
    explanations: Sequence[Explanation], possible: set[tuple[str, ...]]
) -> tuple[Hypothesis, ...]:
    """Hypotheses as they fit, weighed by how well they do; what is hardly probable is left out.

    The weight is exp(-(chi-square + 2 parameters) / 2), the order of the diagnosis itself. Effects
    that did not stand their test take part: one in twenty of them is the truth all the same.
    """
    prices = [
        explanation.cost + 2 * len(explanation.board.columns(explanation.effects))
        for explanation in explanations
    ]
    shares = [
        1.0 if explanation.effects in possible else IMPOSSIBLE for explanation in explanations
    ]
    logs = np.log(shares) - (np.array(prices) - min(prices)) / 2
    weights, best = np.exp(logs), ascending(-logs)[:MOST_HYPOTHESES]
    best = best[weights[best] > LIGHT * weights.sum()]
    return tuple(_as_fitted(explanations[i], weights[i] / weights[best].sum()) for i in best)


def _as_fitted(explanation: Explanation, weight: float) -> Hypothesis:
    of_effects = explanation.board.columns(explanation.effects)
    columns = np.concatenate([explanation.board.frame, of_effects])
    mean = np.concatenate(
        [np.zeros(len(explanation.board.frame)), explanation.unknowns[of_effects]]
    )
    return Hypothesis(
        effects=explanation.effects,
        at=explanation,
        data=explanation.residual
        + explanation.slopes[:, of_effects] @ explanation.unknowns[of_effects],
        columns=columns,
        mean=mean,
        root=_root(explanation.slopes[:, columns]),
        weight=float(weight),
    )


def _with_small_ones(
    hypotheses: Sequence[Hypothesis], frame: Explanation, felt: Sequence[str], noise: Noise
) -> tuple[Hypothesis, ...]:
    """Return each account by itself and with the effects that may act too, the likeliest of all.

    Sizes are as far open as the marks and what is met in workshops leave them.
    """
    weighed = weigh(frame, felt, noise, with_outliers=False)
    by_effects = {hypothesis.effects: hypothesis for hypothesis in hypotheses}
    sets = [
        (float(weighed.clean[member]), weighed.effects[member], by_effects[each.effects])
        for each in listing(weighed.effects, weighed.clean)
        if each.effects in by_effects
        for member in each.members
    ]
    sets = ranked(sets, lambda account: -account[0])
    weights = np.exp(np.array([evidence for evidence, *_ in sets]) - sets[0][0])
    likely = np.cumsum(weights) - weights < LIKELY * weights.sum()
    kept = int(min(likely.sum(), MOST_TRUTHS))
    return tuple(
        _with_sizes(known, effects, weight / weights[:kept].sum())
        for weight, (_, effects, known) in zip(weights[:kept], sets, strict=False)
    )


def _with_sizes(known: Hypothesis, effects: tuple[str, ...], weight: float) -> Hypothesis:
    """Return some effects by the slopes of an account that holds a part of them."""
    board = known.at.board
    of_effects = board.columns(effects)
    columns = np.concatenate([board.frame, of_effects])
    met = np.zeros((len(of_effects), len(columns)))
    met[:, len(board.frame) :] = np.diag(1 / (SHARES[0] * largest_met(board, of_effects)))
    slopes = np.vstack([known.at.slopes[:, columns], met])
    data = np.concatenate([known.data, np.zeros(len(of_effects))])
    mean = np.linalg.lstsq(slopes, data, rcond=1e-10)[0]
    root = _root(slopes)
    return Hypothesis(effects, known.at, known.data, columns, mean, root, weight, known.effects)


def hidden_hypotheses(frame: Explanation) -> tuple[Hypothesis, ...]:
    """Return where nothing is proved: each effect there with about its typical size, all as
    probable.

    A standard normal of each parameter in typical sizes, and then what the marks say of it.
    """
    board, hypotheses = frame.board, []
    names = effect_names()
    for name in names:
        of_effect = board.columns([name])
        columns = np.concatenate([board.frame, of_effect])
        usual = np.zeros((len(of_effect), len(columns)))
        usual[:, len(board.frame) :] = np.eye(len(of_effect))
        slopes = np.vstack([frame.slopes[:, columns], usual])
        data = np.concatenate([frame.residual, np.zeros(len(of_effect))])
        mean = np.linalg.lstsq(slopes, data, rcond=1e-10)[0]
        readings, share = frame.residual, 1 / len(names)
        hypotheses.append(Hypothesis((name,), frame, readings, columns, mean, _root(slopes), share))
    return tuple(hypotheses)


def _root(slopes: Array) -> Array:
    """Return the symmetric root of the covariance of unknowns with these whitened slopes; what is
    not felt is not drawn.

    Any other root has the signs of singular vectors, and with them what is drawn, from rounding.
    """
    _, sizes, turned = np.linalg.svd(slopes, full_matrices=False)
    felt = sizes > 1e-6 * sizes[0]
    root: Array = turned[felt].T / sizes[felt] @ turned[felt]
    return root


# The accounts that the diagnosis would list after a planned measurement.
#
# The diagnosis weighs them by the slopes at the fit of the frame, whatever is true; so the
# readings that a hypothesis predicts are written as what is left of that fit. How likely a field
# of no effect is stays as it is: the hypotheses know of none.

Effects = tuple[str, ...]


def accounts_then(
    case: Case, planned: Planned, noise: Noise, trials: Sequence[tuple[Hypothesis, Array]]
) -> list[list[tuple[Effects, ...]]]:
    """Return the accounts listed on each board of each trial: a hypothesis, and boards (rows,
    count) drawn from it, relative to what it predicts of the frame alone.
    """
    rows, board = planned.ahead(case.frame), case.board
    felt = [name for name in board.effect_columns if rows.slopes[:, board.columns([name])].any()]
    new = [
        boards[rows.so_far :] + _apart(case, planned, hypothesis)[:, np.newaxis]
        for hypothesis, boards in trials
    ]
    linear = LinearBoard.of(case.frame, felt, noise).with_more(
        board, rows.slopes[rows.so_far :], np.hstack(new), noise
    )
    sets, before = accounts(case.frame, felt)
    evidences = before[:, np.newaxis] + Metric.of(linear).evidences(linear.parts(sets))
    listed = [tuple(each.effects for each in listing(sets, column)) for column in evidences.T]
    ends = np.cumsum([0, *(boards.shape[1] for _, boards in trials)])
    return [listed[start:end] for start, end in pairwise(ends)]


def _apart(case: Case, planned: Planned, hypothesis: Hypothesis) -> Array:
    """Return what planned readings (rows,) have beyond those of a hypothesis's boards when they are
    counted from the start of the frame's fit, as slopes have it.
    """
    board, truth, frame = case.board, planned.ahead(hypothesis.at), planned.ahead(case.frame)
    unknowns, of_effects = hypothesis.at.unknowns, board.columns(hypothesis.at.effects)
    apart: Array = truth.slopes[truth.so_far :, board.frame] @ unknowns[board.frame]
    between = truth.where - frame.where
    by_effects = truth.slopes[truth.so_far :, of_effects] @ unknowns[of_effects]
    by_frame = frame.slopes[frame.so_far :, board.frame] @ case.frame.unknowns[board.frame]
    seen = np.flatnonzero(np.isfinite(between))
    apart[seen] = between[seen] - by_effects[seen] + by_frame[seen]
    return apart


# What a planned measurement would add: rows of slopes below those of the marks so far.


@dataclass(frozen=True)
class Check:
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


class Planned:
    """A planned measurement; what it adds by an explanation is worked out once."""

    def __init__(self, visits: Visits, checks: Sequence[Check] = ()) -> None:
        self.visits, self.checks = visits, tuple(checks)
        self._known: dict[int, tuple[Explanation, Ahead]] = {}

    def ahead(self, at: Explanation) -> Ahead:
        """Return the rows after the measurement, by the slopes of an explanation."""
        if id(at) not in self._known:
            self._known[id(at)] = at, ahead(at, self.visits, self.checks)
        return self._known[id(at)][1]


def ahead(at: Explanation, visits: Visits, checks: Sequence[Check] = ()) -> Ahead:
    """Return the rows after a planned measurement, by the slopes of an explanation."""
    where, marks = _seen(at, visits)
    checked = check_slopes(at, checks)
    read = np.zeros(len(at.slopes), dtype=bool)
    read[: at.board.rows.count] = True
    return Ahead(
        slopes=np.vstack([at.slopes, marks.reshape(-1, at.slopes.shape[1]), checked]),
        so_far=len(at.slopes),
        marks=np.concatenate([read, np.full(2 * len(visits), True), np.full(len(checks), False)]),
        where=where,
    )


def visit_slopes(at: Explanation, visits: Visits) -> Array:
    """Whitened slopes (n, 2, u) of visits at an explanation; zero, so that nothing is expected of
    it, for a visit where the explanation's sled could not hang."""
    return _seen(at, visits)[1]


def _seen(at: Explanation, visits: Visits) -> tuple[Array, Array]:
    """Return where visits would be read (n * 2,), and the slopes of that (n, 2, u), both
    whitened.
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


def check_slopes(at: Explanation, checks: Sequence[Check]) -> Array:
    """Whitened slopes (c, u) of numbers that are measured directly."""
    problem = at.board.problem
    rows = np.zeros((len(checks), len(problem.names)))
    for i, check in enumerate(checks):
        column = problem.names.index(check.name)
        rows[i, column] = problem.scale[column] / check.sigma
    return rows
