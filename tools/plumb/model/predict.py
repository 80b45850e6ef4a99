"""The lab's only door to the compiled kinematics: words of its effects, settings in, chain lengths
and places out.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from functools import cache
from typing import TYPE_CHECKING, Literal, NamedTuple

import numpy as np
from numpy.typing import ArrayLike, NDArray
from typing_extensions import TypedDict

from plumb import _core

if TYPE_CHECKING:
    from plumb._core import FrameWords
from plumb.settings import HOLEY_CHAIN_WEIGHT, MachineSettings, frame_of
from plumb.text.values import in_both_units

# The words of an effect, as the firmware's library has them (lib/Kinematics/src/effect.h).


class PlainWords(TypedDict):
    """The size of a parameter in a maker's words."""

    more: str
    less: str
    unit: str
    times: float
    shown: str


Curve = Literal["straight", "square", "tangent squared"]  # of the tangent: degrees
Unit = Literal["mm", "kg", "g", "degrees"]


class ReadingWords(TypedDict):
    """Reading on a rule or a scale, from which a parameter follows."""

    title: str
    unit: Unit
    usual: float
    factor: float
    digits: int
    zero: float
    curve: Curve


class ParameterWords(TypedDict):
    """Words for people about a parameter of an effect."""

    name: str
    setting: int | None
    unit: str
    low: float
    high: float
    typical: float
    summary: str
    sigma: float
    plain: PlainWords | None
    reading: ReadingWords | None
    published: tuple[int, float] | None


class CheckWords(TypedDict):
    """The direct measurement of an effect."""

    title: str
    steps: str
    value: str
    minutes: float


class ExampleWords(TypedDict):
    """Sizes to try, and how far they move a mark."""

    label: str
    sizes: dict[str, float]
    most: float


class EffectWords(TypedDict):
    """Words for people about an effect."""

    name: str
    noun: str
    where: str
    summary: str
    pattern: str
    look_alikes: str
    remedy: str
    empirical: bool
    per_zeroing: bool
    in_frame: bool
    weight_power: int
    check: CheckWords | None
    examples: list[ExampleWords]
    parameters: list[ParameterWords]


@dataclass(frozen=True)
class RuleReading:
    """Reading on a rule or a scale, from which a number follows: factor * curve(reading - zero)."""

    title: str
    usual: float  # how far a careful reading may be off
    factor: float = 1.0
    unit: Unit = "mm"
    digits: int = 1
    zero: float = 0.0
    curve: Curve = "straight"

    def value(self, read: float) -> float:
        """Return the number that a reading says."""
        return self.factor * CURVES[self.curve][0](read - self.zero)

    def read(self, value: float) -> float:
        """Return what would be read for a number."""
        return self.zero + CURVES[self.curve][1](value / self.factor)

    def value_within(self, read: float, within: float) -> float:
        """Return how far the number of a reading may be off that may be off so far."""
        if self.curve == "straight":  # without the noise of a difference
            return abs(self.factor) * within
        return abs(self.value(self.zero + abs(read - self.zero) + within) - self.value(read))

    def read_within(self, value: float, within: float) -> float:
        """Return how far the reading of a number may be off that may be off so far."""
        if self.curve == "straight":
            return within / abs(self.factor)
        away = abs(value) + within if self.factor > 0 else -abs(value) - within
        return abs(self.read(away) - self.read(value))


def _root(number: float) -> float:
    return math.sqrt(max(number, 0.0))


# Each with its inverse, for readings from zero on.
CURVES: Mapping[str, tuple[Callable[[float], float], Callable[[float], float]]] = {
    "straight": (lambda read: read, lambda number: number),
    "square": (lambda read: read * read, _root),
    "tangent squared": (
        lambda read: math.tan(math.radians(read)) ** 2,
        lambda number: math.degrees(math.atan(_root(number))),
    ),
}


# The lab's only door to the compiled kinematics: settings in, chain lengths and places out.


Array = NDArray[np.float64]
Codes = NDArray[np.uint8]  # FOUND ... of each place or length, or USABLE ...
NAMES: tuple[str, ...] = tuple(_core.settings())  # of the values array, in its order
FOUND, OUT_OF_REACH, TOO_MANY_TRIES = 0, 1, 2  # what the kinematics says of a place or length
FOUND_WORDS = ("yes", "out of reach", "too many tries")
USABLE, TOO_TIGHT, TOO_SLACK, TOO_VERTICAL, CANNOT_HANG = range(5)  # what it says of a place's use
REACH_WORDS = ("usable", "too tight", "too slack", "too vertical", "cannot hang")
REACH_LIMITS: Mapping[str, float] = _core.reach_limits()  # the usual limits, by name [N, mm, mm/N]


@dataclass(frozen=True)
class Reached:
    """Use of n places; a place where nothing hangs has zeros."""

    verdict: Codes  # (n,) USABLE ...
    tension: Array  # (n, 2) [N] of left and right chain at their sprockets
    compliance: Array  # (n, 2, 2) [mm/N] of the sled by a force along the sheet, symmetric

    @property
    def give(self) -> Array:
        """Compliance (n,) [mm/N] in the direction in which the sled gives most."""
        return np.asarray(np.linalg.eigvalsh(self.compliance)[:, -1], dtype=float)


@cache
def library() -> list[EffectWords]:
    """Return every effect of the firmware, in the order applied: words, parameters and units."""
    effects = _core.effects()
    for effect in effects:
        if effect["check"]:
            effect["check"]["steps"] = in_both_units(effect["check"]["steps"])
        for reading in filter(None, (each["reading"] for each in effect["parameters"])):
            reading["title"] = in_both_units(reading["title"])
    return effects


def frame_words() -> list[FrameWords]:
    """Return the frame's numbers: name, unit, usual, low, high, summary."""
    return _core.frame()


def known_effects() -> dict[str, list[str]]:
    """Return the names of each effect's parameters."""
    return {
        effect["name"]: [parameter["name"] for parameter in effect["parameters"]]
        for effect in library()
    }


def values_of(settings: MachineSettings) -> Array:
    """Our model of a machine as the values array (len(NAMES),) [mm, N, rad]."""
    return np.array([_value(settings, name) for name in NAMES], dtype=float)


def settings_of(values: Array, *, like: MachineSettings) -> MachineSettings:
    """Return the machine with these values; effects that are all zero are left out."""
    by_name = dict(zip(NAMES, (float(value) for value in values), strict=True))
    effects: dict[str, Mapping[str, float]] = {}
    for effect, parameters in known_effects().items():
        sizes = {name: by_name[f"{effect}.{name}"] for name in parameters}
        if any(sizes.values()):
            effects[effect] = sizes
    return replace(like, effects=effects, **frame_of(by_name))


def with_parameters(settings: MachineSettings, parameters: Mapping[str, float]) -> MachineSettings:
    """Return the machine with some parameters set, by full name `effect.parameter`."""
    effects = {name: dict(sizes) for name, sizes in settings.effects.items()}
    for name, value in parameters.items():
        effect, _, parameter = name.rpartition(".")
        effects.setdefault(effect, {})[parameter] = value
    return replace(settings, effects=effects)


def judged(settings: MachineSettings) -> dict[str, float]:
    """Our model of a machine in the numbers of the judge (tools/judge/reference/numbers.h)."""
    return _core.judged(values_of(settings), settings.feed == "top")


def usual_parameters(settings: MachineSettings) -> dict[str, float]:
    """Return what every machine with this frame has, by full name: the size to expect."""
    return _core.usual(values_of(settings), settings.feed == "top")


def lengths(
    settings: MachineSettings, points: Array, *, float32: bool = False
) -> tuple[Array, Codes]:
    """Chain paid out (n, 2) [mm] for places (n, 2) [mm] by our model, and FOUND (n,)."""
    return _core.lengths(
        values_of(settings), settings.feed == "top", _pairs(points), float32=float32
    )


def places(settings: MachineSettings, chains: Array) -> tuple[Array, Codes]:
    """Return places (n, 2) [mm] for chains paid out (n, 2) [mm] by our model, and FOUND (n,)."""
    return _core.places(values_of(settings), settings.feed == "top", _pairs(chains))


def reach(settings: MachineSettings, points: Array) -> Reached:
    """Return whether places (n, 2) [mm] are usable, by our model."""
    return Reached(**_core.reach(values_of(settings), settings.feed == "top", _pairs(points)))


def places_with_slopes(
    values: Array, *, over_top: bool, chains: Array
) -> tuple[Array, Array, Codes]:
    """Return places (n, 2), their slopes by every value (n, 2, len(NAMES)), and FOUND (n,).

    The chains are given, so place and values balance in lengths(place, values) = chains; hence
    d place = -(d lengths / d place)^-1 (d lengths / d values): the slopes are exact.
    """
    where, outcome = _core.places(values, over_top, _pairs(chains))
    by_value, by_place, _ = _core.slopes(values, over_top, where)
    slopes = np.zeros_like(by_value)
    good = outcome == FOUND
    slopes[good] = -np.linalg.solve(by_place[good], by_value[good])
    return where, slopes, outcome


def believed_lengths(
    settings: MachineSettings, targets: Array, *, controller: str | None = None
) -> Array:
    """Chain (n, 2) [mm] that the machine paid out for targets (n, 2) [mm], right or wrong.

    Raises ValueError naming a target that the controller cannot reach.
    """
    whose = controller or settings.controller
    if whose != "plumb":
        return chain_lengths(settings, targets, controller=whose)
    chains, outcome = lengths(settings.as_plumb_model(), targets)
    for i in np.flatnonzero(outcome != FOUND)[:1]:
        raise ValueError(f"target ({targets[i, 0]:g}, {targets[i, 1]:g}) is out of reach")
    return chains


def _value(settings: MachineSettings, name: str) -> float:
    effect, _, parameter = name.rpartition(".")
    return settings.effect(effect, parameter) if effect else getattr(settings, name)


def _pairs(points: Array) -> Array:
    return np.ascontiguousarray(points, dtype=float).reshape(-1, 2)


# What the machine believed: chain lengths by the formulas of the published controllers.
#
# Not the truth, and not the kinematics of lib: only what was paid out when a mark was made.

# The published sources write the number so; for a chain under the sprocket it is 0.03 um of chain.
PUBLISHED_PI = 3.14159


class StraightStrands(NamedTuple):
    """Both chains at n points; each array is (n, 2), left and right."""

    angle: Array  # [rad] of the straight line below the horizontal
    wrapped: Array  # [mm] on the sprocket, from 12 o'clock
    straight: Array  # [mm] from the tangent point to the bit
    across: Array  # [mm] horizontal part of the straight line
    drop: Array  # [mm] vertical part of the straight line


def chain_lengths(
    settings: MachineSettings, points: ArrayLike, *, controller: str | None = None
) -> Array:
    """Chain paid out from 12 o'clock, (n, 2) [mm] left and right, for targets (n, 2) [mm].

    Targets off the sheet are moved to its edge first, as the controllers do.
    """
    formulas: dict[str, Callable[[MachineSettings, StraightStrands], Array]] = {
        "stock": _stock,
        "holey": _holey,
    }
    whose = controller or settings.controller
    if whose not in formulas:
        raise ValueError(f"controller '{whose}' has no published formula; there are stock, holey")
    targets = np.asarray(points, dtype=float)
    if targets.ndim != 2 or targets.shape[1] != 2:
        raise ValueError(f"points must have the shape (n, 2), not {targets.shape}")
    _refuse_points(targets, ~np.isfinite(targets).all(axis=1), "is not a pair of finite numbers")
    with np.errstate(all="ignore"):
        strands = _strands(settings, clamped(settings, targets))
        lengths = formulas[whose](settings, strands)
    # Two chains hold a sled only where they pull upwards together.
    hangs = (np.sin(strands.angle.sum(axis=1)) > 0) & np.isfinite(lengths).all(axis=1)
    _refuse_points(targets, ~hangs, "is where the sled cannot hang on these two chains")
    return lengths


def clamped(settings: MachineSettings, points: Array) -> Array:
    """Return the points (n, 2) [mm], those off the sheet moved to its edge."""
    edge = np.array(settings.sheet) / 2
    return np.clip(points, -edge, edge)


def _refuse_points(points: Array, bad: NDArray[np.bool_], why: str) -> None:
    if bad.any():
        x, y = points[bad][0]
        raise ValueError(f"point ({x:g}, {y:g}) {why}")


def _strands(settings: MachineSettings, points: Array) -> StraightStrands:
    """Return the straight chains from their tangent points to the bit.

    angle = asin(below / distance) + asin(radius / distance) over the top, minus below it.
    """
    radius = settings.sprocket_radius
    motor_x = np.array([-settings.motor_gap / 2, settings.motor_gap / 2])
    below = (settings.motor_height - points[:, 1])[:, np.newaxis]
    distance = np.hypot(points[:, :1] - motor_x, below)
    lift = np.arcsin(radius / distance)
    over = settings.feed == "top"
    angle = np.arcsin(below / distance) + (lift if over else -lift)
    side = 1.0 if over else -1.0
    # From the tangent point, which lies inwards and above the axis, or outwards and below it.
    inwards = np.array([1.0, -1.0]) * (points[:, :1] - motor_x)
    return StraightStrands(
        angle=angle,
        wrapped=radius * (angle if over else PUBLISHED_PI - angle),
        straight=np.sqrt(distance**2 - radius**2),
        across=inwards - side * radius * np.sin(angle),
        drop=below + side * radius * np.cos(angle),
    )


def _stock(settings: MachineSettings, strands: StraightStrands) -> Array:
    """Return the published triangular formula: sag as a share of the straight part, then tolerance.

    sag share = correction * 1e-12 * cos(a)^2 * straight^2 * (tan(other) cos(a) + sin(a))^2
    """
    other = strands.angle[:, ::-1]
    cosine: Array = np.cos(strands.angle)
    pull = np.tan(other) * cosine + np.sin(strands.angle)
    sag = settings.published.chain_sag_correction * 1e-12
    hanging: Array = strands.straight * (1 + sag * (cosine * strands.straight * pull) ** 2)
    return strands.wrapped + hanging / _longer(settings) - settings.rotation_radius


def _holey(settings: MachineSettings, strands: StraightStrands) -> Array:
    """Return the catenary release: a catenary under the static tension, then tolerance and stretch.

    hanging^2 = (2 a sinh(across / (2 a)))^2 + drop^2 with a = horizontal tension / chain weight
    """
    catenary = settings.published.catenary
    if catenary is None:
        return _stock(settings, strands)
    sled_weight, elasticity = catenary
    weight: Array = sled_weight + HOLEY_CHAIN_WEIGHT / 2 * strands.straight.sum(
        axis=1, keepdims=True
    )
    cosine, sine = strands.across / strands.straight, strands.drop / strands.straight
    other = slice(None, None, -1)
    # Horizontal pulls are equal, vertical pulls carry the weight.
    tension = weight * cosine[:, other] / (sine * cosine[:, other] + cosine * sine[:, other])
    bend: Array = tension * cosine / HOLEY_CHAIN_WEIGHT
    hanging: Array = np.hypot(2 * bend * np.sinh(strands.across / (2 * bend)), strands.drop)
    stretched: Array = 1 + tension * elasticity
    return strands.wrapped + hanging / _longer(settings) / stretched - settings.rotation_radius


def _longer(settings: MachineSettings) -> Array:
    """Length of a nominal millimetre of either chain, (2,) [mm]."""
    published = settings.published
    percent: Array = np.array([published.left_tolerance, published.right_tolerance], dtype=float)
    return 1 + percent / 100


# How far the hanging sled gives way to a force along the sheet, such as friction.


def compliance(values: Array, *, over_top: bool, points: Array) -> Array:
    """Motion (n, 2 of place, 2 of force) [mm/N] with the chains held; zero where none can hang.

    A side force changes both tensions, so whatever answers to tension (sag and stretch above all)
    moves the sled. The core works it out from all effects of the values.
    """
    where = np.ascontiguousarray(points, dtype=float).reshape(-1, 2)
    # Friction does not ask how near the ring may come to a sprocket.
    return _core.reach(values, over_top, where, least_free=0.0)["compliance"]
