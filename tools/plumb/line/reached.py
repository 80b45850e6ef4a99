"""Up to which line of a program the machine has surely come: it answers ahead of its motion."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence

from plumb.line.sender import PER_SECOND, Sender, plain

LATE = 2.0  # [s] by which motion may end later than planned, because the feed yields


class Reached:
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
        """The machine stops now: from here on nothing more is done."""
        self._ended = self._sender.worked

    @property
    def line(self) -> int:
        """The first line of the program that is perhaps not done."""
        self._forget()
        done = self._answered[0][0]
        return self._numbers[min(done, len(self._numbers) - 1)]

    def _forget(self) -> None:
        """Keep the last answer that is old enough, and all behind it."""
        reports = int(PER_SECOND * (self._sender.ahead + LATE))
        now = self._sender.worked if self._ended is None else self._ended
        while len(self._answered) > 1 and now - self._answered[1][1] >= reports:
            self._answered.popleft()
