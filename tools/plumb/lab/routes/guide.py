"""A machine's first day on the page, step by step; the folder keeps how far."""

from typing import Annotated

from fastapi import APIRouter, Body, Depends
from pydantic import BaseModel

from plumb.firmware.settings import machine_of_numbers
from plumb.fit.inputs import settings_in
from plumb.guide.steps import SETTINGS, STEPS, GuideVisit, open_step
from plumb.guide.talk import Question, progress_in
from plumb.lab.guide_desk import GuideDesk
from plumb.lab.machine_line import MachineLine, TheLine
from plumb.lab.project import Choices, Number, Project, save_choices
from plumb.lab.routes.project import TheProject, of_lab
from plumb.text.errors import InputError
from plumb.text.values import refuse_unknown

router = APIRouter(tags=["guide"])


class GuideStep(BaseModel):
    """A step, and whether it is done."""

    name: str
    title: str
    done: bool


class GuideAnswer(BaseModel):
    """The progress of the guide."""

    steps: list[GuideStep]
    open: str  # the first step that is not done; empty if all are
    here: str  # the step that is under way; empty if none is
    said: list[str]
    question: Question | None
    trouble: str


Desk = Annotated[GuideDesk, Depends(of_lab("guide_desk", GuideDesk))]


@router.get("/guide")
def show_guide(project: TheProject, desk: Desk) -> GuideAnswer:
    """Return how far the guide is, and what it asks now."""
    done = progress_in(project.folder).done
    return GuideAnswer(
        steps=[
            GuideStep(name=step.name, title=step.title, done=step.name in done) for step in STEPS
        ],
        open=open_step(done),
        here=desk.step,
        said=list(desk.said),
        question=desk.question,
        trouble=desk.trouble,
    )


@router.post("/guide/begin")
def begin(
    step: Annotated[str, Body(embed=True)], project: TheProject, line: TheLine, desk: Desk
) -> GuideAnswer:
    """Begin a step. Nothing moves before a question that names it is answered with yes."""
    names = [each.name for each in STEPS]
    refuse_unknown([step], names)
    now = open_step(progress_in(project.folder).done)
    if now and names.index(step) > names.index(now):
        raise InputError(f"this step comes later: first {STEPS[names.index(now)].title}")
    desk.begin(
        STEPS[names.index(step)],
        project.folder,
        line,
        unit=project.choices.unit,
        finished=lambda visit: _keep(project, line, visit, step),
    )
    return show_guide(project, desk)


@router.post("/guide/answer")
def answer(
    number: Annotated[int, Body()],
    reply: Annotated[str, Body(max_length=40)],
    project: TheProject,
    desk: Desk,
) -> GuideAnswer:
    """Answer a question; the machine may move as the question says."""
    desk.answer(number, reply)
    return show_guide(project, desk)


@router.post("/guide/leave")
def leave(project: TheProject, desk: Desk) -> GuideAnswer:
    """Leave the step; what is done stays done."""
    desk.leave()
    return show_guide(project, desk)


def _keep(project: Project, line: MachineLine, visit: GuideVisit, step: str) -> None:
    """Open the machine that a step wrote, with what its owner knows of it."""
    if step not in ("read", "numbers"):
        return
    line.worker.read_numbers(visit.sender)
    if line.virtual:
        line.virtual.settings = machine_of_numbers(line.state.numbers)
    frame = settings_in(visit.path).frame
    known = {
        name: Number(value=frame[name], sigma=sigma)
        for name, sigma in visit.progress.sigmas.items()
    }

    def opened(now: Choices) -> Choices:
        numbers = {**now.known, **known} if step == "numbers" else now.known
        return now.model_copy(update={"settings": SETTINGS, "known": numbers})

    save_choices(project, opened)
