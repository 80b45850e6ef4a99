"""Numbers that an owner can measure by hand, without a mark."""

from typing import Annotated

from fastapi import APIRouter, Body
from pydantic import BaseModel, FiniteFloat, PositiveFloat

from plumb.lab.known import KnownNumber, known_numbers, number_checks, with_known
from plumb.lab.machine_line import TheLine, held_otherwise, is_fit_of_machine
from plumb.lab.project import Number, save_choices
from plumb.lab.rounds import command, known_words, opened, unit_words
from plumb.lab.routes.project import ProjectAnswer, TheProject, show
from plumb.plan.case import PlannedCheck
from plumb.text.errors import InputError
from plumb.text.values import refuse_unknown
from plumb.words import Heading
from plumb.words import machine as words

router = APIRouter(tags=["known"])


class KnownAnswer(BaseModel):
    """Everything that the owner may know."""

    numbers: list[KnownNumber]
    command: str


@router.get("/known")
def show_known(project: TheProject) -> KnownAnswer:
    """Return what the owner may know, and the command that goes by what is known now."""
    settings = opened(project)
    choices = project.choices
    marks = choices.marks or ["marks.toml"]
    known = [*known_words(choices), *unit_words(choices)]
    return KnownAnswer(
        numbers=known_numbers(settings, choices),
        command=command("diagnose", choices.settings, *marks, *known),
    )


class KnownReading(BaseModel):
    """What somebody read for a number; None: it is not known any more."""

    name: str
    read: FiniteFloat | None
    within: PositiveFloat  # how far that may be off


@router.post("/known")
def keep_known(reading: KnownReading, project: TheProject) -> ProjectAnswer:
    """Keep what is known of a number, or forget it."""
    settings, stated = opened(project), None
    numbers = {each.name: each for each in known_numbers(settings, project.choices)}
    refuse_unknown([reading.name], numbers)
    if reading.read is not None:
        number = numbers[reading.name]
        sigma = number.value_within(reading.read, reading.within)
        stated = Number(value=number.value(reading.read), sigma=sigma)
    save_choices(project, lambda now: with_known(now, settings, reading.name, stated))
    return show(project)


@router.post("/known/measured")
def measure(
    name: Annotated[str, Body(embed=True)], project: TheProject, line: TheLine
) -> ProjectAnswer:
    """Let the owner of the virtual machine measure a number of it, as well as a careful reading."""
    owner = line.virtual
    if owner is None:
        raise InputError("a virtual machine alone is measured by the lab: type what you measured")
    checks = number_checks()
    refuse_unknown([name], checks)
    sigma = checks[name].sigmas[name.rpartition(".")[2]]
    (checked,) = owner.check([PlannedCheck(name, sigma)])
    stated = Number(value=checked.value, sigma=checked.sigma)
    save_choices(project, lambda now: with_known(now, opened(project), name, stated))
    return show(project)


# Which numbers of the connected machine are not those of the open settings.


class HeldAnswer(BaseModel):
    """Differences between the open file and the machine; empty while they agree."""

    file: str
    headline: str
    alike: Heading | None  # None while they differ
    said: list[tuple[str, str, str]]  # each with its name, in the file and in the machine
    is_fit: bool  # the file was fitted to marks that the machine cut with what it holds
    is_written_here: bool  # the file's numbers can be written from here; a client sends others


@router.get("/machine/held")
def show_held(project: TheProject, line: TheLine) -> HeldAnswer:
    """Compare what the machine last listed with the open settings."""
    file, is_fit = project.choices.settings, is_fit_of_machine(project, line)
    said = [number.said for number in held_otherwise(project, line)]
    return HeldAnswer(
        file=file,
        headline=words.held_otherwise(line.subject, file, is_fit=is_fit),
        alike=None if said else words.held_alike(file),
        said=said,
        is_fit=is_fit,
        is_written_here=file.endswith(".toml"),
    )
