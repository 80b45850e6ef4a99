"""What the owner can know of the machine without a mark: each number as it is measured by hand."""

from __future__ import annotations

from typing import Literal

from fastapi import APIRouter
from pydantic import BaseModel

from plumb.lab.choices import read_choices
from plumb.lab.commands import command, known_words, unit_words
from plumb.lab.routes.plan import opened
from plumb.lab.routes.project import TheProject
from plumb.plan.direct_checks import FRAME_CHECKS, effect_checks
from plumb.settings.machine import GRAVITY, MachineSettings

router = APIRouter(tags=["known"])
LINKS = 635.0  # [mm] of 100 links of a new chain


class KnownNumber(BaseModel):
    """A number that can be measured by hand: it is (what is read - zero) * scale."""

    name: str
    title: str
    steps: str
    unit: Literal["mm", "kg"]
    minutes: float
    zero: float
    scale: float
    believed: float  # what the settings say, as it would be read
    usual: float  # how far a careful reading may be off
    digits: int
    marked: str  # the distance on the drawing


class KnownAnswer(BaseModel):
    """Everything that the owner may know."""

    numbers: list[KnownNumber]
    command: str


@router.get("/known")
def show_known(project: TheProject) -> KnownAnswer:
    """What the owner may know, and the command that goes by what is known now."""
    settings = opened(project)
    choices, _ = read_choices(project)
    marks = choices.marks or ["marks.toml"]
    known = [*known_words(choices), *unit_words(choices)]
    return KnownAnswer(
        numbers=[*_frame(settings), *_chains(settings)],
        command=command("diagnose", choices.settings, *marks, *known),
    )


def _frame(settings: MachineSettings) -> list[KnownNumber]:
    """Numbers of the frame."""
    edge = settings.sheet_height / 2
    return [
        _of_frame("motor_gap", settings.motor_gap, zero=0.0),
        _of_frame("motor_height", settings.motor_height, zero=-edge),
        _of_frame("rotation_radius", settings.rotation_radius, zero=0.0),
        KnownNumber(
            name="sled_weight",
            title="the weight of the sled",
            steps="Weigh the sled with router and bricks, as it cuts, to 0.2 kg.",
            unit="kg",
            minutes=8.0,
            zero=0.0,
            scale=GRAVITY,
            believed=settings.sled_weight / GRAVITY,
            usual=0.2,
            digits=1,
            marked="sled_weight",
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
        believed=value + zero,
        usual=check.sigmas[name],
        digits=1,
        marked=name,
    )


def _chains(settings: MachineSettings) -> list[KnownNumber]:
    """The length of 100 links of each chain."""
    check = effect_checks()["chain_pitch"]
    return [
        KnownNumber(
            name=f"chain_pitch.{side}",
            title=f"100 links of the {side} chain",
            steps=check.direct.steps,
            unit="mm",
            minutes=check.direct.minutes / 2,
            zero=LINKS,
            scale=1 / LINKS,
            believed=LINKS * (1 + settings.effect("chain_pitch", side)),
            usual=round(LINKS * check.sigmas[side], 2),
            digits=1,
            marked="chain",
        )
        for side in ("left", "right")
    ]
