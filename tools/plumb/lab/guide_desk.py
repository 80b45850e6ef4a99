"""The guide on the page: a step at a time, on the machine's line; its questions wait for answers.

A question stays until it is answered or left, whichever tab
answers. While it waits the machine stands, and Stop ends the step.
"""

import time
from collections.abc import Callable
from concurrent.futures import Future
from dataclasses import replace
from pathlib import Path
from threading import Lock

from plumb.guide.steps import GuideVisit, Step, take
from plumb.guide.talk import LeftError, Question, Talk, progress_in
from plumb.lab.machine_line import MachineLine
from plumb.line.sender import Sender, StoppedError
from plumb.text.errors import InputError, on_page
from plumb.text.values import Unit

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
