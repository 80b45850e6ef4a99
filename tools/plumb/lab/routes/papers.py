"""Files to take along: a report, a sheet to print, the readings as a table, the folder."""

import io
import zipfile
from collections.abc import Callable, Mapping
from typing import Literal

from fastapi import APIRouter
from fastapi.responses import Response

from plumb.diary.file import read_diary
from plumb.lab.project import Project
from plumb.lab.report import find, report
from plumb.lab.rounds import (
    board_words,
    command,
    inputs_of,
    known_words,
    next_names,
    opened,
    planned,
    taken_marks,
    unit_words,
)
from plumb.lab.routes.project import TheProject
from plumb.marks.csv import marks_csv
from plumb.pictures.grid_paper import grid_paper
from plumb.text.errors import InputError

router = APIRouter(tags=["papers"])
Paper = Literal["report.html", "marks.pdf", "readings.csv", "folder.zip"]
MOST = 200_000_000  # bytes of a folder that is packed
LONG_AGO = (1980, 1, 1, 0, 0, 0)  # so that equal folders make equal archives


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

    return report(find(inputs_of(project)), diary=read_diary(project.folder), command=worded)


def _paper(project: Project) -> bytes:
    choices, settings = project.choices, opened(project)
    taken = taken_marks(project, choices)
    if taken:
        form, plan = taken.form, planned(settings, "own", [mark.target for mark in taken.marks])
    else:
        form, _ = next_names(project)
        plan = planned(settings, choices.layout, choices.planned)
    return grid_paper(plan.grid, plan.machine, settings=choices.settings, form=form)


def _readings(project: Project) -> bytes:
    measurements = inputs_of(project).measurements
    if not measurements.measured_marks:
        raise InputError("no place of a mark is read; a table has the places, not the distances")
    return marks_csv(measurements).encode()


def _folder(project: Project) -> bytes:
    names = project.names()
    if sum(project.path(name).stat().st_size for name in names) > MOST:
        raise InputError(f"the folder is larger than {MOST // 1_000_000} MB; copy it by hand")
    packed = io.BytesIO()
    with zipfile.ZipFile(packed, "w") as archive:
        for name in names:
            file = zipfile.ZipInfo(name, LONG_AGO)
            file.compress_type = zipfile.ZIP_DEFLATED
            archive.writestr(file, project.read(name) or b"")
    return packed.getvalue()


_PAPERS: Mapping[str, tuple[str, Callable[[Project], bytes]]] = {
    "report.html": ("text/html", _report),
    "marks.pdf": ("application/pdf", _paper),
    "readings.csv": ("text/csv", _readings),
    "folder.zip": ("application/zip", _folder),
}
