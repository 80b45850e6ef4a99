"""A proposal that somebody took into the folder: its form, and the program that cuts it."""

from __future__ import annotations

import re
from dataclasses import dataclass
from pathlib import PurePath

from plumb.fit.inputs import settings_in
from plumb.lab.choices import Choices
from plumb.lab.project import Project
from plumb.lab.rounds import has_readings
from plumb.line.progress import Wait, waits_in
from plumb.marks.form import read_form
from plumb.marks.model import Mark
from plumb.model.predict import known_effects
from plumb.settings.machine import MachineSettings

STEM = "more"  # as plumb next calls them
FORM = re.compile(rf"{STEM}(-\d+)?\.toml")


@dataclass(frozen=True)
class Taken:
    """Marks that are to be cut because the verdict proposed them."""

    form: str
    program: str
    text: str  # the G-code
    marks: tuple[Mark, ...]  # in the order in which they are cut
    cut_with: MachineSettings | None = None  # that the form names

    @property
    def waits(self) -> tuple[Wait, ...]:
        """The pauses of the program."""
        return tuple(waits_in(self.text.splitlines()))

    @property
    def swaps_chains(self) -> bool:
        """Whether it has chains on each other's sprockets."""
        return any(mark.chains_swapped for mark in self.marks)


def program_name(form: str) -> str:
    """The file of the program whose marks a form waits for."""
    return f"{PurePath(form).stem}.nc"


def is_read_again(project: Project, form: str) -> bool:
    """Whether the marks of a form are on the sheet already: somebody took it, nothing cuts it."""
    return bool(FORM.fullmatch(form)) and project.read(program_name(form)) is None


def taken_marks(project: Project, choices: Choices) -> Taken | None:
    """What was taken and is to be cut; None once it has readings, and where nothing is cut."""
    form = choices.proposed
    if not FORM.fullmatch(form) or project.read(form) is None or has_readings(project, form):
        return None
    text = project.read(program_name(form))
    if text is None:
        return None
    sheet = settings_in(project.path(choices.settings)).sheet if choices.settings else (0.0, 0.0)
    measured = read_form(project.path(form), sheet=sheet, known=known_effects()).measurements
    cut_with = measured.rounds[0].cut_with
    return Taken(form, program_name(form), text.decode(), measured.marks, cut_with)
