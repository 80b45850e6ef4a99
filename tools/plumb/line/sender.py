"""Sends lines to a machine as its clients do: ahead of its answers, and no line twice.

The machine answers each line with a single `ok` or `error:`. Its buffer holds 127 characters, so
that many may be on their way at once.
"""

from __future__ import annotations

import math
import re
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from time import monotonic
from typing import Literal

from plumb.line.port import LinePort, LostError
from plumb.text.answers import Internal
from plumb.text.errors import InputError
from plumb.text.values import INCH

Place = tuple[float, float, float]  # [mm] x, y, z
AHEAD = 126  # characters on their way at most
SILENCE = 5.0  # [s] the machine reports five times a second, so this long a silence has a reason
START = 12.0  # [s] a board that was reset by the line takes up to six
SILENT = 1.5  # [s] a Maslow reports five times a second; after a sender of Grbl it does not
QUESTION = "B05"  # turns its reports on
VERSION = "Firmware Version"  # how its answer begins; an `ok` follows
READY = "ready"  # ends the greeting of a board that was reset
HOLD, GO_ON, STOP = b"\x84", b"~\n", b"!\n"
ANSWERS = ("ok", "error:")
WRONG = ("ALARM", "error:")  # beginnings of lines that must be shown
QUESTIONS = ("$$", QUESTION, "B10 L", "B10 R")  # move nothing, and power no motor
PAUSED = "Pause"  # what a machine reports that holds
HALTED = "Stop"  # what a machine reports that waits for Stop; it answers questions alone
PATIENT = 5  # reports, a second of them
STANDS = 0.02  # [mm] between two reports of a machine at rest
REPORTS = 0.6  # [s] in which it reports thrice
PER_SECOND = 5  # reports
KEPT = 2.0  # [s] after the motors are off: then the position is in the memory
COMMENT = re.compile(r"\([^)]*\)")
NUMBER = re.compile(r"\$(9|71)\s*=\s*([\d.]+)")  # that say how long motors hold, and are ahead
# What a machine says of its place, at its start or to a line: its reports say nothing of that.
LOST_PLACE = ("Position Lost", "Chain lengths are not known", "Unable to find valid machine")
FOUND_PLACE = "position loaded at:"
KEPT_LENGTHS = re.compile(r"Last known chain lengths: (-?[\d.]+), (-?[\d.]+)")
STATUS = re.compile(r"<(\w+),MPos:(-?[\d.]+),(-?[\d.]+),(-?[\d.]+)")
IN_INCHES = re.compile(r"<\w+,MPos:-?\d+\.\d{4}")  # after G20; a report in mm has two decimals


class RefusedError(InputError):
    """The machine refused a line, or raised an alarm."""


class StoppedError(Exception):
    """Whoever sends gave up; the machine has stopped."""


def lost_place(said: Iterable[str]) -> str:
    """Return the machine's words for a place that it does not know; empty if there are none."""
    return next((line for line in said if any(words in line for words in LOST_PLACE)), "")


def are_apart(place: Place, other: Place) -> bool:
    """Return whether a machine at rest would not report these two places [mm]."""
    return max(map(abs, map(float.__sub__, place, other))) > STANDS


@dataclass(frozen=True)
class Status:
    """Last report of the machine."""

    state: str
    place: Place


@dataclass
class Sender:
    """A machine at the end of a line."""

    port: LinePort
    said: Callable[[str], None] = lambda line: None  # hears everything but answers
    status: Status | None = None
    # Called again and again while lines are on their way; it may hold the machine, or stop it.
    attend: Callable[[Sender], None] = lambda sender: None
    reports: int = 0  # that came so far
    worked: int = 0  # reports of a machine that did not pause
    holds_for: float = 2.0  # [s] after a motion until the motors are off ($9)
    ahead: float = 1.0  # [s] of motion that may be left of a line that is answered ($71)
    reported_at: float = 0.0  # when the last came, by this computer's clock [s]; 0: none did
    knows_place: bool | None = None  # as the machine last said; None: it has not said anything
    kept_lengths: tuple[float, float] | None = None  # [mm] of the chains when it last stood still
    greeting: tuple[str, ...] = ()  # what the machine said before its first report
    _stirred: Watch | None = None  # since it last may have moved; None: it has not
    _place: Place | None = None  # [mm] where it stands, or last moved to
    _partial: str = ""
    _heard_at: float = math.inf  # a machine need not speak before it is asked
    _halted_from: int = 0  # reports that had come when it was last seen to do something
    _spare: int = 0  # answers to come that belong to no line
    _asked: int = 0  # questions at the start that may still be answered; a board that boots is deaf
    _has_greeted: bool = False  # or has answered
    _reported: float = 0.0  # [s] when the last report came, by the line's clock
    _has_held: bool = False  # no `~` has come since the last hold
    # Answers to come for lines that were on their way behind a refused line, or were slipped in.
    _left: int = 0
    _on_the_way: deque[tuple[str, int]] = field(default_factory=deque)

    def await_start(self) -> None:
        """Wait until the machine reports; of its greeting only what is wrong is heard.

        A report that came before a greeting may have been on the line when the board was reset, so
        a machine that does not greet has to report for longer than a board that starts is silent.
        """
        begin = asked = reported = self.port.seconds()
        greeted, said = list[str](), self.said
        self.said = greeted.append
        while self.status is None or not (self._has_greeted or self._reported > reported + SILENT):
            if self.status is None:
                reported = self.port.seconds()
            self.listen()
            if self.port.seconds() - asked > SILENT:
                asked = self.port.seconds()
                self.port.write(QUESTION.encode("ascii") + b"\n")
                self._asked += 1
            if self.port.seconds() - begin > START:
                raise LostError(
                    "the machine does not answer: check the cable, its power, and that no other "
                    "program has the line"
                )
        self.said = said
        self.greeting += tuple(greeted)
        for line in greeted:
            if line.startswith(WRONG):
                said(line)

    def stream(self, lines: Iterable[str], *, answered: Callable[[int], None] | None = None) -> int:
        """Send lines and wait for all answers; how many there were.

        `answered` hears how many are done. Raises RefusedError at the first line that the machine
        refuses; nothing more is sent then.
        """
        done = 0
        self._heard_at = self.port.seconds()
        self._halted_from = self.reports
        for line in cleaned(lines):
            self._note_line(line)
            while sum(length for _, length in self._on_the_way) + len(line) + 1 > AHEAD:
                done = self._hear(done, answered)
            self.port.write(line.encode("ascii") + b"\n")
            self._on_the_way.append((line, len(line) + 1))
        while self._on_the_way:
            done = self._hear(done, answered)
        return done

    def ask(self, line: str) -> list[str]:
        """Return what the machine says to a line before its `ok`."""
        heard: list[str] = []
        said, self.said = self.said, heard.append
        try:
            self.stream([line])
        finally:
            self.said = said
        return heard

    def await_rest(self, *, attended: bool = False) -> None:
        """Wait until the sled stands and the machine has kept its position.

        The next program that opens the line resets the board; a board that still moves then loses
        its position. A machine that stands may still hold with its motors, after whatever it was
        told. attended: somebody may hold or stop the machine meanwhile.
        """
        watch = Watch(self)
        while not (watch.has_lasted(REPORTS) and self._has_kept_place()):
            self.listen()
            if attended:
                self.attend(self)

    def _has_kept_place(self) -> bool:
        return self._stirred is None or self._stirred.has_lasted(self.holds_for + KEPT)

    def listen(self) -> None:
        """Take what comes while nothing is asked. Raises LostError if nothing has come for long."""
        for line in self._lines():
            if self._is_left_over(line):
                continue
            if line == "ok":
                self._spare = max(0, self._spare - 1)
            elif not self._note_status(line):
                self._say(line)

    def hold(self) -> None:
        """Stop along the path, as soon as the motors can."""
        self.port.write(HOLD)
        self._has_held = True

    def go_on(self) -> None:
        """Go on after a hold."""
        self.port.write(GO_ON)
        self._stirred = Watch(self)
        # Behind a hold it has no `ok`; one that ends a pause has, and it answers no line.
        self._spare += not self._has_held
        self._has_held = False

    def stop(self) -> None:
        """Give up: the machine brakes and forgets what it has not done; raises StoppedError."""
        self.brake()
        self._on_the_way.clear()
        self.await_rest()
        raise StoppedError

    def slip_in(self, line: str) -> None:
        """Send a line while the machine waits: it does that at once, or says why not. InputError
        for what cannot be sent.
        """
        for text in cleaned([line]):
            self.port.write(text.encode("ascii") + b"\n")
            self._left += 1  # its answer belongs to no line of the program

    @property
    def has_answered(self) -> bool:
        """Whether no line that was slipped in waits for its answer."""
        return not self._left

    def brake(self) -> None:
        """Stop a machine that nothing is being sent to."""
        self.port.write(STOP)
        self._stirred = Watch(self)
        self._spare += 1
        self._has_held = False
        self._left = 0  # what the machine has not begun it forgets

    def _hear(self, done: int, answered: Callable[[int], None] | None) -> int:
        """Take what came; the count of answers."""
        self.attend(self)
        for line in self._lines():
            if self._note_status(line):
                self._refuse_if_halted()
                continue
            self._halted_from = self.reports
            if self._is_left_over(line):
                continue
            if line == "ok" and self._spare:
                self._spare -= 1
            elif line == "ok" and self._on_the_way:
                line, _ = self._on_the_way.popleft()
                self._note_line(line)
                done += 1
                if answered:
                    answered(done)
            elif line.startswith(WRONG):
                self._refuse(line)
            else:
                self._say(line)
        return done

    def _say(self, line: str) -> None:
        """Pass on all but answers, and note what the machine says of its numbers."""
        self._has_greeted |= line == READY or line.startswith(VERSION)
        if line.startswith(VERSION) and self._is_late():
            self._asked -= 1
            self._spare += 1
            return
        self._note_number(line)
        self.said(line)

    def _is_late(self) -> bool:
        """Return whether a version answers a question of the start, however late, and no line."""
        next_line = self._on_the_way[0][0] if self._on_the_way else ""
        return self._asked > 0 and next_line != QUESTION

    def _note_line(self, line: str) -> None:
        """Note a line that is sent, or answered: it may power the motors."""
        self._note_number(line)
        if line not in QUESTIONS:
            self._stirred = Watch(self)

    def _note_number(self, line: str) -> None:
        row = NUMBER.match(line)
        if row and row[1] == "9":
            self.holds_for = float(row[2]) / 1000
        elif row:
            self.ahead = float(row[2]) / 1000

    def _refuse(self, answer: str) -> None:
        line = self._on_the_way[0][0] if self._on_the_way else ""
        # After an alarm the machine forgets what it has not begun; else it goes on with it.
        is_alarm = answer.startswith("ALARM")
        self._left = 0 if is_alarm else max(0, len(self._on_the_way) - 1)
        self._on_the_way.clear()
        where = f"{line!r}: " if line else ""
        raise RefusedError(f"{where}the machine says: {answer}")

    def _refuse_if_halted(self) -> None:
        """Refuse to wait on for a machine that halted before: it drops lines without an answer."""
        if self.status is None or self.status.state != HALTED:
            self._halted_from = self.reports
        elif self.reports - self._halted_from >= PATIENT:
            line = self._on_the_way[0][0] if self._on_the_way else ""
            self._on_the_way.clear()
            raise RefusedError(f"{line!r}: the machine has halted; press Stop first")

    def _is_left_over(self, line: str) -> bool:
        """Return whether it answers a line that was on its way behind a refused line."""
        if not self._left or not line.startswith(ANSWERS):
            return False
        self._left -= 1
        if line.startswith(WRONG):
            self.said(line)
        return True

    def _lines(self) -> Iterator[str]:
        """Whole lines that came."""
        # This program may have stood still: what came meanwhile waits to be read.
        asked_at = self.port.seconds()
        came = self.port.read()
        if came:
            self._heard_at = self.port.seconds()
        elif asked_at - self._heard_at > SILENCE:
            raise LostError(
                f"the machine has been silent for {SILENCE:.0f} s: check its cable and power"
            )
        text = self._partial + came.decode("ascii", errors="replace")
        *lines, self._partial = text.split("\n")
        for line in lines:
            self._note_place(line)
            yield line.strip("\r")

    def _note_place(self, line: str) -> None:
        """Note what the machine says of its place."""
        if lost_place([line]):
            self.knows_place = False
        elif line.startswith(FOUND_PLACE):
            self.knows_place = True
        if kept := KEPT_LENGTHS.search(line):
            self.kept_lengths = float(kept[1]), float(kept[2])

    def _note_status(self, line: str) -> bool:
        """Return whether a line is a report."""
        match = STATUS.match(line)
        if match:
            scale = INCH if IN_INCHES.match(line) else 1.0
            x, y, z = (scale * float(number) for number in match.groups()[1:])
            self.status = Status(match[1], (x, y, z))
            self._note_motion(self.status)
            self.reports += 1
            self.worked += match[1] != PAUSED
            self.reported_at, self._reported = monotonic(), self.port.seconds()
        return match is not None or line.startswith("[PE:")

    def _note_motion(self, status: Status) -> None:
        """Note a place that is not the last, and a hold, in which the motors keep their power."""
        place = self._place or status.place
        moved = are_apart(status.place, place)
        if moved or status.state == PAUSED:
            self._stirred = Watch(self)
        self._place = status.place if moved else place


class Watch:
    """The time for which a machine has been watched: by the clock, and by its reports.

    A computer that is busy stands still for seconds, and the machine's last report looks as if
    nothing had moved since. So time counts only as far as reports came in it.
    """

    speed = 1.0  # of the machine's time: that of a virtual machine may be higher

    def __init__(self, sender: Sender) -> None:
        self._sender = sender
        self._since, self._reports = sender.port.seconds(), sender.reports

    def has_lasted(self, seconds: float) -> bool:
        """Return whether so long has passed, and nearly all its reports came."""
        came = self._sender.reports - self._reports
        passed = self.speed * (self._sender.port.seconds() - self._since)
        return passed >= seconds and came >= int(seconds * PER_SECOND) - 1


class PlainError(ValueError):
    """A line that the machine's buffer cannot hold, or that is no ASCII text; says why."""


def plain(line: str) -> str:
    """Return a line without comments and blanks around it; raises PlainError."""
    if "(" in line:
        line = COMMENT.sub("", line)
    text = line.partition(";")[0].strip()
    if not text.isascii() or not text.isprintable():
        raise PlainError(f"is not plain text: {text!r}")
    if len(text) + 1 > AHEAD:
        raise PlainError(f"is longer than the {AHEAD} characters of the buffer")
    return text


def cleaned(lines: Iterable[str]) -> Iterator[str]:
    """Yield lines without comments and blanks around them; empty lines are left out.

    Raises InputError for a line that the machine's buffer cannot hold, or that is no ASCII text.
    """
    for number, line in enumerate(lines, start=1):
        try:
            text = plain(line)
        except PlainError as error:
            raise InputError(f"line {number} {error}") from None
        if text:
            yield text


# The progress of a program that is being sent.


@dataclass(frozen=True)
class Progress:
    """A program on its way."""

    title: str
    done: int  # lines that the machine took
    total: int
    outcome: Literal["running", "done", "stopped", "refused", "lost"] = "running"
    waits: Internal[tuple[Wait, ...]] = ()  # its pauses
    paused_at: Internal[int] = -1  # lines that it had taken when it last came to a pause

    @property
    def wait(self) -> Wait | None:
        """The pause in which it is; None if it goes on, or is held elsewhere."""
        if self.outcome != "running" or self.paused_at != self.done:
            return None
        return next((wait for wait in self.waits if wait.lines == self.done), None)


# The pauses of a program (M0, M1), and what its comments say is to be done then.

SAID_PAUSED = "Maslow Paused"  # said when a program comes to a pause; a hold says nothing
PAUSE = re.compile(r"M0?[01]", re.IGNORECASE)


@dataclass(frozen=True)
class Wait:
    """A pause of a program."""

    lines: int  # that the machine takes before it
    do: str  # the comment before it, or in its line; empty if there is none


def waits_in(lines: Iterable[str], before: int = 0) -> Iterator[Wait]:
    """Yield the pauses of a program, in their order; `before`: lines taken on an earlier day."""
    count, said = before, ""
    for line in lines:
        comment, text = COMMENT.search(line), plain(line)
        said = comment[0][1:-1].strip() if comment else said
        if not text:
            continue
        if PAUSE.fullmatch(text):
            yield Wait(count, said)
        count, said = count + 1, ""


# Up to which line of a program the machine has surely come, and up to which perhaps.
#
# It answers ahead of its motion, and it has lines that it has not answered yet.


LATE = 2.0  # [s] by which motion may end later than planned, because the feed yields


class SureLines:
    """The lines that are surely done.

    A line is answered while some of its motion is left, so it is done a while later. The while is
    counted in reports that came of a machine that does not pause: neither a hold nor a line that
    was lost makes a line done.
    """

    def __init__(self, sender: Sender, lines: Sequence[str]) -> None:
        """`lines` of the program, with those that are not sent."""
        self._sender = sender
        self._numbers = [number for number, line in enumerate(lines, start=1) if plain(line)]
        self._answered = deque([(0, 0)])  # lines, and the reports that had come
        self._ended: int | None = None  # the reports that had come when it stopped

    def note(self, done: int) -> None:
        """Note that the machine answered this many lines."""
        self._answered.append((done, self._sender.worked))
        self._forget()

    def end(self) -> None:
        """Note that the machine stops now: from here on nothing more is done."""
        self._ended = self._sender.worked

    @property
    def done(self) -> int:
        """The number of sent lines that are surely done."""
        self._forget()
        return self._answered[0][0]

    @property
    def line(self) -> int:
        """The first line of the program that is perhaps not done."""
        return self._numbers[min(self.done, len(self._numbers) - 1)]

    def _forget(self) -> None:
        """Keep the last answer that is old enough, and all behind it."""
        reports = int(PER_SECOND * (self._sender.ahead + LATE))
        now = self._sender.worked if self._ended is None else self._ended
        while len(self._answered) > 1 and now - self._answered[1][1] >= reports:
            self._answered.popleft()


Came = Callable[[int, int], None]  # hears how many lines are surely done, and how many perhaps
UNDER_WAY = 2  # lines of a machine that is stopped: one that it answered, unheard, and the next


class LineCourse:
    """The least and the greatest progress of a program: the machine holds lines for a while."""

    def __init__(self, sender: Sender, lines: Sequence[str], came: Came, before: int) -> None:
        self._lines, self._came, self._before = lines, came, before
        self._reached = SureLines(sender, lines)
        self._answered, self._left = 0, 0

    def leaving(self) -> Iterator[str]:
        """Yield the lines; each is noted before it leaves."""
        for line in self._lines:
            self._left += 1
            self._say()
            yield line

    def hears(self, answered: Callable[[int], None]) -> Callable[[int], None]:
        """Return what hears the answers here and there."""

        def heard(done: int) -> None:
            self._answered = done
            self._reached.note(done)
            answered(done)
            self._say()

        return heard

    def end(self) -> None:
        """Note that the machine is to stop now."""
        self._reached.end()

    def stopped(self) -> None:
        """Note that it did, and forgot what it had not begun."""
        self._left = min(self._left, self._answered + UNDER_WAY)
        self._say()

    def _say(self) -> None:
        self._came(self._before + self._reached.done, self._before + self._left)
