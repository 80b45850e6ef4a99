"""Files to take along: a report, and a sheet to print."""

from collections.abc import Callable, Mapping
from typing import Literal

from fastapi import APIRouter
from fastapi.responses import Response

from plumb.cure.decision import decide
from plumb.diary.file import read_diary
from plumb.lab.project import Project
from plumb.lab.report import report
from plumb.lab.rounds import (
    board_words,
    chosen_round,
    command,
    inputs_of,
    known_words,
    opened,
    planned,
    unit_words,
)
from plumb.lab.routes.project import TheProject
from plumb.pictures.grid_paper import grid_paper
from plumb.plan import propose

router = APIRouter(tags=["papers"])
Paper = Literal["report.html", "marks.pdf"]


@router.get("/papers/{name}", response_class=Response)
def take_along(name: Paper, project: TheProject) -> Response:
    """Return a file to keep or to print; nothing is written."""
    kind, made = _PAPERS[name]
    content = made(project)
    headers = {"content-disposition": f'attachment; filename="{name}"'}
    return Response(content, media_type=kind, headers=headers)


def _report(project: Project) -> bytes:
    board, known = board_words(project), known_words(project.choices)

    def worded(name: str) -> str:
        output = ["-o", "report.html"] if name == "report" else []
        return command(name, *board, *known, *unit_words(project.choices), *output)

    inputs = inputs_of(project)
    decision = decide(inputs)
    advice = propose(decision.diagnosis, inputs)
    return report(inputs, decision, advice, diary=read_diary(project.folder), command=worded)


def _paper(project: Project) -> bytes:
    choices, settings = project.choices, opened(project)
    marks, plan = chosen_round(project), planned(settings, choices.layout, choices.planned)
    if marks.origin == "proposed":
        plan = planned(settings, "own", [mark.target for mark in marks.marks])
    return grid_paper(
        plan.grid, plan.machine, choices.unit, settings=choices.settings, form=marks.form
    )


_PAPERS: Mapping[str, tuple[str, Callable[[Project], bytes]]] = {
    "report.html": ("text/html", _report),
    "marks.pdf": ("application/pdf", _paper),
}
