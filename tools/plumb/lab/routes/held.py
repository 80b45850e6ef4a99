"""Which numbers of the connected machine are not those of the open settings."""

from __future__ import annotations

from fastapi import APIRouter
from pydantic import BaseModel

from plumb.lab.choices import read_choices
from plumb.lab.held import held_otherwise, is_fit_of_machine
from plumb.lab.machine_line import TheLine
from plumb.lab.routes.project import TheProject

router = APIRouter(tags=["machine"])


class HeldNumber(BaseModel):
    """A number that the file and the machine say otherwise."""

    number: int
    name: str
    unit: str
    in_file: float
    in_machine: float


class HeldAnswer(BaseModel):
    """What the open file and the machine say otherwise; empty while they agree."""

    file: str
    numbers: list[HeldNumber]
    is_fit: bool  # the file was fitted to marks that the machine cut with what it holds
    is_written_here: bool  # the file's numbers can be written from here; a client sends others


@router.get("/machine/held")
def show_held(project: TheProject, line: TheLine) -> HeldAnswer:
    """Compare what the machine last listed with the open settings."""
    choices, _ = read_choices(project)
    return HeldAnswer(
        file=choices.settings,
        numbers=[HeldNumber(**vars(each)) for each in held_otherwise(project, line)],
        is_fit=is_fit_of_machine(project, line),
        is_written_here=choices.settings.endswith(".toml"),
    )
