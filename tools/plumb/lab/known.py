"""Knowledge of the owner, as the fit takes it: errors stated, numbers measured."""

import math
from dataclasses import dataclass, replace
from typing import Literal, cast

from pydantic import ConfigDict

from plumb.diagnosis import Checked
from plumb.fit.compare import WIDE, is_absurd, plausible_range, refuse_absurd
from plumb.fit.fit import priors_with
from plumb.fit.inputs import WEIGHED, WEIGHT, readings
from plumb.lab.project import Choices, Number
from plumb.model.predict import RuleReading
from plumb.plan.proposal import FRAME_CHECKS, NumberCheck, effect_checks
from plumb.settings import GRAVITY, MachineSettings
from plumb.text.errors import InputError
from plumb.text.values import Unit


@dataclass(frozen=True)
class Statements:
    """Statements of the owner."""

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
    absurd = _absurd(choices, settings)
    known = {name: number for name, number in choices.known.items() if name not in absurd}
    return choices.model_copy(update={"known": known})


def _absurd(choices: Choices, settings: MachineSettings) -> dict[str, Checked]:
    return {check.name: check for check in stated(choices).checked if is_absurd(check, settings)}


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


# The numbers that an owner can measure by hand, each as it is read, and whether it can be.

FIRST = ("chain_pitch",)  # effects that everybody measures
Marked = Literal["", "motor_gap", "motor_height", "rotation_radius", "sled_weight", "chain"]
ON_DRAWING = ("chain_pitch", "chain_zero")  # effects that mark the chain there


@dataclass(frozen=True, kw_only=True)
class KnownNumber(RuleReading):
    """A number that can be measured by hand."""

    __pydantic_config__ = ConfigDict(json_schema_serialization_defaults_required=True)

    name: str
    steps: str
    minutes: float
    believed: float | None  # what the settings say, as it would be read; None: they leave it out
    believed_said: str = ""
    marked: Marked  # the distance on the drawing; empty: none is
    by: str  # the number by whose square this is divided; empty: none is
    is_first: bool  # it belongs to what everybody measures
    stated: tuple[float, float] | None  # as it was read, and how far that may be off
    refused: str = ""  # why what is stated cannot have been measured; empty if it can

    def said(self, value: float, unit: Unit) -> str:
        """Return what is read for a value, a length in this unit."""
        read = self.read(value)
        if self.unit == "mm":
            return unit.worded(read, self.digits)
        return f"{read:.{self.digits}f} {self.unit}"


def known_numbers(settings: MachineSettings, choices: Choices) -> list[KnownNumber]:
    """Return everything that can be measured by hand: first what everybody measures."""
    weight = choices.known.get(WEIGHT)
    by_hand = readings(settings, weight.value if weight else settings.sled_weight)
    checks = number_checks()
    numbers = [
        _number(name, checks[name], by_hand[name], settings, choices.known.get(name))
        for name in checks
    ]
    numbers = [replace(each, believed_said=_believed(each, choices.unit)) for each in numbers]
    # What rests on an absurd number is not judged.
    absurd = _absurd(choices, settings)
    numbers = [
        replace(each, refused=_why(each, absurd[each.name].value, choices.unit))
        if each.name in absurd and each.by not in absurd
        else each
        for each in numbers
    ]
    return sorted(numbers, key=lambda number: not number.is_first)


def with_known(
    choices: Choices, settings: MachineSettings, name: str, stated: Number | None
) -> Choices:
    """Return the choices with a number as it is stated, or without it. What was divided by the
    square of the old is divided by that of the new.
    """
    numbers = {each.name: each for each in known_numbers(settings, choices)}
    known = {each: was for each, was in choices.known.items() if each != name}
    number, before = numbers[name], choices.known.get(name)
    usual = number.value(number.believed) if number.believed else 0.0
    old, new = (each.value if each else usual for each in (before, stated))
    by_it = {each.name for each in numbers.values() if each.by == name}
    if old and new:
        for other in known.keys() & by_it:
            was, share = known[other], (old / new) ** 2
            known[other] = Number(value=was.value * share, sigma=was.sigma * share)
    if stated:
        known[name] = stated
    return choices.model_copy(update={"known": known})


def number_checks() -> dict[str, NumberCheck]:
    """Return how each number is measured, by its full name."""
    of_effects = {
        f"{effect}.{part}": check
        for effect, check in effect_checks().items()
        for part in check.sigmas
    }
    return {**FRAME_CHECKS, WEIGHT: WEIGHING, **of_effects}


def refuse_absurd_known(settings: MachineSettings, choices: Choices) -> None:
    """Raise InputError for a stated number that cannot have been measured on such a machine."""
    for number in known_numbers(settings, choices):
        if number.refused:
            said = f"{number.title[0].upper()}{number.title[1:]}: {number.refused}"
            raise InputError(f'{said} You typed it under "What you know".')
    refuse_absurd(stated(choices).checked, settings)


def _believed(number: KnownNumber, unit: Unit) -> str:
    if number.believed is None:
        return "the settings leave it out"
    return f"the settings say {number.said(number.value(number.believed), unit)}"


def _why(number: KnownNumber, value: float, unit: Unit) -> str:
    """Why a value of a number cannot be, as it is read."""
    said = number.said(value, unit)
    if "." not in number.name:
        assert number.believed is not None
        believed = number.said(number.value(number.believed), unit)
        return f"{said} is far from the {believed} of the settings. Check the number and its unit."
    met = plausible_range(number.name)
    low, high = sorted((met.low, met.high), key=number.read)
    return (
        f"{said} cannot be: real machines have {number.said(low, unit)} to "
        f"{number.said(high, unit)}. Check the number and its unit."
    )


WEIGHING = NumberCheck(
    "the weight of the sled",
    "Weigh the sled with router and bricks, as it cuts, to 0.2 kg.",
    "kg",
    8.0,
    {WEIGHT: WEIGHED * GRAVITY},
)


def _number(
    name: str,
    check: NumberCheck,
    reading: RuleReading,
    settings: MachineSettings,
    stated: Number | None,
) -> KnownNumber:
    effect, _, part = name.rpartition(".")
    value = settings.effect(effect, part) if effect else settings.frame[part]
    is_first = not effect or effect in FIRST
    title = reading.title if effect else check.title
    return KnownNumber(
        **{**vars(reading), "title": title},
        name=name,
        steps=check.steps,
        minutes=check.minutes / len(check.sigmas),
        believed=reading.read(value) if value or is_first else None,
        marked=("chain" if effect in ON_DRAWING else "") if effect else cast(Marked, name),
        by=WEIGHT if reading.unit == "g" else "",
        is_first=is_first,
        stated=(
            (reading.read(stated.value), reading.read_within(stated.value, stated.sigma))
            if stated
            else None
        ),
    )
