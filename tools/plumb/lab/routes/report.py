"""The report, to keep."""

from fastapi import APIRouter
from fastapi.responses import Response

from plumb.cure.decision import decide
from plumb.diary.file import read_diary
from plumb.lab.report import report
from plumb.lab.rounds import board_words, command, inputs_of, known_words, unit_words
from plumb.lab.routes.project import TheProject
from plumb.plan import propose

router = APIRouter(tags=["report"])


@router.get("/report.html", response_class=Response)
def make_report(project: TheProject) -> Response:
    """Return the report as a file; nothing is written."""
    choices = project.choices
    words = [*board_words(project), *known_words(choices), *unit_words(choices)]

    def worded(name: str) -> str:
        return command(name, *words, *(["-o", "report.html"] if name == "report" else []))

    inputs = inputs_of(project)
    decision = decide(inputs)
    advice = propose(decision.diagnosis, inputs)
    content = report(inputs, decision, advice, diary=read_diary(project.folder), command=worded)
    headers = {"content-disposition": 'attachment; filename="report.html"'}
    return Response(content, media_type="text/html", headers=headers)
