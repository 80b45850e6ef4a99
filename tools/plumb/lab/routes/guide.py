"""The guide on the page: a step at a time, on the machine's line; its questions wait for answers.

A question stays until it is answered or left, whichever tab answers. While it waits the machine
stands, and Stop ends the step.
"""

import time
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from threading import Lock
from typing import Annotated

from fastapi import APIRouter, Body, Depends
from pydantic import BaseModel

from plumb.firmware.settings import machine_of_numbers
from plumb.fit.inputs import settings_in
from plumb.guide import (
    SETTINGS,
    STEPS,
    GuideVisit,
    LeftError,
    Question,
    Step,
    Talk,
    open_step,
    progress_in,
    take,
)
from plumb.lab.machine_line import MachineLine, TheLine
from plumb.lab.project import Choices, Number, Project, save_choices
from plumb.lab.routes.project import TheProject, of_lab
from plumb.line.sender import Sender, StoppedError
from plumb.text.errors import InputError, on_page
from plumb.text.values import Unit, refuse_unknown

MOMENT = 0.05  # [s] between two looks for an answer
PAYS_OUT = "chains"  # the step that does


class GuideDesk:
    """Takes a step at a time."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._count = 0
        self._reply: str | None = None
        self._left = False
        self.step = ""  # the step that is under way; empty if none is
        self.said: list[str] = []  # in the last step
        self.question: Question | None = None
        self.trouble = ""  # why the last step ended before its end
        self._hung: tuple[object, tuple[float, float]] | None = None  # a virtual machine's chains

    def begin(
        self,
        step: Step,
        folder: Path,
        line: MachineLine,
        *,
        unit: Unit,
        finished: Callable[[GuideVisit], None],
    ) -> None:
        """Begin a step; `finished` is called when it is done. Raises InputError for a busy line."""
        with self._lock:
            if self.step:
                raise InputError("a step of the guide is under way: finish or leave it first")
            self.step, self.said, self.trouble, self._left = step.name, [], "", False

        def work(sender: Sender) -> None:
            try:
                talk = Talk(
                    self.said.append, lambda question: self._put(question, sender, line), unit
                )
                self._note_hanging(step, line)
                visit = GuideVisit(sender, talk, progress_in(folder), lambda: self._hang(line))
                if take(visit, step):
                    finished(visit)
            finally:
                self.question = None

        try:
            line.worker.do(work).add_done_callback(self._end)
        except InputError:
            self.step = ""
            raise

    def answer(self, number: int, reply: str) -> None:
        """Answer the question of this number. Raises InputError if it is no longer asked."""
        with self._lock:
            if self.question is None or self.question.number != number:
                raise InputError("this question is no longer asked: look at what the guide says")
            if not self.question.fits(reply):
                raise InputError(f"{reply!r} is not an answer to this question")
            self.question, self._reply = None, reply

    def leave(self) -> None:
        """Leave the step; what is done stays done."""
        with self._lock:
            self._left, self.question = True, None

    def _end(self, work: Future[None]) -> None:
        """Note that the line is free again, or lost: the next step may begin."""
        if error := work.exception():
            self.trouble = _why(error)
        self.step = ""

    def _note_hanging(self, step: Step, line: MachineLine) -> None:
        """Chains of a virtual machine as its sled hangs, before the step that pays them out."""
        machine = line.virtual and line.virtual.machine
        if machine and step.name == PAYS_OUT and (not self._hung or self._hung[0] is not machine):
            self._hung = machine, machine.chains

    def _hang(self, line: MachineLine) -> None:
        """Hang the sled of a virtual machine: its chains were paid out while it hung already."""
        machine = line.virtual and line.virtual.machine
        if machine and self._hung and self._hung[0] is machine:
            for axis, before, now in zip(
                ("left", "right"), self._hung[1], machine.chains, strict=True
            ):
                machine.slip(axis, before - now)
            self._hung = None

    def _put(self, question: Question, sender: Sender, line: MachineLine) -> str:
        """Put a question, and wait for its answer. Raises LeftError if the step is left.

        The machine is heard meanwhile; Stop, or a line that is let go, ends the step.
        """
        with self._lock:
            self._count += 1
            self._reply = None
            self.question = replace(question, number=self._count)
        with line.resting():
            while self._reply is None:
                if self._left:
                    raise LeftError
                sender.listen()
                sender.attend(sender)
                time.sleep(MOMENT)
        return self._reply


def _why(error: BaseException) -> str:
    """Why a step ended before its end."""
    if isinstance(error, LeftError):
        return "You left this step. Begin it again when you like."
    if isinstance(error, StoppedError):
        return "Stop was pressed: the machine has stopped, and this step is open."
    return on_page(error)


# What the page asks of it; the folder keeps how far the first day is.


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
