"""The progress of a program that is being sent."""

from __future__ import annotations

import re
from collections import deque
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass
from typing import Literal

from plumb.line.sender import COMMENT, PER_SECOND, Sender, plain
from plumb.text.answers import Internal


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
