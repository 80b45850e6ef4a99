"""Proposals to measure next: the options, their chance to settle the question, their minutes."""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from math import erf, sqrt
from typing import Annotated, Literal

import numpy as np

from plumb.diagnosis.diagnosis import Diagnosis, Room, Verdict
from plumb.diagnosis.evidence import Noise
from plumb.diagnosis.explanation import Board, Explanation, span
from plumb.diagnosis.readings import Outlier
from plumb.fit.inputs import Inputs
from plumb.fit.observations import Observations
from plumb.model.catalogue import every_effect, is_felt_by_approach
from plumb.model.plain import ascending, greatest, least, ranked
from plumb.plan.case import (
    Case,
    Hypothesis,
    Outlooks,
    PlannedCheck,
    PlannedMeasurement,
    case_of,
    seen_on,
)
from plumb.plan.planned_visits import (
    Visit,
    Visits,
    grid,
    joined,
    marks_file,
    new_places,
    nowhere,
    program,
    sent,
    usable,
)
from plumb.settings import GRAVITY, cut_with_lines, with_form
from plumb.text.answers import Internal, among, in_json, key, meant, part
from plumb.text.errors import Source
from plumb.text.values import Unit, in_both_units

# A measure of how well a plan distinguishes two effects, and the visits that do it best.
#
# lambda = squared length, in sigmas, of what one effect draws and neither the refitted frame nor
# the other effect can imitate. A pair is distinguished nearly always at 12, so more of it counts no
# more: no single pair may eat the whole effort (T-optimal design, capped).


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


# Options to measure next: marks, repeats, heavier sleds, sides, checks.


EXTRA_KILOGRAMS = (2.5, 5.0, 10.0)  # what a maker finds to hang on a sled
FEW = 4  # marks of a proposal
MANY_GRID, MANY_MARGIN = (7, 4), (0.07, 0.12)  # the 28 marks that it is compared with
SHARPER = 1.5  # times better than what is known: else a check is not worth the way
READ_AGAIN = 3  # times each mark is read again
MOST_NEAR = 60  # marks next to which a new mark is considered
MOST_AGAIN = 12  # marks that are all visited again with another weight
# Minutes: a round at the machine, a mark cut and read, a mark read once more, a change of weight.
ROUND, MARK, READING, HANGING = 3.0, 1.5, 0.75, 4.0
# [mm] inwards of a mark is room for a second mark; in the same hole nothing is read.
ROOM_FOR_A_SECOND = 20.0
READ_ONLY = ("repeats", "reread")  # kinds of options whose marks are on the sheet already
SIDES = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])


@dataclass(frozen=True)
class Option:
    """One thing that could be measured."""

    kind: str
    title: str
    do: tuple[str, ...]  # what to do, in sentences
    minutes: float
    visits: Visits
    checks: tuple[PlannedCheck, ...] = ()

    @property
    def is_cut(self) -> bool:
        """Whether it needs new marks; what is only read again needs a tape."""
        return len(self.visits) > 0 and self.kind not in READ_ONLY


def options(case: Case) -> list[Option]:
    """Return everything worth a thought for this case."""
    shop = _Shop(case)
    if case.verdict == "one_suspect":
        # Repeats share every systematic error with what they repeat: they confirm nothing.
        about_causes = [*shop.ordinary(), *shop.heavier()]
        return about_causes + [option for option in checks_for(case) if option.kind == "check"]
    everything = [*shop.ordinary(), shop.repeats(), *shop.heavier(), *shop.sides()]
    return [option for option in everything if option is not None] + checks_for(case)


def many_marks(case: Case) -> Option | None:
    """Return what blind diligence would do: a fine grid of ordinary marks."""
    return _Shop(case).many()


def checks_for(case: Case) -> list[Option]:
    """Direct measurements of the suspects and of the frame's numbers that were not made yet."""
    problem = case.board.problem
    made = {check.name: check.sigma for check in problem.checked}
    held = np.flatnonzero(problem.held)
    known = {problem.names[i]: float(problem.scale[i]) for i in held} | made
    offered = []
    for name, direct in effect_checks().items():
        each = tuple(PlannedCheck(f"{name}.{part}", sigma) for part, sigma in direct.sigmas.items())
        if name in case.effects and any(_sharper(check, known) for check in each):
            offered.append(_check("check", direct, each))
    for name, direct in FRAME_CHECKS.items():
        check = PlannedCheck(name, direct.sigmas[name])
        if name in known and _sharper(check, known):
            offered.append(_check("frame", direct, (check,)))
    return offered


def _sharper(check: PlannedCheck, known: Mapping[str, float]) -> bool:
    """Return whether it says more than what is known already."""
    return known.get(check.name, np.inf) > SHARPER * check.sigma


def _check(kind: str, number: NumberCheck, each: tuple[PlannedCheck, ...]) -> Option:
    return Option(kind, number.title, (number.steps,), number.minutes, nowhere(), each)


class _Shop:
    """Makes options for a case."""

    def __init__(self, case: Case) -> None:
        self.case, self.rows, self.unit = case, case.board.rows, case.board.unit
        known: dict[str, int] = {}
        for name, row in zip(self.rows.names, self.rows.mark_rows, strict=True):
            known.setdefault(name, int(row))
        self.known = known
        first = [self.rows.names.index(name) for name in known]
        self.old_targets = self.rows.targets[first].reshape(-1, 2)
        self.new_targets = new_places(case.settings.sheet, self.old_targets)

    def ordinary(self) -> list[Option]:
        """Return a few more marks with the sled as it is."""
        pool = self.pool(self.case.usual_weight)
        if len(pool) < FEW:
            return []
        visits = pool.taken(self.spread(pool))
        do = f"Cut and read {FEW} marks more, at {spots(visits, self.unit)}."
        return [_marks("marks", f"{FEW} more marks", do, visits)]

    def many(self) -> Option | None:
        places = grid(self.case.settings.sheet, *MANY_GRID, margin=MANY_MARGIN)
        places = places[usable(self.case.settings, places, self.case.usual_weight)]
        if not len(places):
            return None
        visits = self.visits(places, self.case.usual_weight)
        do = f"Cut and read {len(places)} marks more all over the sheet."
        return _marks("many", f"{len(places)} more marks", do, visits)

    def repeats(self) -> Option | None:
        """Return all marks read again."""
        if not self.known:
            return None
        old = joined(*[self.old()] * READ_AGAIN)
        times = f"{READ_AGAIN} more times with a newly laid tape"
        do = f"Read each of the {len(self.known)} marks {times}."
        return Option("repeats", "every mark read again", (do,), ROUND + READING * len(old), old)

    def heavier(self) -> list[Option]:
        """Return marks under a sled on which more hangs: as chosen best, in fixed patterns, and
        all.
        """
        offered = []
        for kilograms in EXTRA_KILOGRAMS:
            weight = self.case.usual_weight + kilograms * GRAVITY
            if weight > 2.05 * self.case.usual_weight:
                continue
            pool = self.pool(weight)
            if len(pool) < FEW:
                continue
            visits = pool.taken(self.spread(pool))
            offered.append(_heavier(f"{FEW} marks", kilograms, visits, self.unit))
            near = self.visits(self.inwards(ROOM_FOR_A_SECOND), weight)
            if kilograms == EXTRA_KILOGRAMS[1] and FEW < len(near) <= MOST_AGAIN:
                offered.append(
                    _heavier(f"{len(near)} marks near the old", kilograms, near, self.unit)
                )
        return offered

    def spread(self, pool: Visits) -> list[int]:
        """Return the best few of a pool: as chosen one by one, or one of the patterns that often
        do.
        """
        chooser = Chooser(self.case, pool)
        tries = [chooser.best(range(len(pool)), FEW)]
        width, height = self.case.settings.sheet
        for pattern in PATTERNS:
            wanted = np.array(pattern) * (width / 2, height / 2)
            gaps = np.linalg.norm(pool.targets[:, np.newaxis] - wanted, axis=2)
            tries.append([least(column) for column in gaps.T])
        several = [chosen for chosen in tries if len(set(chosen)) == FEW]
        return ranked(several, lambda chosen: -chooser.worth(chosen))[0]

    def sides(self) -> list[Option]:
        """Two marks close together, touched from opposite sides, where friction may play a part."""
        if not any(map(is_felt_by_approach, self.case.effects)) or not self.known:
            return []
        weight, room = self.case.usual_weight, ROOM_FOR_A_SECOND
        near, far = self.inwards(room), self.inwards(2 * room)
        # It does not matter which of both is touched from where: one pool for each pair of sides.
        groups = [
            self.visits(near if i % 2 == 0 else far, weight, sides=side)
            for i, side in enumerate(SIDES)
        ]
        pool, count = joined(*groups), len(self.known)
        if len(pool) < len(SIDES) * count:
            return []
        chosen = Chooser(self.case, pool).best(range(len(pool)), FEW // 2)
        both = {twin for i in chosen for twin in (i, (i // count ^ 1) * count + i % count)}
        visits = pool.taken(sorted(both, key=lambda i: (i % count, i)))
        way = self.unit.reading(in_both_units("the last {100 mm|3.9 inch} straight"))
        do = (
            f"Touch two marks next to each other from opposite sides, {way} towards the mark, at "
            f"{spots(visits, self.unit)}; write down the approach."
        )
        return [_marks("approach", "marks from opposite sides", do, visits)]

    def pool(self, weight: float) -> Visits:
        """Return places near the marks there are, and new places, as far as they are usable so
        loaded.
        """
        near = self.inwards(ROOM_FOR_A_SECOND)
        if len(near) > MOST_NEAR:
            # Of marks that lie close together a few do as well as all.
            gaps = np.linalg.norm(grid(self.case.settings.sheet)[:, np.newaxis] - near, axis=2)
            near = near[np.unique([least(row) for row in gaps])]
        places = np.vstack([near, self.new_targets])
        places = places[usable(self.case.settings, places, weight)]
        return self.visits(places, weight)

    def inwards(self, millimetres: float) -> Array:
        """Return places (n, 2) so far inwards of the marks there are."""
        return self.old_targets - millimetres * np.where(self.old_targets > 0, 1.0, -1.0)

    def old(self) -> Visits:
        """Return the marks there are, as they were visited."""
        rows, first_rows = self.rows, list(self.known.values())
        first = [rows.names.index(name) for name in self.known]
        return Visits(
            tuple(self.known),
            rows.targets[first],
            rows.chains[first_rows],
            rows.sled_weights[first_rows],
            rows.approaches[first_rows],
        )

    def visits(self, places: Array, weight: float, *, sides: Array | None = None) -> Visits:
        """Visits of new places, approached as the nearest mark was, or from the sides given."""
        approaches = np.zeros((len(places), 2))
        if sides is not None:
            approaches = np.tile(sides, (len(places), 1))
        elif len(self.old_targets) and len(places):
            gaps = np.linalg.norm(places[:, np.newaxis] - self.old_targets, axis=2)
            nearest = np.array(list(self.known.values()))[[least(row) for row in gaps]]
            approaches = self.rows.approaches[nearest]
        try:
            return sent(
                self.case.settings,
                places,
                controller=self.case.controller,
                sled_weight=weight,
                approaches=approaches,
            )
        except ValueError:
            # A controller that cannot go there is not asked to.
            return nowhere()


# Half sheets: the corners, and three along the top with one below.
PATTERNS = (
    ((-0.9, 0.82), (0.9, 0.82), (-0.9, -0.82), (0.9, -0.82)),
    ((-0.9, 0.82), (0.0, 0.82), (0.9, 0.82), (0.0, -0.82)),
)


def _marks(kind: str, title: str, do: str, visits: Visits, *, more: float = 0.0) -> Option:
    return Option(kind, title, (do,), ROUND + MARK * len(visits) + more, visits)


def _heavier(which: str, kilograms: float, visits: Visits, unit: Unit) -> Option:
    places = spots(visits, unit)
    do = (
        f"Hang {kilograms:g} kg more on the sled, low and in the middle, change nothing else, and "
        f"cut and read {len(visits)} marks, at {places}. Weigh what you hang."
    )
    title = f"{which} with {kilograms:g} kg more"
    return _marks("weight", title, do, visits, more=HANGING)


def spots(visits: Visits, unit: Unit) -> str:
    """Return the places for people, each once; a mark that is there already by its name."""
    named = zip(visits.names, visits.targets, strict=True)
    return ", ".join(dict.fromkeys(_spot(name, at, unit) for name, at in named))


def _spot(name: str, at: Array, unit: Unit) -> str:
    place = f"({unit.bare(at[0], 0)}, {unit.bare(at[1], 0)})"
    return place if "/" in name else f"{name} {place}"


# Proposals to measure next, by their chance to settle the question for their minutes.


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
    diagnosis: Diagnosis, inputs: Inputs, *, progress: Callable[[float], None] = lambda share: None
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
        (name,), rows.targets[[i]], rows.chains[row], rows.sled_weights[row], rows.approaches[row]
    )
