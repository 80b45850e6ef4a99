"""A thread that owns the line to a machine: others give it work, and see how the machine is.

Hold, go on and stop do not wait for the work that is being done.
"""

from collections import deque
from collections.abc import Callable, Mapping, Sequence
from concurrent.futures import Future
from contextlib import suppress
from dataclasses import dataclass, field, replace
from functools import partial
from queue import Empty, SimpleQueue
from threading import Event, Lock, Thread
from time import monotonic
from typing import Any, Literal, TypeVar

from plumb.line.memory import firmware_of, read_numbers
from plumb.line.port import LinePort, LostError
from plumb.line.sender import (
    HALTED,
    PAUSED,
    REPORTS,
    SAID_PAUSED,
    Came,
    LineCourse,
    Progress,
    Sender,
    Status,
    StoppedError,
    Watch,
    are_apart,
    cleaned,
    waits_in,
)
from plumb.text.answers import Internal, in_json
from plumb.text.errors import InputError, on_page

Result = TypeVar("Result")
Phase = Literal["none", "connecting", "ready", "busy", "stopping", "lost"]
LEAVES = 5.0  # [s] in which a line is usually let go of
SAID = 30  # lines of the machine that are kept
SURE = 2  # reports after which it shows whether a hold that was pressed is done
HAS_HALTED = "The machine has halted: press Stop."


@dataclass(frozen=True)
class _Done:
    """Outcome of work."""

    changes: dict[str, Any] = field(default_factory=dict)  # of the state; then the line is ready
    then: Callable[[], None] = lambda: None  # called once the line is ready again


@dataclass(frozen=True)
class _Task:
    """Work for the line's thread."""

    run: Callable[[Sender], _Done]
    give_up: Callable[[LostError], None] = lambda error: None  # it will never be done


@dataclass(frozen=True)
class LineState:
    """The state of the line and the machine."""

    phase: Phase = "none"
    place: tuple[float, float, float] | None = None  # [mm] x, y, z
    knows_place: bool = True
    kept_lengths: tuple[float, float] | None = None  # [mm] of the chains when it last stood still
    holds: bool = False
    moves: bool = False
    trouble: str = ""  # what went wrong last
    program: Progress | None = None
    said: tuple[str, ...] = ()  # the machine's last lines
    firmware: str = ""  # its name with its version, if a start said it
    # All that it last listed.
    numbers: Internal[Mapping[int, float]] = field(default_factory=dict)

    @in_json
    def waits_for(self) -> str:
        """Work for a hand before the program goes on; empty if it does not wait."""
        wait = self.program.wait if self.program and self.holds else None
        return wait.do if wait else ""


class LineWorker:
    """The machine at the end of a line that is opened in another thread."""

    def __init__(
        self,
        opened: Callable[[], LinePort],
        *,
        knows_place: bool = True,
        working: Callable[[bool], None] = lambda works: None,
    ) -> None:
        """Take what opens the line, and `working`, which hears when work begins and ends."""
        self._opened, self._working = opened, working
        self._state = LineState("connecting", knows_place=knows_place)
        self._lock = Lock()
        self._work = SimpleQueue[_Task]()
        self._hold, self._go_on, self._stop, self._end = Event(), Event(), Event(), Event()
        self._said = deque[str](maxlen=SAID)
        self._places = deque[tuple[float, Status]]()
        self._paused: Callable[[int], None] = lambda lines: None
        self._course: LineCourse | None = None  # of the program that is sent
        self._waits = False  # in mid-work, for a person
        self._held_at = -SURE  # reports that had come at the last hold
        self._sender: Sender | None = None
        self._thread = Thread(target=self._run, name="line to the machine", daemon=True)
        self._thread.start()

    @property
    def state(self) -> LineState:
        """The present state."""
        with self._lock:
            return self._state

    @property
    def silence(self) -> float:
        """The time since the machine last reported [s]; 0 where no report is due."""
        sender = self._sender
        due = sender and sender.reported_at and self.state.phase in ("ready", "busy", "stopping")
        return monotonic() - sender.reported_at if sender and due else 0.0

    def do(self, work: Callable[[Sender], Result]) -> Future[Result]:
        """Have work done with the machine. Raises InputError in a hold or while other work is done.

        The future is done when the line takes other work again, or is lost.
        """
        future: Future[Result] = Future()

        def doing(sender: Sender) -> _Done:
            try:
                result = work(sender)
            except LostError as error:
                future.set_exception(error)
                raise
            except BaseException as error:
                return _Done(then=partial(future.set_exception, error))
            return _Done(then=partial(future.set_result, result))

        self._begin(_Task(doing, future.set_exception))
        return future

    def send(
        self,
        title: str,
        lines: Sequence[str],
        then: Callable[[Sender], None] = lambda sender: None,
        *,
        paused: Callable[[int], None] = lambda lines: None,
        came: Came = lambda done, begun: None,
        before: int = 0,
    ) -> None:
        """Send a program; `then` is called when the machine rests after it, and `paused` at each of
        its pauses with how many lines the machine took before. `came` hears how many are surely
        done, and how many perhaps, before each line is sent. `before`: those that it took on an
        earlier day. Raises InputError for lines that cannot be sent, and while there is other work.
        """
        clean, waits = list(cleaned(lines)), tuple(waits_in(lines, before))
        progress = Progress(title, before, before + len(clean), waits=waits)

        def answered(done: int) -> None:
            now = self._state.program
            assert now is not None
            self._note(program=replace(now, done=before + done))

        def sending(sender: Sender) -> _Done:
            self._paused = paused
            self._course = course = LineCourse(sender, clean, came, before)
            try:
                sender.stream(course.leaving(), answered=course.hears(answered))
                self._await_rest(sender)
                then(sender)
            except StoppedError:
                course.stopped()
                return self._finished("stopped", "The machine has stopped. The rest was not sent.")
            except LostError:
                raise
            except (InputError, ValueError) as error:
                return self._finished("refused", on_page(error))
            return self._finished("done", "")

        self._begin(_Task(sending), program=progress)

    def read_numbers(self, sender: Sender) -> None:
        """Read the machine's numbers into the state in the middle of work."""
        self._note(numbers=read_numbers(sender))

    def hold(self) -> None:
        """Stop along the path as soon as the motors can."""
        self._go_on.clear()
        self._hold.set()

    def go_on(self) -> None:
        """Go on after a hold."""
        self._hold.clear()
        self._go_on.set()

    def stop(self) -> None:
        """Give up what is being done."""
        self._stop.set()

    def close(self) -> None:
        """Let go of the line; a machine that moves is stopped first, which may take longer."""
        self._end.set()
        self._thread.join(LEAVES)

    def await_end(self) -> None:
        """Wait until the line is let go of."""
        self._thread.join()

    def _begin(self, task: _Task, program: Progress | None = None) -> None:
        with self._lock:
            if self._state.phase != "ready":
                raise InputError(_busy(self._state.phase))
            if self._state.holds or self._hold.is_set():
                # It would keep the lines and not answer them.
                raise InputError("the machine holds: press Go on, or Stop, first")
            self._state = replace(
                self._state, phase="busy", trouble="", program=program or self._state.program
            )
            self._work.put(task)

    def _note(self, **changes: Any) -> None:
        with self._lock:
            self._state = replace(self._state, **changes)

    def _finished(self, outcome: Literal["done", "stopped", "refused"], trouble: str) -> _Done:
        program = self.state.program
        assert program is not None
        return _Done({"program": replace(program, outcome=outcome), "trouble": trouble})

    def _run(self) -> None:
        port: LinePort | None = None
        try:
            port = self._opened()
            sender = self._sender = Sender(port, said=self._hear, attend=self._attend)
            sender.await_start()
            self._read_first(sender)
            if sender.greeting:  # else it was on already, and says only what clients expect
                self._note(firmware=firmware_of(sender))
            self._note(phase="ready")
            while not self._end.is_set():
                self._serve(sender)
            if not self.state.holds:
                sender.await_rest()  # whoever opens the line next resets the board
        except Exception as error:
            self._lose(str(error) or type(error).__name__)
        else:
            self._note(phase="none")
        finally:
            self._give_up()
            if port:
                port.close()

    def _read_first(self, sender: Sender) -> None:
        """Read the numbers of a machine that was connected, if it lists any."""
        try:
            self.read_numbers(sender)
        except LostError:
            raise
        except (InputError, StoppedError):
            return  # the machine cannot be calibrated, or Stop was pressed

    def _give_up(self) -> None:
        """Give up what came in while the line was lost: the line takes no work any more."""
        with suppress(Empty):
            while True:
                self._work.get_nowait().give_up(LostError(self.state.trouble or "the line is shut"))

    def _serve(self, sender: Sender) -> None:
        """Do the next work, or listen for a moment."""
        try:
            task = self._work.get_nowait()
        except Empty:
            sender.listen()
            self._see(sender)
            self._press(sender)
            return
        self._waits = False
        self._working(True)
        try:
            done = task.run(sender)
        finally:
            self._working(False)
        self._see(sender)
        self._note(phase="ready", **done.changes)
        done.then()

    def _attend(self, sender: Sender) -> None:
        """While lines are on their way."""
        self._see(sender)
        if self._waits != self._state.holds:
            self._waits = self._state.holds
            self._working(not self._waits)  # while a person is to do something, time is real
        if self._stop.is_set() or self._end.is_set():
            for pressed in (self._stop, self._hold, self._go_on):
                pressed.clear()
            self._held_at = -SURE
            self._note(phase="stopping")
            if self._course:
                self._course.end()
            sender.stop()
        self._press(sender)

    def _press(self, sender: Sender) -> None:
        """Pass on a key press."""
        if self._stop.is_set():
            self._stop.clear()
            self._held_at = -SURE
            sender.brake()
        if self._hold.is_set():
            self._held_at = sender.reports
            self._note(holds=True)
            self._hold.clear()
            sender.hold()
        if self._go_on.is_set():
            self._go_on.clear()
            self._held_at = -SURE
            sender.go_on()

    def _await_rest(self, sender: Sender) -> None:
        """Wait until the sled stands; it may be held or stopped meanwhile."""
        watch = Watch(sender)
        while self.state.moves or self.state.holds or not watch.has_lasted(REPORTS):
            sender.listen()
            self._attend(sender)

    def _see(self, sender: Sender) -> None:
        """Note what the machine reported."""
        if sender.knows_place is not None:
            self._note(knows_place=sender.knows_place, kept_lengths=sender.kept_lengths)
        status = sender.status
        if status is None:
            return
        now = sender.port.seconds()
        if not self._places or status is not self._places[-1][1]:
            self._places.append((now, status))
        # Two at least: this program may have stood still since the report before.
        while len(self._places) > 2 and now - self._places[0][0] > REPORTS:
            self._places.popleft()
        moves = any(are_apart(status.place, old.place) for _, old in self._places)
        holds = status.state == PAUSED or sender.reports - self._held_at < SURE
        self._note(place=status.place, holds=holds, moves=moves)
        if status.state == HALTED and not self._state.trouble:
            self._note(trouble=HAS_HALTED)
        elif status.state != HALTED and self._state.trouble == HAS_HALTED:
            self._note(trouble="")

    def _hear(self, line: str) -> None:
        """Note what the machine said."""
        if not line:
            return
        self._said.append(line)
        changes: dict[str, Any] = {"said": tuple(self._said)}
        program = self._state.program
        if line == SAID_PAUSED and program and program.outcome == "running":
            changes["program"] = replace(program, paused_at=program.done)
            self._paused(program.done)
        if line.startswith("ALARM"):
            changes["trouble"] = line
        self._note(**changes)

    def _lose(self, why: str) -> None:
        """Note that the line is gone; the machine may have been cut off in mid-move."""
        state = self.state
        in_work = state.phase in ("busy", "stopping") or state.moves
        program = state.program
        if program and program.outcome == "running":
            why += f". {program.done} of {program.total} lines of {program.title} were done"
            program = replace(program, outcome="lost")
        self._note(
            phase="lost",
            trouble=why,
            program=program,
            moves=False,
            holds=False,
            knows_place=state.knows_place and not in_work,
        )


def _busy(phase: Phase) -> str:
    """Why there can be no work now."""
    return {
        "none": "no machine is connected: connect it first",
        "connecting": "the machine is not ready yet: wait a moment",
        "lost": "the line to the machine was lost: connect it again",
    }.get(phase, "the machine is busy: wait, or press Stop")
