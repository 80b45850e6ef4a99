"""The files of a round of marks, form and program, numbered; readings are never replaced."""

from __future__ import annotations

from pathlib import PurePath

from plumb.grid.cut_with import digest_of
from plumb.lab.choices import Choices
from plumb.lab.commands import command
from plumb.lab.planned import Planned
from plumb.lab.project import Project
from plumb.marks.form import read_form
from plumb.model.predict import known_effects
from plumb.text.errors import InputError
from plumb.text.files import is_ours

FORM, PROGRAM = "marks{}.toml", "grid{}.nc"


def on_new_sheet(choices: Choices) -> bool:
    """Whether the next round is cut on another sheet; the first is on no other."""
    return choices.new_sheet and bool(choices.marks)


def form_text(project: Project, choices: Choices, plan: Planned, form: str) -> bytes:
    """The form of the next round: a file of this name in the folder."""
    settings, path = str(project.path(choices.settings)), str(project.path(form))
    return plan.form(path, settings=settings, new_sheet=on_new_sheet(choices)).encode()


def kept_settings(project: Project, choices: Choices) -> dict[str, bytes]:
    """The open settings as a file that nobody replaces, by the digest that a form names."""
    name = choices.settings
    content = project.read(name)
    if content is None:
        return {}
    digest = digest_of(project.path(name))[:16]
    return {f".settings-{digest}{PurePath(name).suffix.lower()}": content}


def grid_command(
    project: Project, choices: Choices, plan: Planned, *, form: str, program: str
) -> str:
    """The command that writes a form and its program as the lab does."""
    sheet = ["--new-sheet"] * on_new_sheet(choices)
    force = ["--force"] * (project.read(form) is not None)  # the lab replaces it too
    files = ["--marks", form, "--output", program]
    return command("grid", "--settings", choices.settings, *plan.words(), *sheet, *files, *force)


def next_number(project: Project) -> str:
    """What the next round has in the names of its files: nothing, or -2, -3 ..."""
    number, count = "", 1
    while has_readings(project, FORM.format(number)) or _is_foreign(project, number):
        count += 1
        number = f"-{count}"
    return number


def _is_foreign(project: Project, number: str) -> bool:
    """Whether the program of a round would replace one that the lab did not write."""
    name = PROGRAM.format(number)
    return project.read(name) is not None and not is_ours(project.path(name))


def has_readings(project: Project, name: str) -> bool:
    """Whether a form has any reading, or is no form at all."""
    if project.read(name) is None:
        return False
    try:
        form = read_form(project.path(name), sheet=(0.0, 0.0), known=known_effects())
    except InputError:
        return True  # whatever it is, somebody wrote it
    return bool(form.measurements.measured_marks or form.measurements.distances)
