"""The numbers that an owner can measure by hand, each as it is read, and whether it can be."""

from __future__ import annotations

from pydantic import BaseModel

from plumb.fit.expected import is_absurd, plausible_range, refuse_absurd
from plumb.lab.by_hand import CURVES, Curve, Reading, Unit, readings
from plumb.lab.choices import Choices
from plumb.lab.known import stated
from plumb.plan.separation import FRAME_CHECKS, effect_checks
from plumb.settings.machine import GRAVITY, MachineSettings
from plumb.text.errors import InputError
from plumb.text.values import shown_in, worded

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
        """What is read for a value of the number."""
        return self.zero + CURVES[self.curve][1](value / self.scale)

    def said(self, value: float) -> str:
        """The same with its unit, a length in the unit in which lengths are shown."""
        read = self.read(value)
        if self.unit == "mm":
            return worded(read, self.digits)
        return f"{read:.{self.digits}f} {self.unit}"


def known_numbers(settings: MachineSettings, choices: Choices) -> list[KnownNumber]:
    """Everything that can be measured by hand: first what everybody measures."""
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
    """Numbers of the frame."""
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
    """Numbers of effects, as far as they can be measured directly and the page has words for it."""
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
