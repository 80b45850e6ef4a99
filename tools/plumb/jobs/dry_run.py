"""A program run dry: the firmware itself reads and plans it, and simulates its motors (B99)."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from plumb._dry_run import COLUMNS, DryRun, pieces
from plumb.firmware.numbers import CLIENT_NUMBERS, firmware_numbers
from plumb.jobs.moves import Moves
from plumb.line.sender import PlainError, plain
from plumb.model.predict import FOUND, lengths
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

__all__ = ["COLUMNS", "Done", "Refused", "Run", "pieces"]

AT_ONCE = 2000  # lines between two looks at how far it is
GOES_ON = 70  # $70: a line that would halt the machine is refused, and the next is done
SIMULATED = "B99 ON"
Share = Callable[[float], None]


@dataclass(frozen=True)
class Refused:
    """A line that no client can send."""

    line: int
    why: str


@dataclass(frozen=True)
class Done:
    """What the machine did with a program."""

    moves: Moves
    said: tuple[tuple[int, str], ...]  # line (counted from 1) and what the machine said to it
    refused: tuple[Refused, ...]
    seconds: float
    halted_at: int | None  # the line at which an alarm stopped it


class Run:
    """A machine with these settings, placed where it stands, that runs a program dry."""

    def __init__(
        self,
        settings: MachineSettings,
        *,
        start: tuple[float, float, float] = (0.0, 0.0, 0.0),
        numbers: Mapping[int, float] | None = None,
    ) -> None:
        """start [mm] of the bit; numbers of the firmware that the settings do not hold."""
        model = settings.as_plumb_model()
        chains, outcome = lengths(model, np.array([start[:2]]))
        if outcome[0] != FOUND:
            where = f"X{start[0]:g} Y{start[1]:g}"
            raise InputError(f"no sled can hang at {where}, where it is to begin")
        self._machine = DryRun()
        self._numbers: list[int] = []  # of the lines that were sent, as the file counts them
        self._refused: list[Refused] = []
        given = {**CLIENT_NUMBERS, **(numbers or {}), GOES_ON: 1}
        lines = [f"${number}={value:g}" for number, value in given.items()]
        lines += [number.line for number in firmware_numbers(model)]
        left, right = chains[0]
        lines += [SIMULATED, f"B06 L{left:.4f} R{right:.4f}", f"G10 Z{start[2]:.4f}"]
        self._machine.send(lines)
        self._refuse_what_was_said(lines)
        self._setup = len(lines)
        self._begun = self._machine.seconds

    def _refuse_what_was_said(self, lines: Sequence[str]) -> None:
        for number, text in self._machine.said():
            if text.startswith(("error:", "ALARM")):
                raise InputError(f"the firmware refuses {lines[number]!r}: {text}")

    def send(self, lines: Sequence[str], *, first: int = 1, progress: Share | None = None) -> None:
        """Send lines of a file; `first` is the number of the first."""
        for begin in range(0, len(lines), AT_ONCE):
            sent = []
            for number, line in enumerate(lines[begin : begin + AT_ONCE], start=first + begin):
                try:
                    text = plain(line)
                except PlainError as error:
                    self._refused.append(Refused(number, str(error)))
                    continue
                if text:
                    sent.append(text)
                    self._numbers.append(number)
            self._machine.send(sent)
            if progress:
                progress(min(1.0, (begin + AT_ONCE) / len(lines)))

    def finish(self) -> Done:
        """Let the moves end; everything that was done."""
        self._machine.drain()
        machine = self._machine
        # The line in execution at an alarm has no answer.
        numbers = np.array([*self._numbers, self._numbers[-1] if self._numbers else 1])
        rows = machine.moves()
        of_program = rows[:, 0] >= self._setup
        rows = rows[of_program]
        rows[:, 0] = numbers[rows[:, 0].astype(int) - self._setup]
        rows[:, COLUMNS.index("ends")] -= self._begun
        said = tuple(
            (int(numbers[line - self._setup]), text)
            for line, text in machine.said()
            if line >= self._setup
        )
        halted = int(numbers[machine.answered - self._setup]) if machine.is_halted else None
        seconds = machine.seconds - self._begun
        return Done(Moves(rows), said, tuple(self._refused), seconds, halted)

    @property
    def modes(self) -> dict[str, float]:
        """The modes with which the next line is read."""
        return self._machine.modes()

    @property
    def place(self) -> tuple[float, float, float]:
        """Where the program believes the bit to be at the end of all moves so far [mm]."""
        x, y, z = self._machine.place()
        return x, y, z

    @property
    def origin(self) -> tuple[float, float, float]:
        """Where the program's coordinates begin [mm]."""
        x, y, z = self._machine.origin()
        return x, y, z
