"""What lab effects and sketches share: parameters and words, as the firmware's effects have them
(lib/Kinematics/src/effect.h)."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from typing import ClassVar

from typing_extensions import TypedDict

# The words of an effect, as the firmware's library has them.


class PlainWords(TypedDict):
    """The size of a parameter in a maker's words."""

    more: str
    less: str
    unit: str
    times: float
    shown: str


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
