"""When a fault strikes: a story whose pauses are milliseconds, and the line that it runs along."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from math import ceil

from plumb.vm.garage import VirtualMachine
from plumb.vm.owner import MOMENT, InProcessPort

WAITING = 1  # [ms] between two looks of a story that waits for its moment


class LineLostError(Exception):
    """Nobody answers at the other end of the line any more."""


class Strike:
    """A story that begins at a time; it yields how long [ms] it pauses, or None while it waits for
    its moment."""

    def __init__(self, story: Iterator[float | None], at: float) -> None:
        """at [s] of the machine's time."""
        self._story, self._next = story, at
        self.struck_at: float | None = None  # [s]
        self.is_over = False

    def wait(self, now: float) -> int:
        """[ms] from a time until the story goes on, 1 at least."""
        return max(1, ceil((self._next - now) * 1000 - 1e-6))

    def look(self, now: float) -> None:
        """Go on with the story if its pause is over."""
        while not self.is_over and now >= self._next - 1e-9:
            try:
                pause = next(self._story)
            except StopIteration:
                self.is_over = True
                return
            if pause is not None and self.struck_at is None:
                self.struck_at = now
            self._next = now + (WAITING if pause is None else pause) / 1000


class Wire(InProcessPort):
    """A line along which time passes, and in which a fault may spoil what is sent next."""

    def __init__(self, machine: VirtualMachine) -> None:
        super().__init__(machine)
        self.spoil: Callable[[bytes], bytes] | None = None
        self.strike: Strike | None = None
        self.way = list[tuple[float, float, float]]()  # [s, mm, mm] of the sled, every MOMENT
        self.patience = float("inf")  # [s] until the operator gives up
        self.longest_silence = 0.0  # [s] of the machine
        self._heard_at = machine.seconds

    def write(self, characters: bytes) -> None:
        """Put characters on the line, spoilt or whole."""
        if self.spoil:
            characters, self.spoil = self.spoil(characters), None
        super().write(characters)

    def read(self) -> bytes:
        """Return what came in a moment; raises LineLostError if the machine does not run."""
        self.pass_time(MOMENT)
        if not self.machine.is_running or self.machine.seconds > self.patience:
            raise LineLostError
        said = self.machine.take_said()
        if said:
            self.longest_silence = max(self.longest_silence, self.machine.seconds - self._heard_at)
            self._heard_at = self.machine.seconds
        return said

    def pass_time(self, milliseconds: int) -> None:
        """Let time pass, and strike when it is time to."""
        while milliseconds > 0:
            step = milliseconds
            if self.strike and not self.strike.is_over:
                step = min(step, self.strike.wait(self.machine.seconds))
            self.machine.advance(step)
            milliseconds -= step
            if self.strike:
                self.strike.look(self.machine.seconds)
        self.way.append((self.machine.seconds, *self.machine.sled))
