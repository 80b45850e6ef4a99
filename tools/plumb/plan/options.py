"""Options to measure next: marks, repeats, heavier sleds, sides, checks."""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from plumb.model.catalogue import is_felt_by_approach
from plumb.model.plain import least, ranked
from plumb.plan.case import Case, PlannedCheck
from plumb.plan.planned_visits import Visits, grid, joined, new_places, nowhere, sent, usable
from plumb.plan.separation import FRAME_CHECKS, Chooser, NumberCheck, effect_checks
from plumb.settings.machine import GRAVITY
from plumb.text.values import Unit, in_both_units

Array = np.ndarray
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
