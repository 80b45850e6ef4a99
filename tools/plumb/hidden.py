"""Machines with something hidden: what it is, and where the judge hangs their sled."""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from math import cos
from typing import Any

import numpy as np

from plumb import _judge
from plumb.fit.compare import best_pose
from plumb.fit.observations import rms
from plumb.model.catalogue import EVERY_MACHINE, LAB_EFFECTS, every_effect
from plumb.model.predict import FOUND, NAMES, judged, lengths, with_parameters
from plumb.settings import MachineSettings

# Causes that can be hidden in a board: each effect of the library in the judge's numbers, and
# things that the library has no word for.


Array = np.ndarray
Numbers = dict[str, float]
Field = Callable[[Array], Array]  # how far the sled is off at places (n, 2) [mm]

# The default machine without effects.
BARE = MachineSettings(
    motor_gap=2978.4,
    motor_height=1072.6,
    rotation_radius=139.1,
    sheet_width=2438.4,
    sheet_height=1219.2,
    feed="top",
)
SLED = BARE.sled_weight  # [N]
HALF = np.array([1219.2, 609.6])  # [mm] of the sheet
# What the maker believes: the judge's chain, so that only what is hidden is missing.
CHAIN = {
    f"{effect['name']}.{parameter}": size
    for effect in every_effect()
    if effect["name"] in EVERY_MACHINE
    for parameter, size in effect["examples"][0]["sizes"].items()
}
MAKER = with_parameters(BARE, CHAIN)


@dataclass(frozen=True)
class Cause:
    """One effect in one direction of its parameters, by how many typical sizes of it there are."""

    effect: str
    label: str
    numbers: Callable[[float], Numbers] = lambda size: {}  # more of the judge's than sizes say
    sizes: Callable[[float], Numbers] = lambda size: {}  # the library's, by parameter
    drag: float = 0.0  # [N] of friction
    skew: float = 0.0  # [rad] of the sheet's edges
    strain: float = 0.0  # of the tape
    most: float = 20.0  # [mm] RMS of marks by it on the worst of real machines, roughly
    in_frame: bool = False  # a refitted frame or a turned sheet looks nearly the same


def _cause(effect: Mapping[str, Any], example: Mapping[str, Any], **board: Any) -> Cause:
    """Return a cause by an effect's words; what the maker's chain has already comes on top."""
    name, typical = effect["name"], example["sizes"]
    believed = {parameter: CHAIN.get(f"{name}.{parameter}", 0.0) for parameter in typical}
    return Cause(
        name,
        example["label"],
        sizes=lambda size: {
            parameter: believed[parameter] + size * typical[parameter] for parameter in typical
        },
        most=example["most"],
        in_frame=effect["in_frame"],
        **board,
    )


def _causes() -> Iterator[Cause]:
    hidden_as = {effect.name: effect.hidden_as for effect in LAB_EFFECTS}
    for effect in every_effect():
        for example in effect["examples"]:
            board = {}
            if effect["where"] == "lab":
                board = {hidden_as[effect["name"]]: next(iter(example["sizes"].values()))}
            yield _cause(effect, example, **board)


CAUSES: tuple[Cause, ...] = tuple(_causes())
REAL_MM = 3.0  # how far an effect moves marks that should be found
# What real machines can have by so much; friction by millimetres sticks for centimetres elsewhere.
USUAL = tuple(cause for cause in CAUSES if not cause.in_frame)
REAL = tuple(cause for cause in USUAL if cause.most >= REAL_MM and not cause.drag)


def causes_of(effect: str) -> tuple[Cause, ...]:
    """Return all causes of an effect, the usual cause first."""
    return tuple(cause for cause in CAUSES if cause.effect == effect)


@dataclass(frozen=True)
class Hidden:
    """Faults of a machine and its board, next to a frame that lies off by chance."""

    causes: tuple[tuple[Cause, float], ...] = ()  # with sizes in typical sizes
    outside: str = ""  # of OUTSIDE: what no effect of the library does
    outside_mm: float = 0.0  # RMS of it [mm]
    usual: tuple[tuple[Cause, float], ...] = ()  # on every machine, too small to ask for
    backlash: float = 0.0  # [mm] by which the sled stops short of each place, on every machine

    @property
    def effects(self) -> tuple[str, ...]:
        """The hidden effects of the library."""
        return tuple(cause.effect for cause, _ in self.causes)

    @property
    def parameters(self) -> Numbers:
        """The library's numbers that are not as on the maker's machine, by full name."""
        return {
            f"{cause.effect}.{name}": value
            for cause, size in (*self.usual, *self.causes)
            for name, value in cause.sizes(size).items()
        }

    @property
    def numbers(self) -> Numbers:
        """The judge's numbers that are not as on the maker's machine."""
        known = {name: value for name, value in self.parameters.items() if name in NAMES}
        believed = judged(MAKER)
        hidden = judged(with_parameters(MAKER, known)).items()
        changed = {name: value for name, value in hidden if value != believed[name]}
        for cause, size in self.causes:
            changed |= cause.numbers(size)
        return changed

    @property
    def drag(self) -> float:
        """Friction of the sled [N]."""
        return sum(cause.drag * size for cause, size in (*self.usual, *self.causes))

    def field(self, targets: Array, source: np.random.Generator) -> Field | None:
        """Draw how far the sled is off at places (n, 2) [mm] by what the library has no word for;
        targets (n, 2) [mm]: where it is so much RMS. None where it does nothing of the kind.
        """
        if not self.outside:
            return None
        drawn = OUTSIDE[self.outside](source)
        length = np.sqrt(np.mean(np.sum(drawn(targets) ** 2, axis=1)))
        scale = self.outside_mm / max(float(length), 1e-9)
        return lambda places: scale * drawn(places)

    def read(self, places: Array) -> Array:
        """Return places (n, 2) [mm] as edges that are not square and a wrong tape give them."""
        for cause, size in self.causes:
            skewed = cause.skew * size * places[:, 1]
            places = (places + np.stack([skewed, 0 * skewed], axis=1)) * (1 + cause.strain * size)
        return places


def _bump(source: np.random.Generator) -> Field:
    """Return a bump as wide as 0.35 half sheets each way, somewhere on the sheet, in some
    direction.
    """
    middle = source.uniform(-0.8, 0.8, 2)
    along = _direction(source)

    def moved(places: Array) -> Array:
        apart = np.sum((places / HALF - middle) ** 2, axis=1)
        return np.outer(np.exp(-apart / (2 * 0.35**2)), along)

    return moved


def _cubic(source: np.random.Generator) -> Field:
    """Return a polynomial of second and third degree in x and y, with coefficients of equal size.

    Shifts, turns, scales and skews are left out: the frame and the library have those.
    """
    powers = [(i, j) for i in range(4) for j in range(4) if 2 <= i + j <= 3]
    sizes = source.standard_normal((len(powers), 2))

    def moved(places: Array) -> Array:
        x, y = (places / HALF).T
        shape: Array = np.stack([x**i * y**j for i, j in powers], axis=1) @ sizes
        return shape

    return moved


def _tipping(source: np.random.Generator) -> Field:
    """Return a sled that hangs over one edge of the sheet, where nothing holds it, and tips.

    Its bit then leans outward or inward, and up or down, by how far the sled of 230 mm stands out.
    """
    side = int(source.integers(4))
    axis, sign = side % 2, 1 - 2 * (side // 2)
    along = _direction(source)

    def moved(places: Array) -> Array:
        out = np.maximum(sign * places[:, axis] + 230.0 - HALF[axis], 0.0)
        return np.outer(out, along)

    return moved


def _direction(source: np.random.Generator) -> Array:
    turn = source.uniform(0, 2 * np.pi)
    return np.array([np.cos(turn), np.sin(turn)])


OUTSIDE: Mapping[str, Callable[[np.random.Generator], Field]] = {
    "bump": _bump,
    "cubic": _cubic,
    "tipping sled": _tipping,
}


@dataclass(frozen=True)
class Plan:
    """Where the sled is sent, how it comes there, what hangs on it, and what is read."""

    targets: Array  # (n, 2) [mm]
    approaches: Array  # (n, 2) unit vectors, zero if unknown
    sled_weights: Array  # (n,) [N]
    again: tuple[int, ...] = ()  # marks that are read once more, each time
    spans: bool = False  # whether distances between marks are read instead of places
    name: str = field(default="", compare=False)


# The judge: where a sled with hidden faults comes to rest.
#
# It shares no formula with the laws that the lab fits, so a slip in a law cannot hide the same slip
# in the data.


def judged_places(
    numbers: Mapping[str, float], chains: Array, *, pushes: Array, weights: Array
) -> Array:
    """Return places (n, 2) [mm] of the sled of a machine with these numbers; NaN where it cannot
    hang.

    chains (n, 2) [mm] paid out, pushes (n, 2) [N] on the sled, weights (n,) [N] of it. A number
    that is not named is the judge's default. ValueError for a name that the judge does not know.
    """
    return _judge.places(
        {name: float(value) for name, value in numbers.items()},
        np.ascontiguousarray(chains, dtype=float),
        pushes=np.ascontiguousarray(pushes, dtype=float),
        weights=np.ascontiguousarray(weights, dtype=float),
    )


SIDES = np.array([(1.0, 0.0), (-1.0, 0.0), (0.0, 1.0), (0.0, -1.0)])
WIDTH, HEIGHT = 2200.0, 1000.0  # [mm] that a plan covers of the sheet


def plan(
    columns: int,
    rows: int,
    *,
    approached: bool = True,
    sled_weight: float = SLED,
    times: int = 1,
    repeats: bool = False,
    spans: bool = False,
) -> Plan:
    """Return a grid over the sheet, cut `times`; with `repeats` three marks are read three
    times.
    """
    across = np.linspace(-WIDTH / 2, WIDTH / 2, columns)
    up = np.linspace(HEIGHT / 2, -HEIGHT / 2, rows)
    once = np.array([(x, y) for y in up for x in across])
    targets = np.tile(once, (times, 1))
    sides = np.tile(SIDES[(np.arange(len(once)) * 7 // 3) % 4], (times, 1))
    chosen = (0, len(once) // 2, len(once) - 2) * 2 if repeats else ()
    return Plan(
        targets,
        sides if approached else 0 * sides,
        np.full(len(targets), float(sled_weight)),
        again=chosen,
        spans=spans,
        name=f"{columns}x{rows}",
    )


@dataclass(frozen=True)
class TrueMachine:
    """The true machine: the maker's with its frame off, and what is hidden."""

    hidden: Hidden
    motor_gap: float = MAKER.motor_gap
    motor_height: float = MAKER.motor_height
    motor_center_x: float = 0.0
    turn: float = 0.0  # [rad] of the sheet
    field: Field | None = None  # what else it does, which no effect of the library draws

    def read(self, chains: Array, *, approaches: Array, weights: Array) -> Array:
        """Return where marks would be read (n, 2) [mm] without noise; NaN where the sled cannot
        hang.
        """
        return self.hidden.read(self.on_sheet(chains, approaches=approaches, weights=weights))

    def on_sheet(self, chains: Array, *, approaches: Array, weights: Array) -> Array:
        """Return the same by a tape that is right, from edges that are square."""
        where = self.sleds(chains, approaches=approaches, weights=weights)
        where = where - self.hidden.backlash * approaches
        turned: Array = where @ np.array(
            [[cos(self.turn), self.turn], [-self.turn, cos(self.turn)]]
        )
        return turned

    def sleds(
        self, chains: Array, *, approaches: Array | None = None, weights: Array | None = None
    ) -> Array:
        """Return where the sled comes to rest (n, 2) [mm]; without approaches nothing rubs."""
        numbers = {
            **judged(MAKER),
            "motor_gap": self.motor_gap,
            "motor_height": self.motor_height,
            "motor_center_x": self.motor_center_x,
            **self.hidden.numbers,
        }
        heavier = numbers["sled_weight"] / SLED
        still = np.zeros_like(chains)
        where = judged_places(
            numbers,
            chains,
            pushes=still if approaches is None else -self.hidden.drag * approaches,
            weights=heavier * (np.full(len(chains), SLED) if weights is None else weights),
        )
        return where + self.field(where) if self.field else where


def read(machine: TrueMachine, plan: Plan, settings: MachineSettings = MAKER) -> Array:
    """Return where marks would be read (n, 2) [mm] without noise; ValueError if the sled cannot
    hang there.
    """
    where = machine.read(
        chains_for(plan, settings), approaches=plan.approaches, weights=plan.sled_weights
    )
    if not np.isfinite(where).all():
        raise ValueError("the judge's sled cannot hang at some mark")
    return where


def chains_for(plan: Plan, settings: MachineSettings = MAKER) -> Array:
    """Return what a machine of these settings pays out (n, 2) [mm]."""
    chains, outcome = lengths(settings, plan.targets)
    if not (outcome == FOUND).all():
        raise ValueError("a plan reaches beyond the machine")
    return chains


def raw_field(cause: Cause, size: float, plan: Plan) -> Array:
    """Return how far marks (n, 2) [mm] move by a cause of some typical sizes, nothing refitted."""
    there = read(TrueMachine(Hidden(((cause, size),))), plan)
    moved: Array = there - read(TrueMachine(Hidden()), plan)
    return moved


_SIZES: dict[tuple[Any, ...], float] = {}


def size_for(cause: Cause, plan: Plan, millimetres: float) -> float:
    """Return how many typical sizes move the marks by so much RMS, before anything is refitted."""
    key = (
        cause.effect,
        cause.label,
        plan.targets.tobytes(),
        plan.approaches.tobytes(),
        millimetres,
    )
    if key not in _SIZES:
        size = 1.0
        for _ in range(3):
            moved = raw_field(cause, size, plan)
            size *= millimetres / np.sqrt(np.mean(np.sum(moved**2, axis=1)))
        _SIZES[key] = float(size)
    return _SIZES[key]


# What settings are worth at the sled: the shape of its errors over the whole sheet.

COLUMNS, ROWS = 15, 9  # places of the sheet at which the sled is asked for
MARGIN = 50.0  # [mm] of the sheet's edge that is left out


def sheet() -> np.ndarray:
    """Return places (n, 2) [mm] all over the sheet."""
    across = np.linspace(-HALF[0] + MARGIN, HALF[0] - MARGIN, COLUMNS)
    up = np.linspace(-HALF[1] + MARGIN, HALF[1] - MARGIN, ROWS)
    return np.array([(x, y) for y in up for x in across])


def shape_error(settings: MachineSettings, landed: Callable[[Array], Array]) -> float:
    """RMS [mm] of how far the judge's sled, sent by these settings to places all over the sheet,
    is from them once the sheet is laid at its best; `landed` says where it is by its chains.
    Nothing rubs: no setting knows of friction."""
    chains, outcome = lengths(settings, sheet())
    return shape_of(landed(chains)) if (outcome == FOUND).all() else float("inf")


def shape_of(places: Array) -> float:
    """RMS [mm] of how far places (n, 2) [mm] are from those of `sheet`, laid at its best."""
    pose = best_pose(sheet(), places)
    return rms(pose.errors) if pose else 0.0
