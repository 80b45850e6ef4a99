"""What the owner can know of the machine without a mark: each number as it is measured by hand."""

from __future__ import annotations

from fastapi import APIRouter
from pydantic import BaseModel

from plumb.lab.by_hand import Curve, Reading, Unit, readings
from plumb.lab.choices import Choices, Number, read_choices
from plumb.lab.commands import command, known_words, unit_words
from plumb.lab.machine_line import TheLine
from plumb.lab.routes.plan import opened
from plumb.lab.routes.project import TheProject
from plumb.plan.ahead import Check
from plumb.plan.direct_checks import FRAME_CHECKS, effect_checks
from plumb.settings.machine import GRAVITY, MachineSettings
from plumb.text.errors import InputError
from plumb.text.values import refuse_unknown

router = APIRouter(tags=["known"])
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


class KnownAnswer(BaseModel):
    """Everything that the owner may know."""

    numbers: list[KnownNumber]
    command: str


class Measuring(BaseModel):
    """The number that somebody measures."""

    name: str


@router.get("/known")
def show_known(project: TheProject) -> KnownAnswer:
    """What the owner may know, and the command that goes by what is known now."""
    settings = opened(project)
    choices, _ = read_choices(project)
    marks = choices.marks or ["marks.toml"]
    known = [*known_words(choices), *unit_words(choices)]
    numbers = [*_frame(settings), *_effects(settings, choices)]
    return KnownAnswer(
        numbers=sorted(numbers, key=lambda number: not number.is_first),
        command=command("diagnose", choices.settings, *marks, *known),
    )


@router.post("/known/measured")
def measure(measuring: Measuring, project: TheProject, line: TheLine) -> Number:
    """Let the owner of the virtual machine measure a number of it, as well as a careful reading."""
    owner = line.virtual
    if owner is None:
        raise InputError("a virtual machine alone is measured by the lab: type what you measured")
    sigmas = {
        f"{effect}.{part}": sigma
        for effect, check in effect_checks().items()
        for part, sigma in check.sigmas.items()
    }
    for check in FRAME_CHECKS.values():
        sigmas |= check.sigmas
    sigmas[WEIGHT] = WEIGHED * GRAVITY
    refuse_unknown([measuring.name], sigmas)
    (checked,) = owner.check([Check(measuring.name, sigmas[measuring.name])])
    return Number(value=checked.value, sigma=checked.sigma)


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
