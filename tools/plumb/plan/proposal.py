"""What to measure next, best first: chance to settle the question against the minutes it costs."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.answer import Diagnosis
from plumb.diagnosis.explanation import span
from plumb.diagnosis.sizes import Room
from plumb.fit.inputs import Inputs
from plumb.model.ranks import ranked
from plumb.plan.ahead import Planned
from plumb.plan.case import Case, case_of
from plumb.plan.options import Option, many_marks, options
from plumb.plan.outlook import outlook
from plumb.plan.separation import ENOUGH, apart, drawn_by
from plumb.plan.strangers import for_slips, near_the_worst

Array = np.ndarray
# A question: what the chance is the chance of.
SETTLE, CONFIRM, FIND, REREAD, EXPLORE = "settle", "confirm", "find", "reread", "explore"
AGAIN = 10.0  # minutes that another round costs when this round did not settle it
DISTINGUISHED = 0.75 * ENOUGH  # lambda from which a pair counts as distinguished
MOST_PARTED = 6
QUESTIONS = {"cannot_tell": SETTLE, "one_suspect": CONFIRM, "nothing_provable": FIND}


@dataclass(frozen=True)
class RoomThen:
    """How large an effect could hide, RMS over the marks: by the marks so far, and afterwards."""

    effect: str
    now: float  # [mm]
    then: float  # [mm]


@dataclass(frozen=True)
class Proposal:
    """One thing to measure, and what to expect of it."""

    option: Option
    question: str  # SETTLE ...
    chance: float | None  # None: nothing can be computed
    left: float | None  # suspects that will be left on average
    parts: tuple[tuple[str, str], ...] = ()  # pairs distinguished then, and not by the marks so far
    rooms: tuple[RoomThen, ...] = ()  # what the largest hidden effects could then still be

    @property
    def rate(self) -> float:
        """The order: chance (or millimetres of doubt removed, where nothing is provable) per
        minute, with one more round added in case it fails."""
        gained = (
            sum(room.now - room.then for room in self.rooms) if self.rooms else self.chance or 0.0
        )
        return gained / (self.option.minutes + AGAIN)


@dataclass(frozen=True)
class Next:
    """All that is worth measuring, best first, and what blind diligence would bring instead."""

    verdict: str
    case: Case | None
    proposals: tuple[Proposal, ...]
    blind: Proposal | None  # as many more marks as patience allows
    stable: (
        tuple[int, int] | None
    )  # of a single suspect: deletions of a mark that keep it, of how many


def propose(
    diagnosis: Diagnosis,
    inputs: Inputs,
    *,
    progress: Callable[[float], None] = lambda share: None,
) -> Next:
    """The next measurements for a diagnosis, given the inputs it was made of.

    `progress` is called with the share of the work that is done.
    """
    case = case_of(diagnosis, inputs)
    if diagnosis.verdict == "slip":
        proposals = [
            Proposal(option, REREAD, chance, None)
            for option, chance in for_slips(case, diagnosis.slips)
        ]
        return Next(diagnosis.verdict, case, tuple(proposals), None, None)
    if diagnosis.verdict == "not_in_library":
        proposals = [Proposal(option, EXPLORE, None, None) for option in near_the_worst(case)]
        return Next(diagnosis.verdict, case, tuple(proposals), None, None)
    several = options(case)
    blind = many_marks(case)
    everything = [*several, *([blind] if blind else [])]
    weighed = []
    for number, option in enumerate(everything):
        weighed.append(_weighed(case, option, diagnosis.could_hide))
        progress((number + 1) / len(everything))
    against = weighed.pop() if blind else None
    stable = _stability(case) if diagnosis.verdict == "one_suspect" else None
    return Next(diagnosis.verdict, case, _best_first(weighed), against, stable)


def _best_first(proposals: Sequence[Proposal]) -> tuple[Proposal, ...]:
    """One suspect is confirmed best by what measures the cause itself."""
    by_rate = ranked(proposals, lambda proposal: -proposal.rate)
    return tuple(
        sorted(by_rate, key=lambda each: each.question == CONFIRM and each.option.kind != "check")
    )


def _weighed(case: Case, option: Option, rooms: Sequence[Room]) -> Proposal:
    """An option with what to expect of it."""
    planned = Planned(option.visits, option.checks)
    expected = outlook(case, planned)
    question = QUESTIONS[case.verdict]
    parts = _parted(case, planned) if question != FIND else ()
    then = _rooms(case, planned, rooms) if question == FIND else ()
    return Proposal(option, question, expected.chance, expected.left, parts, then)


def _parted(case: Case, planned: Planned) -> tuple[tuple[str, str], ...]:
    """Pairs of suspects that are distinguished afterwards and are not now, most probable first."""
    lambdas: dict[frozenset[str], list[float]] = {}
    for hypothesis in case.hypotheses:
        rows, drawn = planned.ahead(hypothesis.at), drawn_by(hypothesis)
        for other in case.hypotheses:
            if other is hypothesis:
                continue
            fitted = np.concatenate([case.board.frame, case.board.columns(other.effects)])
            pair = frozenset((_name(hypothesis.effects), _name(other.effects)))
            now, then = lambdas.setdefault(pair, [np.inf, np.inf])
            lambdas[pair] = [
                min(now, apart(hypothesis.at.slopes, drawn, fitted)),
                min(then, apart(rows.slopes, drawn, fitted)),
            ]
    parted = [pair for pair, (now, then) in lambdas.items() if then >= DISTINGUISHED > now]
    order = [_name(hypothesis.effects) for hypothesis in case.hypotheses]
    named = []
    for pair in parted:
        first, second = sorted(pair, key=order.index)
        named.append((first, second))
    named.sort(key=lambda pair: [order.index(name) for name in pair])
    return tuple(named[:MOST_PARTED])


def _name(effects: Sequence[str]) -> str:
    return " + ".join(effects)


def _rooms(case: Case, planned: Planned, rooms: Sequence[Room]) -> tuple[RoomThen, ...]:
    """What could hide afterwards, the largest change first.

    About: the interval of an effect's least visible direction shrinks by so much, and with it what
    the diagnosis says could hide.
    """
    frame, rooms_then = case.frame, []
    rows = planned.ahead(frame)
    for room in rooms:
        if room.mm is None:
            continue
        columns = case.board.columns([room.effect])
        now = _smallest(frame.slopes, columns, case.board.frame)
        then = _smallest(rows.slopes, columns, case.board.frame)
        rooms_then.append(
            RoomThen(room.effect, room.mm, room.mm * (now / then if then > 0 else 1.0))
        )
    return tuple(ranked(rooms_then, lambda room: room.then - room.now))


def _smallest(slopes: Array, columns: Array, frame: Array) -> float:
    """Visible length of the least visible direction of an effect beyond the frame."""
    fitted = span(slopes[:, frame])
    beyond = slopes[:, columns] - fitted @ (fitted.T @ slopes[:, columns])
    return float(np.linalg.svd(beyond, compute_uv=False)[-1])


def _stability(case: Case) -> tuple[int, int]:
    """In how many of all deletions of a reading the suspect remains the best single effect."""
    suspect = case.hypotheses[0]
    if len(suspect.effects) > 1:
        return 0, 0
    board, frame = case.board, case.frame
    groups = _readings(case)
    kept = 0
    for reading in groups:
        rows = np.setdiff1d(np.arange(len(frame.slopes)), reading)
        costs = {}
        for name in case.singles:
            columns = np.concatenate([board.frame, board.columns([name])])
            fitted = span(frame.slopes[np.ix_(rows, columns)])
            left = frame.residual[rows] - fitted @ (fitted.T @ frame.residual[rows])
            costs[name] = float(left @ left) + 2 * len(board.columns([name]))
        kept += ranked(costs, costs.__getitem__)[0] == suspect.effects[0]
    return kept, len(groups)


def _readings(case: Case) -> list[Array]:
    """The rows of each mark (its repeats with it) and of each distance."""
    rows = case.board.rows
    names = np.array(rows.names)
    marks = [np.flatnonzero(names == name) for name in dict.fromkeys(rows.names)]
    groups = [np.concatenate([2 * repeats, 2 * repeats + 1]) for repeats in marks]
    return groups + [np.array([rows.measured.size + i]) for i in range(len(rows.distances))]
