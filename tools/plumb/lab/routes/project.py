"""The project: its files and choices, opening a file, saving a choice."""

from __future__ import annotations

from pathlib import Path
from tempfile import TemporaryDirectory
from typing import Annotated

from fastapi import APIRouter, Depends, Request, UploadFile
from pydantic import BaseModel

from plumb.fit.inputs import settings_in
from plumb.lab.choices import FILE, Choices, choices_text, read_choices, save_choices
from plumb.lab.project import Project, digest_of
from plumb.settings.machine import MachineSettings

router = APIRouter(tags=["project"])
# A settings' file gets a name of ours, whatever its owner calls it.
ENDINGS = {".ini": "groundcontrol.ini", ".json": "webcontrol.json", ".toml": "machine.toml"}


class Machine(BaseModel):
    """What the opened settings say of the machine. mm, N."""

    file: str
    controller: str
    sheet: tuple[float, float]  # width, height
    frame: dict[str, float]  # by name of the setting
    effects: dict[str, dict[str, float]]


class ProjectAnswer(BaseModel):
    """Everything that the page needs when it opens."""

    folder: str  # its name, for the title
    key: str  # of the folder: what a browser keeps for it goes by this
    files: dict[str, str]  # name: digest
    choices: Choices
    choices_digest: str
    machine: Machine | None
    trouble: str  # why the opened settings cannot be read; empty if they can


class ChoicesChange(BaseModel):
    """New choices, and the digest of those that they replace."""

    choices: Choices
    read: str


def project_of(request: Request) -> Project:
    """The project that this server serves."""
    project = request.app.state.project
    assert isinstance(project, Project)
    return project


TheProject = Annotated[Project, Depends(project_of)]


@router.get("/project")
def show(project: TheProject) -> ProjectAnswer:
    """The project as it is on disk now."""
    choices, digest = read_choices(project)
    machine, trouble = None, ""
    if choices.settings:
        try:
            machine = machine_of(settings_in(project.path(choices.settings)), choices.settings)
        except Exception as error:
            trouble = str(error)
    return ProjectAnswer(
        folder=project.folder.resolve().name,
        key=digest_of(bytes(project.folder.resolve()))[:16],
        files={name: project.digest(name) for name in project.names()},
        choices=choices,
        choices_digest=digest,
        machine=machine,
        trouble=trouble,
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
    with TemporaryDirectory() as scratch:
        copy = Path(scratch) / usual
        copy.write_bytes(content)
        settings_in(copy)
    name = project.place_for(content, usual.stem, usual.suffix)
    save_choices(
        project,
        lambda choices: choices.model_copy(update={"settings": name}),
        files={name: content},
        read={name: project.digest(name)},
    )
    return show(project)


def machine_of(settings: MachineSettings, file: str) -> Machine:
    """A machine as the page shows it."""
    return Machine(
        file=file,
        controller=settings.controller,
        sheet=settings.sheet,
        frame=dict(settings.frame),
        effects={name: dict(numbers) for name, numbers in settings.effects.items()},
    )
