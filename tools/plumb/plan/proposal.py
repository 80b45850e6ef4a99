"""Proposals to measure next, by their chance to settle the question for their minutes."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import erf, sqrt
from typing import Annotated, Literal

import numpy as np

from plumb.diagnosis.answer import Diagnosis, Verdict
from plumb.diagnosis.explanation import Explanation, span
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.outliers import Outlier
from plumb.diagnosis.sizes import Room
from plumb.fit.inputs import Inputs
from plumb.fit.observations import Observations
from plumb.model.plain import ascending, ranked
from plumb.plan.case import Case, PlannedCheck, PlannedMeasurement, case_of
from plumb.plan.options import MARK, READING, ROUND, Option, many_marks, options, spots
from plumb.plan.outlook import Outlooks
from plumb.plan.planned_visits import (
    Visit,
    Visits,
    joined,
    marks_file,
    nowhere,
    program,
    sent,
    usable,
)
from plumb.plan.separation import ENOUGH, apart, drawn_by
from plumb.settings.cut_with import cut_with_lines, with_form
from plumb.text.answers import Internal, among, in_json, key, meant, part
from plumb.text.errors import Source
from plumb.text.values import Unit

Array = np.ndarray
# A question: what the chance is the chance of.
SETTLE, CONFIRM, FIND, REREAD, EXPLORE = "settle", "confirm", "find", "reread", "explore"
AGAIN = 10.0  # minutes that another round costs when this round did not settle it
DISTINGUISHED = 0.75 * ENOUGH  # lambda from which a pair counts as distinguished
MOST_PARTED = 6
Worth = Literal["settles", "helps", "nothing_would"]
LIKELY = 0.5  # a chance from which on a measurement is said to settle the question
QUESTIONS = {"cannot_tell": SETTLE, "one_suspect": CONFIRM, "nothing_provable": FIND}


@dataclass(frozen=True)
class RoomThen:
    """The largest effect that could hide, RMS over the marks: so far, and afterwards."""

    effect: str
    now: Annotated[float, key("now_mm")]
    then: Annotated[float, key("then_mm")]


@dataclass(frozen=True)
class Proposal:
    """One thing to measure, and what to expect of it."""

    option: Internal[Option]
    unit: Internal[Unit]  # of the lengths in what is said of it
    question: Annotated[str, key("chance_to"), among((SETTLE, CONFIRM, FIND, REREAD, EXPLORE))]
    chance: Annotated[float | None, meant("Null: nothing can be computed.")]
    left: Annotated[float | None, key("suspects_left", "On average.")]
    bits: Annotated[float | None, meant("Expected information on which account holds.")] = None
    # and not by the marks so far
    parts: Annotated[tuple[tuple[str, str], ...], meant("Pairs distinguished then.")] = ()
    # what the largest hidden effects could then still be
    rooms: Annotated[tuple[RoomThen, ...], key("could_hide")] = ()

    kind = part("option.kind", str)
    title = part("option.title", str)
    do = part("option.do", tuple[str, ...])
    minutes = part("option.minutes", float)
    marks = part("option.visits.each", tuple[Visit, ...])
    checks = part("option.checks", tuple[PlannedCheck, ...])

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

    verdict: Verdict
    case: Internal[Case | None]
    proposals: Annotated[tuple[Proposal, ...], key("next")]
    # as many more marks as patience allows
    blind: Annotated[Proposal | None, key("more_marks")]

    @in_json
    def state(self) -> Worth:
        """What the best of them is good for."""
        return worth(self.proposals[0] if self.proposals else None)


def worth(best: Proposal | None) -> Worth:
    """Return what a measurement is good for; None: nothing can be proposed."""
    if best is None:
        return "nothing_would"
    settles = best.question != FIND and (best.chance or 0.0) >= LIKELY
    return "settles" if settles else "helps"


def propose(
    diagnosis: Diagnosis,
    inputs: Inputs,
    *,
    progress: Callable[[float], None] = lambda share: None,
) -> Next:
    """Return the next measurements for a diagnosis, given the inputs it was made of.

    `progress` is called with the share of the work that is done.
    """
    case = case_of(diagnosis, inputs)
    if diagnosis.verdict == "slip":
        _, rows = inputs.model_and_observations()
        proposals = [
            Proposal(option, inputs.unit, REREAD, chance, None)
            for option, chance in for_slips(diagnosis.outliers, rows, case.noise)
        ]
        return Next(diagnosis.verdict, case, tuple(proposals), None)
    if diagnosis.verdict == "not_in_library":
        proposals = [
            Proposal(option, inputs.unit, EXPLORE, None, None) for option in near_the_worst(case)
        ]
        return Next(diagnosis.verdict, case, tuple(proposals), None)
    several, outlooks = options(case), Outlooks(case)
    blind = many_marks(case)
    everything = [*several, *([blind] if blind else [])]
    weighed = []
    for number, option in enumerate(everything):
        weighed.append(_weighed(outlooks, option, diagnosis.could_hide))
        progress((number + 1) / len(everything))
    against = weighed.pop() if blind else None
    return Next(diagnosis.verdict, case, _best_first(weighed), against)


def _best_first(proposals: Sequence[Proposal]) -> tuple[Proposal, ...]:
    """Return one suspect is confirmed best by what measures the cause itself."""
    by_rate = ranked(proposals, lambda proposal: -proposal.rate)
    return tuple(
        sorted(by_rate, key=lambda each: each.question == CONFIRM and each.option.kind != "check")
    )


def _weighed(outlooks: Outlooks, option: Option, rooms: Sequence[Room]) -> Proposal:
    """Return an option with what to expect of it."""
    case, planned = outlooks.case, PlannedMeasurement(option.visits, option.checks)
    expected = outlooks.of(planned)
    question = QUESTIONS[case.verdict]
    parts = _parted(case, planned) if question != FIND else ()
    then = _rooms(case, planned, rooms) if question == FIND else ()
    chance, left, bits = expected.chance, expected.left, expected.bits
    return Proposal(option, case.board.unit, question, chance, left, bits, parts, then)


def _parted(case: Case, planned: PlannedMeasurement) -> tuple[tuple[str, str], ...]:
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


def _rooms(case: Case, planned: PlannedMeasurement, rooms: Sequence[Room]) -> tuple[RoomThen, ...]:
    """Return what could hide afterwards, the largest change first.

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


# The files of a proposal: the form that waits for its readings, and the program that cuts it.


def form_of(
    advice: Next, place: int, path: str, *, settings: Source | None, sheet: tuple[float, float]
) -> bytes:
    """Return the form at that path for the proposal with this number, from 1.

    `settings` is the file of the settings that the new marks are cut with, which the form then
    names; `sheet` is theirs.
    """
    option = advice.proposals[place - 1].option
    assert advice.case, "what is proposed is proposed for a case"
    return marks_file(
        option.visits,
        sheet=sheet,
        controller=advice.case.controller,
        said=(f"Proposal {place}: {option.title}.", *option.do),
        cut_with=cut_with_lines(settings, path),
        unit=advice.case.board.unit,
    ).encode()


def program_of(advice: Next, place: int, path: str, *, form: str | None) -> bytes:
    """Return the program for the proposal at `place`, from 1; it names the form."""
    option = advice.proposals[place - 1].option
    assert advice.case, "what is proposed is proposed for a case"
    text = program(option.visits, usual_weight=advice.case.usual_weight, do=option.do)
    return (with_form(text, form, path) if form else text).encode()


# Measurements where no effect is in question: readings that disagree, unexplained marks.

SURE = 3.0  # deviations by which a second reading shows that the first was wrong
WORST = 2  # places around which marks are proposed
BESIDE = 200.0  # [mm] from such a place
READ_AGAIN = 3


def for_slips(
    slips: Sequence[Outlier], rows: Observations, noise: Noise
) -> list[tuple[Option, float]]:
    """Return the option to read them again, with the chance that it shows the slip; `rows` are all
    readings, the slips among them.
    """
    offered = []
    for slip in slips:
        # Two readings with the same noise differ by its square root of two.
        chance = 0.5 * (1 + erf((slip.length / (sqrt(2) * noise.sigma) - SURE) / sqrt(2)))
        what = slip.name if slip.name in rows.names else f"the distance {slip.name}"
        do = f"Read {what} again with a newly laid tape, before anything else."
        offered.append(
            (Option("reread", f"{slip.name} again", (do,), 2.0, _old(rows, slip.name)), chance)
        )
    return offered


def near_the_worst(case: Case) -> list[Option]:
    """Return marks around the places that are explained worst, then readings of these once more."""
    rows = case.board.rows
    best = case.best
    if not len(rows.measured):
        return [_worst_distances(case, best)]
    errors = best.numbers[: rows.measured.size].reshape(-1, 2)
    worst = ascending(-np.linalg.norm(errors, axis=1))
    places: dict[str, Array] = {}
    for i in worst:
        places.setdefault(rows.names[i], rows.targets[i])
        if len(places) == WORST:
            break
    near = _around(case, list(places.values()))
    names = ", ".join(places)
    again = joined(*[_old(rows, name) for name in places for _ in range(READ_AGAIN)])
    offered = [
        Option(
            "repeats",
            "the worst marks read again",
            (f"Read {names} {READ_AGAIN} more times: this tells a slip from something real.",),
            ROUND + READING * len(again),
            again,
        )
    ]
    if len(near):
        do = (
            f"Cut and read marks around {names}, where the error is worst, at "
            f"{spots(near, case.board.unit)}: what is local (a bent frame, a bump in the sheet, a "
            "sticking chain) shows itself here."
        )
        minutes = ROUND + MARK * len(near)
        offered.append(Option("near", "marks around the worst places", (do,), minutes, near))
    return offered


def _worst_distances(case: Case, best: Explanation) -> Option:
    """Return the distances that are explained worst, to be measured again."""
    worst = ascending(-np.abs(best.numbers))[: 2 * WORST]
    said = ", ".join(case.spans[i] for i in worst)
    do = f"Measure these distances {READ_AGAIN} more times: {said}. This tells a slip from more."
    minutes = ROUND + READING * READ_AGAIN * len(worst)
    return Option("repeats", "the worst distances again", (do,), minutes, nowhere())


def _around(case: Case, places: Sequence[Array]) -> Visits:
    """Two new marks near each place, on the sheet."""
    half = np.array(case.settings.sheet) / 2 - 50.0
    wanted = [
        np.round(np.clip(at + side, -half, half), -1)
        for at in places
        for side in ((-np.sign(at[0] or 1) * BESIDE, 0.0), (0.0, -np.sign(at[1] or 1) * BESIDE))
    ]
    targets = np.array(wanted).reshape(-1, 2)
    targets = targets[usable(case.settings, targets, case.usual_weight)]
    if not len(targets):
        return nowhere()
    return sent(case.settings, targets, controller=case.controller, sled_weight=case.usual_weight)


def _old(rows: Observations, name: str) -> Visits:
    """Return one visit of a mark that is there; nothing for a distance."""
    if name not in rows.names:
        return nowhere()
    i = rows.names.index(name)
    row = [int(rows.mark_rows[i])]
    return Visits(
        (name,),
        rows.targets[[i]],
        rows.chains[row],
        rows.sled_weights[row],
        rows.approaches[row],
    )
