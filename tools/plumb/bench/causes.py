"""Causes that can be hidden in a board: each effect of the library in the judge's numbers, and
things that the library has no word for.
"""

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from typing import Any

import numpy as np

from plumb.model.catalogue import EVERY_MACHINE, every_effect
from plumb.model.lab_effects import LAB_EFFECTS
from plumb.model.predict import NAMES, judged, with_parameters
from plumb.settings.machine import MachineSettings

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
# As published settings are: they correct the chain's sag and know nothing of its stretch.
PUBLISHED = with_parameters(
    BARE, {name: size for name, size in CHAIN.items() if name.startswith("chain_sag.")}
)


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
