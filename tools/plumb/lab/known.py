"""What the owner knows of the machine, as the fit takes it: errors stated, numbers measured."""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

from pydantic import BaseModel

from plumb.diagnosis import Checked
from plumb.fit.expected import WIDE, is_absurd, plausible_range, refuse_absurd
from plumb.fit.problem import priors_with
from plumb.lab.project import Choices
from plumb.plan.separation import FRAME_CHECKS, effect_checks
from plumb.settings.machine import GRAVITY, MachineSettings
from plumb.text.errors import InputError
from plumb.text.values import shown_in, worded


@dataclass(frozen=True)
class Statements:
    """What the owner states."""

    priors: dict[str, float]
    checked: tuple[Checked, ...]


def stated(choices: Choices) -> Statements:
    """Return what the owner states, in the terms of the fit."""
    known = {name: number for name, number in choices.known.items() if number.sigma > 0}
    wide = [(name, WIDE[name]) for name in known if name in WIDE]
    checked = tuple(Checked(name, number.value, number.sigma) for name, number in known.items())
    return Statements(priors_with(wide), checked)


def possible(choices: Choices, settings: MachineSettings) -> Choices:
    """Return the choices without numbers that cannot have been measured on this machine."""
    absurd = {check.name for check in stated(choices).checked if is_absurd(check, settings)}
    known = {name: number for name, number in choices.known.items() if name not in absurd}
    return choices.model_copy(update={"known": known})


def planned_priors(choices: Choices) -> dict[str, float]:
    """Return how far numbers of the frame that a fit moves may be off, with what is known
    of them.
    """
    known = stated(choices)
    narrow = {
        check.name: 1 / math.hypot(1 / check.sigma, 1 / known.priors[check.name])
        for check in known.checked
        if check.name in known.priors
    }
    return {**known.priors, **narrow}


def measured_to(choices: Choices) -> dict[str, float]:
    """Return how far each number may be off that the owner measured."""
    return {name: number.sigma for name, number in choices.known.items() if number.sigma > 0}


# How the numbers of effects are measured by hand: what is read, and how the number follows.
#
# A number is scale * curve(reading - zero). The steps and the accuracies are those of plumb next.

Curve = Literal["straight", "square", "tangent squared"]  # of the tangent: degrees
Unit = Literal["mm", "kg", "g", "degrees"]

LINKS = 635.0  # [mm] of 100 links of a new chain
PULL = 50.0  # [N] at a motor arm
HUNG = 10 * GRAVITY  # [N] on a chain
CHAIN = 3000.0  # [mm] that is weighed, or stretched
METRE = 1000.0  # [mm]
GRAMS = 1000.0  # of a kilogram


@dataclass(frozen=True)
class Reading:
    """What somebody reads off a rule or a scale for a number of an effect."""

    title: str
    usual: float  # how far a careful reading may be off
    scale: float = 1.0
    unit: Unit = "mm"
    curve: Curve = "straight"
    zero: float = 0.0
    digits: int = 1
    marked: str = ""  # on the drawing

    def value(self, read: float) -> float:
        """Return the number that a reading says."""
        return self.scale * CURVES[self.curve][0](read - self.zero)

    def read(self, value: float) -> float:
        """Return what would be read for a number."""
        return self.zero + CURVES[self.curve][1](value / self.scale)


def readings(settings: MachineSettings, sled_weight: float) -> Mapping[str, Reading]:
    """Return the readings by the names of their numbers, for this sheet and this weight [N]."""
    return {**_of_chains(sled_weight), **_of_frame_and_sled(), **_of_sheet_and_tape(settings)}


def _of_chains(sled_weight: float) -> dict[str, Reading]:
    pitch = {
        f"chain_pitch.{side}": Reading(
            f"100 links of the {side} chain", 0.2, 1 / LINKS, zero=LINKS, marked="chain"
        )
        for side in ("left", "right")
    }
    zero = {
        f"chain_zero.{side}": Reading(
            f"how far the {side} chain is out at 12 o'clock", 1.0, marked="chain"
        )
        for side in ("left", "right")
    }
    per_gram = 1 / (GRAMS * CHAIN * sled_weight / GRAVITY)
    weighed = Reading("3 m of chain on a scale", 10.0, per_gram**2 / 24, "g", "square", digits=0)
    longer = Reading(
        "how much longer 3 m of chain become under 10 kg", 0.2, 1 / (CHAIN * HUNG), digits=2
    )
    return {
        **pitch,
        **zero,
        "chain_sag.weight_ratio_squared": weighed,
        "chain_stretch.compliance": longer,
    }


def _of_frame_and_sled() -> dict[str, Reading]:
    return {
        "motor_level.height_difference": Reading("how much higher the right motor is", 1.0),
        "frame_flex.inward": Reading(
            "how far a motor moves inwards under 50 N", 0.1, 1 / PULL, digits=2
        ),
        "frame_flex.downward": Reading(
            "how far a motor moves down under 50 N", 0.1, 1 / PULL, digits=2
        ),
        "chain_plane.gap_squared": Reading(
            "how much farther from the sheet the sprockets are than the ring", 3.0, curve="square"
        ),
        "frame_lean.tangent_squared": Reading(
            "how far the frame leans", 0.5, unit="degrees", curve="tangent squared"
        ),
        "sled_swing.right": Reading("how far the bit is right of the ring's centre", 0.3),
        "sled_swing.up": Reading("how far the bit is above the ring's centre", 0.3),
    }


def _of_sheet_and_tape(settings: MachineSettings) -> dict[str, Reading]:
    width, height = settings.sheet
    # Of two diagonals that differ by little: their squares differ by twice a diagonal times that.
    per_mm = math.hypot(width, height) / (2 * width * height)
    return {
        "sheet_skew.angle": Reading(
            "how much longer the diagonal from the top left corner is", 1.0, per_mm
        ),
        "tape_scale.strain": Reading(
            "how much too much the tape reads over a metre", 0.1, 1 / METRE, digits=2
        ),
    }


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


# The numbers that an owner can measure by hand, each as it is read, and whether it can be.

WEIGHT = "sled_weight"
WEIGHED = 0.2  # [kg] to which a sled is weighed
FIRST = ("chain_pitch",)  # effects that everybody measures


class KnownNumber(BaseModel):
    """A number that can be measured by hand: it is curve(what is read - zero) * scale."""

    name: str
    title: str
    steps: str
    unit: Unit
    minutes: float
    zero: float
    scale: float
    curve: Curve
    believed: float | None  # what the settings say, as it would be read; None: they leave it out
    usual: float  # how far a careful reading may be off
    digits: int
    marked: str  # the distance on the drawing; empty: none is
    by: str  # the number by whose square this is divided; empty: none is
    is_first: bool  # it belongs to what everybody measures
    refused: str = ""  # why what is stated cannot have been measured; empty if it can

    def read(self, value: float) -> float:
        """Return what is read for a value of the number."""
        return self.zero + CURVES[self.curve][1](value / self.scale)

    def said(self, value: float) -> str:
        """Return the same with its unit, a length in the unit in which lengths are shown."""
        read = self.read(value)
        if self.unit == "mm":
            return worded(read, self.digits)
        return f"{read:.{self.digits}f} {self.unit}"


def known_numbers(settings: MachineSettings, choices: Choices) -> list[KnownNumber]:
    """Return everything that can be measured by hand: first what everybody measures."""
    numbers = [*_frame(settings), *_effects(settings, choices)]
    lines = _refused(numbers, settings, choices)
    numbers = [each.model_copy(update={"refused": lines.get(each.name, "")}) for each in numbers]
    return sorted(numbers, key=lambda number: not number.is_first)


def refuse_absurd_known(settings: MachineSettings, choices: Choices) -> None:
    """Raise InputError for a stated number that cannot have been measured on such a machine."""
    for number in known_numbers(settings, choices):
        if number.refused:
            said = f"{number.title[0].upper()}{number.title[1:]}: {number.refused}"
            raise InputError(f'{said} You typed it under "What you know".')
    refuse_absurd(stated(choices).checked, settings)


def _refused(
    numbers: list[KnownNumber], settings: MachineSettings, choices: Choices
) -> dict[str, str]:
    """Why stated numbers cannot be, by name. What rests on such a number is not judged."""
    absurd = {check.name: check for check in stated(choices).checked if is_absurd(check, settings)}
    with shown_in(choices.units):
        return {
            number.name: _why(number, absurd[number.name].value)
            for number in numbers
            if number.name in absurd and number.by not in absurd
        }


def _why(number: KnownNumber, value: float) -> str:
    """Why a value of a number cannot be, as it is read."""
    said = number.said(value)
    if "." not in number.name:
        assert number.believed is not None
        believed = number.said((number.believed - number.zero) * number.scale)
        return f"{said} is far from the {believed} of the settings. Check the number and its unit."
    met = plausible_range(number.name)
    low, high = sorted((met.low, met.high), key=number.read)
    return (
        f"{said} cannot be: real machines have {number.said(low)} to {number.said(high)}. "
        "Check the number and its unit."
    )


def _frame(settings: MachineSettings) -> list[KnownNumber]:
    """Return numbers of the frame."""
    edge = settings.sheet_height / 2
    return [
        _of_frame("motor_gap", settings.motor_gap, zero=0.0),
        _of_frame("motor_height", settings.motor_height, zero=-edge),
        _of_frame("rotation_radius", settings.rotation_radius, zero=0.0),
        KnownNumber(
            name=WEIGHT,
            title="the weight of the sled",
            steps="Weigh the sled with router and bricks, as it cuts, to 0.2 kg.",
            unit="kg",
            minutes=8.0,
            zero=0.0,
            scale=GRAVITY,
            curve="straight",
            believed=settings.sled_weight / GRAVITY,
            usual=WEIGHED,
            digits=1,
            marked=WEIGHT,
            by="",
            is_first=True,
        ),
    ]


def _of_frame(name: str, value: float, *, zero: float) -> KnownNumber:
    check = FRAME_CHECKS[name]
    return KnownNumber(
        name=name,
        title=check.direct.title,
        steps=check.direct.steps,
        unit="mm",
        minutes=check.direct.minutes,
        zero=zero,
        scale=1.0,
        curve="straight",
        believed=value + zero,
        usual=check.sigmas[name],
        digits=1,
        marked=name,
        by="",
        is_first=True,
    )


def _effects(settings: MachineSettings, choices: Choices) -> list[KnownNumber]:
    """Return numbers of effects, as far as they can be measured directly and the page has words for
    it.
    """
    stated = choices.known.get(WEIGHT)
    by_hand = readings(settings, stated.value if stated else settings.sled_weight)
    return [
        _of_effect(f"{effect}.{part}", by_hand[f"{effect}.{part}"], settings)
        for effect, check in effect_checks().items()
        for part in check.sigmas
        if f"{effect}.{part}" in by_hand
    ]


def _of_effect(name: str, reading: Reading, settings: MachineSettings) -> KnownNumber:
    effect, _, part = name.partition(".")
    check = effect_checks()[effect]
    value, is_first = settings.effect(effect, part), effect in FIRST
    return KnownNumber(
        name=name,
        title=reading.title,
        steps=check.direct.steps,
        unit=reading.unit,
        minutes=check.direct.minutes / len(check.sigmas),
        zero=reading.zero,
        scale=reading.scale,
        curve=reading.curve,
        believed=reading.read(value) if value or is_first else None,
        usual=reading.usual,
        digits=reading.digits,
        marked=reading.marked,
        by=WEIGHT if reading.unit == "g" else "",
        is_first=is_first,
    )
