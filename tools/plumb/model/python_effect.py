"""What lab effects and sketches share: parameters and words, as the firmware's effects have them
(lib/Kinematics/src/effect.h)."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from typing import ClassVar, Literal

from typing_extensions import TypedDict

# The words of an effect, as the firmware's library has them.


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
    """What the owner reads off a rule or a scale for a parameter."""

    title: str
    unit: Unit
    usual: float
    factor: float
    digits: int
    zero: float
    curve: Curve


class ParameterWords(TypedDict):
    """What people read about a parameter of an effect."""

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
    """How an effect is measured directly."""

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
    """What people read about an effect."""

    name: str
    noun: str
    where: str
    summary: str
    pattern: str
    look_alikes: str
    remedy: str
    empirical: bool
    belongs_to: str
    in_frame: bool
    weight_power: int
    check: CheckWords | None
    examples: list[ExampleWords]
    parameters: list[ParameterWords]


@dataclass(frozen=True)
class Plain:
    """The size of a parameter in a maker's words: # in the words is the size with its unit."""

    more: str  # above zero
    less: str  # below zero; empty: the words above, and a minus
    unit: str
    times: float = 1.0  # the size shown is this times the parameter

    @property
    def words(self) -> PlainWords:
        """The words in the form of the firmware's library."""
        return {
            "more": self.more,
            "less": self.less,
            "unit": self.unit,
            "times": self.times,
            "shown": "as is",
        }


@dataclass(frozen=True)
class Reading:
    """What somebody reads off a rule or a scale for a number: factor * curve(reading - zero)."""

    title: str
    usual: float  # how far a careful reading may be off
    factor: float = 1.0
    unit: Unit = "mm"
    digits: int = 1
    zero: float = 0.0
    curve: Curve = "straight"
    by_sheet: Callable[[float, float], float] | None = None  # times this, of width and height [mm]

    def on(self, sheet: tuple[float, float]) -> Reading:
        """Return the same on a sheet [mm]."""
        if self.by_sheet is None:
            return self
        return replace(self, factor=self.factor * self.by_sheet(*sheet), by_sheet=None)

    def value(self, read: float) -> float:
        """Return the number that a reading says."""
        return self.factor * CURVES[self.curve][0](read - self.zero)

    def read(self, value: float) -> float:
        """Return what would be read for a number."""
        return self.zero + CURVES[self.curve][1](value / self.factor)


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


@dataclass(frozen=True)
class PythonParameter:
    """What people read about a parameter; zero always means absent."""

    name: str
    unit: str
    low: float  # physically plausible range
    high: float
    typical: float  # size met in real workshops
    summary: str
    sigma: float = 0.0  # accuracy of the direct check; 0: no check reads it
    plain: Plain | None = None  # None: its name has to do
    reading: Reading | None = None  # of the direct check

    @property
    def words(self) -> ParameterWords:
        """The parameter in the form of the firmware's library; no setting holds it."""
        return {
            "name": self.name,
            "setting": None,
            "unit": self.unit,
            "low": self.low,
            "high": self.high,
            "typical": self.typical,
            "summary": self.summary,
            "sigma": self.sigma,
            "plain": self.plain.words if self.plain else None,
            "reading": None,  # an effect of ours holds it as it is
            "published": None,
        }


@dataclass(frozen=True)
class DirectCheck:
    """How the owner measures an effect directly, without marks on a sheet."""

    title: str
    steps: str  # what to do, and how exactly
    value: str  # how the parameters follow from what was measured
    minutes: float

    @property
    def words(self) -> CheckWords:
        """The check in the form of the firmware's library."""
        return {
            "title": self.title,
            "steps": self.steps,
            "value": self.value,
            "minutes": self.minutes,
        }


@dataclass(frozen=True)
class Example:
    """A machine that suffers from the effect: the bench hides it."""

    label: str
    sizes: Mapping[str, float]  # by parameter
    most: float  # [mm] RMS of marks by it on the worst of real machines, roughly

    @property
    def words(self) -> ExampleWords:
        """The example in the form of the firmware's library."""
        return {"label": self.label, "sizes": dict(self.sizes), "most": self.most}


@dataclass(frozen=True, kw_only=True)
class PythonEffect:
    """One physical cause that no setting of the firmware holds.

    Two laws hold for each: with every parameter zero no bit of any place changes, and every
    parameter has a slope at zero.
    """

    where: ClassVar[str]  # "lab" or "sketch"

    name: str
    summary: str  # the cause, in a sentence
    pattern: str  # what it does to marks on the sheet
    look_alikes: str
    remedy: str  # how to tell it apart or cure it
    parameters: tuple[PythonParameter, ...]
    check: DirectCheck | None = None
    noun: str = ""  # the effect in a maker's words; empty: its name has to do
    examples: tuple[Example, ...] = ()

    @property
    def parameter_names(self) -> tuple[str, ...]:
        """The parameters as a fit names them: `effect.parameter`."""
        return tuple(f"{self.name}.{parameter.name}" for parameter in self.parameters)

    @property
    def words(self) -> EffectWords:
        """The effect in the form of the firmware's library, with its place."""
        return {
            "name": self.name,
            "noun": self.noun or self.name,
            "where": self.where,
            "summary": self.summary,
            "pattern": self.pattern,
            "look_alikes": self.look_alikes,
            "remedy": self.remedy,
            "empirical": False,
            "belongs_to": "machine",
            "in_frame": False,
            "weight_power": 0,
            "check": self.check.words if self.check else None,
            "examples": [example.words for example in self.examples],
            "parameters": [parameter.words for parameter in self.parameters],
        }
