"""The project: its files and choices, opening a file, saving a choice."""

import os
from collections.abc import Callable, Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, replace
from pathlib import Path
from tempfile import mkstemp
from typing import Annotated, TypeVar

from fastapi import APIRouter, Depends, Request, UploadFile
from pydantic import BaseModel

from plumb.diagnosis.readings import Doubted, look_over
from plumb.fit.compare import compare
from plumb.fit.inputs import Inputs, settings_in
from plumb.lab.known import refuse_absurd_known, stated
from plumb.lab.project import (
    FILE,
    NAME,
    Choices,
    Project,
    choices_text,
    digest_of,
    read_choices,
    save_choices,
)
from plumb.lab.rounds import changed_since_fit, command, form_of, opened
from plumb.marks.read import from_edges
from plumb.settings import MachineSettings
from plumb.text.answers import like
from plumb.text.errors import InputError, on_page
from plumb.text.values import Unit
from plumb.vm.practice import SECRET, Score, score, secret_in
from plumb.words import Heading
from plumb.words import machine as words
from plumb.words.comparison import conclusion, without_doubted
from plumb.words.decision import what_is_stale
from plumb.words.round import look_again

router = APIRouter(tags=["project"])
# A settings' file gets a name of ours, whatever its owner calls it.
ENDINGS = {".ini": "groundcontrol.ini", ".json": "webcontrol.json", ".toml": "machine.toml"}


class Machine(BaseModel):
    """The machine of the opened settings. mm, N."""

    file: str
    sheet: tuple[float, float]  # width, height
    frame: dict[str, float]  # by name of the setting
    said: str  # what it is, in a sentence


class ProjectAnswer(BaseModel):
    """Everything that the page needs when it opens."""

    folder: str  # its name, for the title
    key: str  # of the folder: what a browser keeps for it goes by this
    files: dict[str, str]  # name: digest
    choices: Choices
    choices_digest: str
    machine: Machine | None
    trouble: str  # why the opened settings cannot be read; empty if they can
    heading: Heading  # of the screen on which a machine is opened
    lacks: tuple[str, str]  # before screens of a machine open, and of its readings; empty: nothing
    stale: Heading | None  # there are other readings than the opened settings were fitted to


class ChoicesChange(BaseModel):
    """New choices, and the digest of those that they replace."""

    choices: Choices
    read: str


Kept = TypeVar("Kept")


def of_lab(name: str, kind: type[Kept]) -> Callable[[Request], Kept]:
    """Return what finds a thing that the server keeps under this name."""

    def found(request: Request) -> Kept:
        thing = getattr(request.app.state, name)
        assert isinstance(thing, kind)
        return thing

    return found


TheProject = Annotated[Project, Depends(of_lab("project", Project))]


@router.get("/project")
def show(project: TheProject) -> ProjectAnswer:
    """Return the project as it is on disk now."""
    choices, digest = read_choices(project)
    machine, trouble, stale = None, "", None
    if choices.settings:
        try:
            settings = settings_in(project.path(choices.settings))
            machine = machine_of(settings, choices.settings, choices.unit)
            if changed := changed_since_fit(project, choices, settings):
                before = choices.settings_before[-1] if choices.settings_before else ""
                stale = what_is_stale(choices.settings, changed, before)
        except Exception as error:
            trouble = on_page(error)
    return ProjectAnswer(
        folder=project.folder.resolve().name,
        key=digest_of(bytes(project.folder.resolve()))[:16],
        files={name: project.digest(name) for name in project.names()},
        choices=choices,
        choices_digest=digest,
        machine=machine,
        trouble=trouble,
        heading=words.which(is_open=machine is not None),
        lacks=words.what_is_missing(is_open=machine is not None, is_read=bool(choices.marks)),
        stale=stale,
    )


@router.put("/choices")
def replace_choices(change: ChoicesChange, project: TheProject) -> ProjectAnswer:
    """Replace the choices, if they are still those that the page knows."""
    project.save({FILE: choices_text(change.choices)}, read={FILE: change.read})
    return show(project)


@router.post("/settings")
def open_settings(file: UploadFile, project: TheProject) -> ProjectAnswer:
    """Take a settings' file into the project, next to those that are there: marks and corrections
    go by them. A file that cannot be read changes nothing."""
    content = file.file.read()
    usual = Path(ENDINGS.get(Path(file.filename or "").suffix.lower(), "groundcontrol.ini"))
    with laid_down(project, file, usual.suffix) as copy:
        settings_in(copy)
    # Forms name the ini file that their marks were cut with.
    has_name = usual.suffix == ".ini" and NAME.fullmatch(file.filename or "")
    stem = Path(file.filename or "").stem if has_name else usual.stem
    name = project.place_for(content, stem, usual.suffix)
    save_choices(
        project,
        lambda choices: choices.model_copy(update={"settings": name}),
        files={name: content},
        read={name: project.digest(name)},
    )
    return show(project)


@contextmanager
def laid_down(project: Project, file: UploadFile, ending: str) -> Iterator[Path]:
    """Lay a picked file into the folder for a moment, next to those that it names;
    a refusal names it as its owner does.
    """
    file.file.seek(0)
    handle, name = mkstemp(dir=project.folder, prefix=".", suffix=ending)
    try:
        with os.fdopen(handle, "wb") as copy:  # shut at once: Windows reads no open one
            copy.write(file.file.read())
        yield project.folder / Path(name).name
    except InputError as error:
        said = on_page(error).replace(name, file.filename or f"the file{ending}")
        raise InputError(said.replace(f"{project.folder}{os.sep}", "")) from None
    finally:
        Path(name).unlink()


def machine_of(settings: MachineSettings, file: str, unit: Unit) -> Machine:
    """Return a machine as the page shows it."""
    return like(Machine, settings, file=file, said=words.size(settings, unit))


# Readings that disagree, asked for after each that is typed.


class DoubtsAnswer(BaseModel):
    """All doubts about a form."""

    file: str
    doubts: list[Doubted]  # corrected and expected: from the chosen edges
    compared: str  # how far off the marks are without these; empty: none is left


@router.get("/doubts")
def show_doubts(project: TheProject, file: str) -> DoubtsAnswer:
    """Return which readings of a form no machine explains, and what the others say of each mark, by
    what is known of this machine.
    """
    choices = project.choices
    settings = opened(project)
    refuse_absurd_known(settings, choices)
    form = form_of(project, choices, file)
    in_force = form.measurements.rounds[0].cut_with
    sheet = in_force.sheet if in_force else settings.sheet
    known = stated(choices)
    inputs = Inputs(
        settings,
        form.measurements,
        cut_with=in_force,
        priors=known.priors,
        checked=known.checked,
        unit=choices.unit,
    )
    doubts = look_over(inputs)
    return DoubtsAnswer(
        file=file,
        doubts=[_shown(doubt, sheet, choices) for doubt in doubts],
        compared=_compared(inputs, doubts),
    )


def _compared(inputs: Inputs, doubts: Sequence[Doubted]) -> str:
    """Return how far off the readings are that are not doubted."""
    off = {(each.is_mark, each.index) for each in doubts}
    every = inputs.measurements
    sure = replace(
        every,
        marks=tuple(
            replace(mark, measured=None) if (True, i) in off else mark
            for i, mark in enumerate(every.marks)
        ),
        distances=tuple(each for i, each in enumerate(every.distances) if (False, i) not in off),
    )
    if not sure.measured_marks and not sure.distances:
        return ""
    compared = compare(replace(inputs, measurements=sure))
    return (without_doubted if off else conclusion)(compared, inputs.unit)


def _shown(doubt: Doubted, sheet: tuple[float, float], choices: Choices) -> Doubted:
    """Return the doubt with its places as they are typed, and what the others say in words."""

    def typed(place: tuple[float, ...] | None) -> tuple[float, ...] | None:
        if place is None or not doubt.is_mark:
            return place
        return from_edges((place[0], place[1]), sheet=sheet, corner=choices.edges)

    expected, said = typed(doubt.expected), doubt.sentence
    if expected:
        said = look_again(said, expected, choices.edges, choices.unit)
    return replace(doubt, corrected=typed(doubt.corrected), expected=expected, sentence=said)


# Practice: what the folder's virtual machine hides, and what the opened settings are worth.


class PracticeAnswer(BaseModel):
    """What can be revealed in this folder."""

    nothing: str  # why nothing can; empty if a machine hides something
    command: str


@dataclass(frozen=True)
class Revealed(Score):
    """What was hidden, and the errors before and after in words."""

    fell: tuple[str, str]


@router.get("/practice")
def show_practice(project: TheProject) -> PracticeAnswer:
    """Return whether a virtual machine of this folder hides something."""
    if project.read(SECRET) is None:
        start = command("practice", "start", ".")
        return PracticeAnswer(nothing=words.NOTHING_HIDDEN, command=start)
    settings = [project.choices.settings] if project.choices.settings else []
    return PracticeAnswer(nothing="", command=command("practice", "reveal", ".", *settings))


@router.post("/practice/reveal")
def reveal(project: TheProject) -> Revealed:
    """Reveal the secret of the folder."""
    result, unit = score(secret_in(project.folder), opened(project)), project.choices.unit
    fell = unit.bare(result.before_mm), result.after(unit.worded)
    return Revealed(**vars(result), fell=fell)
