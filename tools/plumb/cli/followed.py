"""The progress of a program that is being sent: its line, its share, and the time left."""

import sys
from collections.abc import Sequence
from time import monotonic

from plumb.cli.screen import Bar, bar
from plumb.job.dry_run import TimeLeft, timetable
from plumb.line.sender import Sender, Status, cleaned, plain
from plumb.text.values import time_text

NOWHERE = Status("", (0.0, 0.0, 0.0))
RENEWED = 0.5  # [s] between two looks in a terminal
SAID = 60.0  # [s] between two lines elsewhere


class Followed:
    """Says how far a program is: line, percent and the time that is left.

    In a terminal that is a line that renews itself; elsewhere a line now and then.
    """

    def __init__(self, text: Sequence[str], left: TimeLeft | None) -> None:
        """`left` is None for a single line, and where no dry run says how long it takes."""
        self._left = left
        self._numbers = [number for number, line in enumerate(text, start=1) if plain(line)]
        self._total = len(text)
        self._line = 0
        self._bar = Bar("sending", patience=0.5)
        self._shown_at = self._said_at = monotonic()

    def answered(self, done: int) -> None:
        """Note that the machine took this many lines."""
        self._line = self._numbers[done - 1]

    def look(self, *, pauses: bool) -> None:
        """Note the time, and show how far the program is; called again and again."""
        now = monotonic()
        if self._left is None:
            return
        self._left.note(now, self._line, pauses=pauses)
        if pauses or not self._line:
            return
        if now - self._shown_at >= RENEWED:
            self._shown_at = now
            self._bar.show(self._left.share, self._words())
        if now - self._said_at >= SAID and not sys.stderr.isatty():
            self._said_at = now
            print(f"{self._words()}, {100 * self._left.share:.0f} % done", file=sys.stderr)

    def _words(self) -> str:
        left = time_text(self._left.seconds) if self._left else ""
        return f"line {self._line} of {self._total}, {left} left"

    def clear(self) -> None:
        """Leave nothing behind."""
        self._bar.clear()


def time_left(sender: Sender, numbers: dict[int, float], text: Sequence[str]) -> TimeLeft | None:
    """Return what is left of a program, by a dry run with the machine's numbers; None for a single
    line, and where there is no dry run.
    """
    if sum(1 for _ in cleaned(text)) < 2:
        return None
    place = (sender.status or NOWHERE).place
    times = timetable(numbers, text, place, progress=bar("working out how long it takes"))
    return TimeLeft(times, ahead=sender.ahead) if times else None
