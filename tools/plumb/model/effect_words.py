"""The words of an effect, as the firmware's library has them (lib/Kinematics/src/effect.h)."""

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

from typing_extensions import TypedDict


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
