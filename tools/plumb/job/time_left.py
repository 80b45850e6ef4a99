"""The time left of a program that is being sent, by its dry run and its progress so far."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from plumb.firmware.settings import CLIENT_NUMBERS, machine_of_numbers
from plumb.job.dry_run import Run, Share
from plumb.model.predict import Array
from plumb.text.errors import InputError

STEADY = 20.0  # [s] of the dry run that the first seconds of a job are weighed against
# What else sets the pace, behind what clients send: accelerations, corners, chains.
PACE = (65, 66, 67, 68)


@dataclass(frozen=True)
class Timetable:
    """When each line of a program is done, by its dry run."""

    done_at: Array  # (lines + 1,) [s] after the begin; of line 0 zero

    @property
    def whole(self) -> float:
        """The program's duration [s]."""
        return float(self.done_at[-1])


def timetable(
    numbers: Mapping[int, float],
    lines: Sequence[str],
    place: tuple[float, float, float],
    *,
    progress: Share | None = None,
) -> Timetable | None:
    """Return the times of lines on a machine with these numbers, that stands at a place [mm]; None
    where it does not know how the sled hangs there.
    """
    pace = {number: numbers[number] for number in (*CLIENT_NUMBERS, *PACE) if number in numbers}
    try:
        run = Run(machine_of_numbers(numbers), start=place, numbers=pace)
    except InputError:
        return None  # what the machine thinks of its numbers it says itself
    run.send(lines, progress=progress)
    done = run.finish()
    done_at = np.zeros(len(lines) + 1)
    np.maximum.at(done_at, done.moves["line"].astype(int), done.moves["ends"])
    done_at = np.maximum.accumulate(done_at)
    done_at[-1] = max(done.seconds, float(done_at[-1]))
    return Timetable(done_at)


class TimeLeft:
    """The progress of a job: its timetable, corrected by the time taken so far.

    A machine may be slower than planned: its feed yields, or its operator turns it down. Pauses do
    not count.
    """

    def __init__(self, table: Timetable, *, ahead: float) -> None:
        """ahead [s]: how much motion may be left of a line that is answered."""
        self._table, self._ahead = table, ahead
        self._ran = self._ran_at = 0.0  # [s] so far, and when a line was last done
        self._last: float | None = None
        self._done = 0.0

    def note(self, now: float, line: int, *, pauses: bool) -> None:
        """Note that the machine has taken a line, at a time [s]; `pauses`: it waits, or is held."""
        if self._last is not None and not pauses:
            self._ran += now - self._last
        self._last = now
        begun = float(self._table.done_at[max(0, line - 1)])
        done = max(begun, float(self._table.done_at[line]) - self._ahead, self._done)
        if done > self._done:
            self._done, self._ran_at = done, self._ran

    @property
    def share(self) -> float:
        """The share of the job's time that is over."""
        whole = self._ran + self.seconds
        return self._ran / whole if whole else 1.0

    @property
    def seconds(self) -> float:
        """The time left [s]."""
        slower = (self._ran_at + STEADY) / (self._done + STEADY)
        since = self._ran - self._ran_at
        return max(0.0, slower * (self._table.whole - self._done) - since)
