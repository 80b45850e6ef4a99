"""How far the marks lie from where the opened settings predict them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from pathlib import Path

from fastapi import APIRouter
from pydantic import BaseModel

from plumb import api
from plumb.fit.inputs import settings_in
from plumb.lab.known import refuse_absurd_known, stated
from plumb.lab.project import Choices, Project, read_choices
from plumb.lab.rounds import command, unit_words
from plumb.lab.routes.project import TheProject
from plumb.marks.form import read_form
from plumb.model.predict import known_effects
from plumb.text.errors import InputError

router = APIRouter(tags=["comparison"])


class MarkError(BaseModel):
    """A mark [mm, machine frame: origin in the middle of the sheet, y up]."""

    name: str
    target: tuple[float, float]
    predicted: tuple[float, float]
    measured: tuple[float, float]
    left_chain: float | None
    right_chain: float | None


class ComparisonAnswer(BaseModel):
    """The marks against the settings [mm]."""

    rms: float
    worst: float
    shape_rms: float | None
    marks: list[MarkError]
    warnings: list[str]
    command: str  # the same in a terminal


@router.get("/comparison")
def compare(project: TheProject) -> ComparisonAnswer:
    """Compare the opened settings with the marks."""
    inputs = inputs_of(project)
    comparison = api.compare(inputs)
    choices, _ = read_choices(project)
    unit = unit_words(choices, inputs.measurements.typed.unit)
    return ComparisonAnswer(
        rms=comparison.rms,
        worst=comparison.worst,
        shape_rms=comparison.shape_rms,
        marks=[
            MarkError(
                name=mark.name,
                target=mark.target,
                predicted=mark.predicted,
                measured=mark.measured,
                left_chain=mark.left_chain_residual,
                right_chain=mark.right_chain_residual,
            )
            for mark in comparison.marks
        ],
        warnings=list(comparison.warnings),
        command=command("compare", *board_words(project), *unit),
    )


def inputs_of(project: Project, *, among: Sequence[str] | None = None) -> api.Inputs:
    """Return the opened settings with all readings, or with those in files of these names.

    Raises InputError if something is missing, or cannot have been measured.
    """
    choices, _ = read_choices(project)
    if not choices.settings:
        raise InputError("no settings are open; open the settings of the machine first")
    if not choices.marks:
        raise InputError("there are no readings yet; type in what you measured first")
    settings = project.path(choices.settings)
    names = read_names(project, choices.marks if among is None else among, choices)
    marks = [project.path(name) for name in names]
    if not marks:
        raise InputError("there are no readings yet; type in what you measured first")
    inputs = api.read(settings, *marks)
    refuse_absurd_known(inputs.settings, choices)
    known = stated(choices)
    return replace(inputs, priors=known.priors, checked=known.checked)


def board_words(project: Project) -> list[str]:
    """Return the opened settings and the files that have readings, as a command names them."""
    choices, _ = read_choices(project)
    return [choices.settings, *read_names(project, choices.marks, choices)]


def read_names(project: Project, among: Sequence[str], choices: Choices) -> list[str]:
    """Return those of these files of marks that have readings."""
    settings = project.path(choices.settings)
    return [name for name in among if _has_readings(project.path(name), settings)]


def _has_readings(path: Path, settings: Path) -> bool:
    """Return whether any mark of a form is read; other files have nothing else."""
    if path.suffix != ".toml":
        return True
    sheet = settings_in(settings).sheet
    measurements = read_form(path, sheet=sheet, known=known_effects()).measurements
    return bool(measurements.measured_marks or measurements.distances)
