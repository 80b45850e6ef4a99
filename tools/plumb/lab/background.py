"""Answers that take seconds: worked out in a thread, once for each state of the folder.

The page asks again and again; each time it hears how far the work is, and in the end the answer.
"""

from __future__ import annotations

from collections.abc import Callable
from concurrent.futures import Future, ThreadPoolExecutor
from dataclasses import dataclass, field, replace
from threading import Lock
from typing import Generic, TypeVar, cast

from plumb.cure.add import BoardView, LiveBoard
from plumb.cure.decision import Decision, decide
from plumb.diagnosis import Diagnosis, diagnose
from plumb.diagnosis.readings import Doubts, Outlier, sure_readings
from plumb.fit.compare import Comparison, compare
from plumb.fit.inputs import Inputs
from plumb.lab.project import Project
from plumb.text.errors import InputError

Result = TypeVar("Result")
Progress = Callable[[float], None]
NEARLY = 0.99  # done, where all steps are over and the result is not there yet


class OvertakenError(Exception):
    """The folder has changed, so this answer is no longer needed."""


@dataclass
class Task:
    """A piece of work for a state of the folder."""

    key: str
    future: Future[object] = field(default_factory=Future)
    share: float = 0.0  # that is done
    is_overtaken: bool = False

    def progress(self, share: float) -> None:
        """Note how far the work is; the work calls it now and then."""
        if self.is_overtaken:
            raise OvertakenError
        self.share = share


@dataclass(frozen=True)
class Answer(Generic[Result]):
    """The progress of the work, and its result."""

    share: float  # 1 only with a result, for the page asks no more then
    result: Result | None


class Background:
    """One thread, and the newest task of each kind."""

    def __init__(self) -> None:
        self._thread = ThreadPoolExecutor(max_workers=1, thread_name_prefix="lab")
        self._tasks: dict[str, Task] = {}
        self._lock = Lock()

    def ask(self, kind: str, key: str, work: Callable[[Progress], Result]) -> Answer[Result]:
        """Return the answer of this kind for this state, or how far it is. Raises what the work
        raised.
        """
        with self._lock:
            task = self._tasks.get(kind)
            if task is None or task.key != key:
                if task:
                    task.is_overtaken = True
                    task.future.cancel()
                task = self._tasks[kind] = Task(key)
                task.future = self._thread.submit(work, task.progress)
        if not task.future.done():
            return Answer(min(task.share, NEARLY), None)
        return Answer(1.0, cast(Result, task.future.result()))

    def decided(
        self,
        kind: str,
        key: str,
        inputs: Inputs,
        work: Callable[[Decision, Progress], Result],
        *,
        more: str = "",
    ) -> Answer[Result]:
        """Return the same of work that begins with the decision on these inputs, worked out once
        for all kinds. `key` is of the inputs, `more` of what the work depends on besides.
        """
        first = self.ask("decision", key, lambda progress: decide(inputs))
        if first.result is None:
            return Answer(first.share, None)
        decision = first.result
        return self.ask(kind, f"{key}\n{more}", lambda progress: work(decision, progress))


# The board of the bench, kept warm: read once, and again when a file or a choice has changed.

# Choices that a board does not depend on.
OF_THE_PAGE = {
    "bench",
    "accepted",
    "edges",
    "fineness",
    "layout",
    "new_sheet",
    "planned",
    "proposed",
    "settings_before",
}


@dataclass(frozen=True)
class WarmBoard:
    """A board with its view, and the marks against the settings as they stand."""

    key: str  # of the files and choices that it was made of
    words: tuple[str, ...]  # its files, as a command names them
    live: LiveBoard
    view: BoardView
    raw: Comparison
    inputs: Inputs  # with all readings
    slips: tuple[Outlier, ...]  # readings that no fit of the board sees

    @staticmethod
    def of(
        inputs: Inputs,
        live: LiveBoard,
        slips: tuple[Outlier, ...],
        *,
        key: str = "",
        words: tuple[str, ...] = (),
    ) -> WarmBoard:
        """Return the board of these inputs, whose fits leave the slips out."""
        return WarmBoard(key, words, live, BoardView(live), compare(inputs), inputs, slips)

    @property
    def doubts(self) -> Doubts:
        """Where these are among all readings."""
        return Doubts.of(self.slips, self.raw)


class LiveBoards:
    """Keeps the latest board."""

    def __init__(self) -> None:
        self._kept: WarmBoard | None = None
        self._making = Lock()

    def of(
        self,
        project: Project,
        inputs_of: Callable[[Project], Inputs],
        board_words: Callable[[Project], list[str]],
    ) -> WarmBoard:
        """Return the board of a project as it is on disk now. Raises InputError."""
        with self._making:
            key = key_of(project)
            if self._kept is None or self._kept.key != key:
                inputs = inputs_of(project)
                live, slips = _diagnosed(inputs)
                words = tuple(board_words(project))
                self._kept = WarmBoard.of(inputs, live, slips, key=key, words=words)
            return self._kept


def key_of(project: Project) -> str:
    """Another for other settings or marks, and for other choices that a fit depends on."""
    choices = project.choices
    said = choices.model_dump_json(exclude=OF_THE_PAGE)
    names = [name for name in (choices.settings, *choices.marks) if name]
    digests = [f"{name} {project.digest(name)}" for name in names]
    return "\n".join([said, *digests])


def _diagnosed(inputs: Inputs) -> tuple[LiveBoard, tuple[Outlier, ...]]:
    """Return the board on which a diagnosis fits, and the readings that it doubts."""
    try:
        diagnosis = diagnose(inputs)
    except InputError:  # too few readings, or what the board says better
        return LiveBoard(inputs), ()  # nothing can be fitted
    return sure_board(inputs, diagnosis), diagnosis.outliers


def sure_board(inputs: Inputs, diagnosis: Diagnosis) -> LiveBoard:
    """Return the board on which a diagnosis fits, without the readings that it doubts: its noise,
    and what is usual of sizes.
    """
    sure = sure_readings(inputs.measurements, diagnosis.outliers)
    checked = (*inputs.checked, *diagnosis.usual)
    # As plumb add has it: what is known of effects tells it nothing of the noise.
    of_effects = any("." in check.name for check in inputs.checked)
    noise = None if of_effects else diagnosis.noise
    return LiveBoard(replace(inputs, measurements=sure, checked=checked), noise=noise)
