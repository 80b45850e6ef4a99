"""Readings that disagree, asked for after each that is typed."""

from __future__ import annotations

from fastapi import APIRouter
from pydantic import BaseModel

from plumb.diagnosis.doubts import Doubted, doubted_readings
from plumb.fit.inputs import Inputs, settings_in
from plumb.lab.choices import read_choices
from plumb.lab.known import stated
from plumb.lab.known_numbers import refuse_absurd_known
from plumb.lab.routes.project import TheProject
from plumb.marks.form import read_form
from plumb.marks.plausible import from_edges
from plumb.model.predict import known_effects
from plumb.text.values import shown_in

router = APIRouter(tags=["doubts"])


class DoubtAnswer(BaseModel):
    """A reading to look at again."""

    index: int  # among the marks, or among the distances
    is_mark: bool
    off: float  # [mm]
    sentence: str
    corrected: list[float] | None  # [mm from the chosen edges] what was meant, if that is likely


class DoubtsAnswer(BaseModel):
    """All doubts about a form."""

    file: str
    digest: str  # of the form as it was read
    doubts: list[DoubtAnswer]


@router.get("/doubts")
def show_doubts(project: TheProject, file: str) -> DoubtsAnswer:
    """Which readings of a form no machine explains, by what is known of this machine."""
    choices, _ = read_choices(project)
    settings = settings_in(project.path(choices.settings))
    refuse_absurd_known(settings, choices)
    digest = project.digest(file)
    form = read_form(project.path(file), sheet=settings.sheet, known=known_effects())
    in_force = form.measurements.rounds[0].cut_with
    sheet = in_force.sheet if in_force else settings.sheet
    known = stated(choices)
    inputs = Inputs(
        settings,
        form.measurements,
        cut_with=in_force,
        priors=known.priors,
        checked=known.checked,
    )
    with shown_in(choices.units):
        doubts = doubted_readings(inputs)
    return DoubtsAnswer(
        file=file,
        digest=digest,
        doubts=[_answer(doubt, sheet, choices.edges) for doubt in doubts],
    )


def _answer(doubt: Doubted, sheet: tuple[float, float], corner: str) -> DoubtAnswer:
    corrected = list(doubt.corrected) if doubt.corrected else None
    if corrected and doubt.is_mark:
        corrected = list(from_edges((corrected[0], corrected[1]), sheet=sheet, corner=corner))
    return DoubtAnswer(
        index=doubt.index,
        is_mark=doubt.is_mark,
        off=doubt.off,
        sentence=doubt.sentence,
        corrected=corrected,
    )
