"""A virtual machine at a serial port, in a thread of the test.

It keeps what the judge sees, and each byte that passed.
"""

import re
import threading
import time
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field

from plumb.hidden import MAKER
from plumb.vm.pseudo_terminal import PseudoTerminal
from plumb.vm.served_port import Pace
from usual_machine import declaration, switched_on, usual_machine

SPEED = 2  # times real time
PATIENCE = 900.0  # [s] of this computer, which may have a tenth of its time for the machine
AT_ONCE = re.compile(rb"[?!~\x18\x80-\xff]")  # characters that are no part of a line
KEPT = 10_000  # [ms] after which the place is in the memory
STANDS = 0.05  # [mm] in a second of a machine that does not move


def until(true: Callable[[], object], why: str) -> None:
    """Wait until something is true, on a slow and busy computer too."""
    end = time.monotonic() + PATIENCE
    while not true():
        assert time.monotonic() < end, f"not within {PATIENCE:g} s: {why}"
        time.sleep(0.02)


@dataclass(frozen=True)
class Shown:
    """The machine as the sender shows it."""

    state: str  # Idle, Run, Jog, Hold, Alarm, Check
    place: tuple[float, float, float]  # [mm] of the machine
    work: tuple[float, float, float]  # [mm] in the work's coordinates
    feed: float  # [mm/min] that it makes
    overrides: tuple[int, int, int]  # [%] feed, rapids, spindle


@dataclass
class Tap:
    """The machine's line, with a listener."""

    machine: object
    sent: bytearray = field(default_factory=bytearray)  # by the sender
    said: bytearray = field(default_factory=bytearray)  # by the machine
    passed: list[tuple[float, str, bytes]] = field(default_factory=list)  # [s], direction, bytes

    def __getattr__(self, name: str):
        return getattr(self.machine, name)

    def send(self, characters: bytes) -> None:
        """Hand on what the sender sends."""
        self.sent += characters
        self.passed.append((self.machine.seconds, ">", bytes(characters)))
        self.machine.send(characters)

    def take_said(self) -> bytes:
        """Hand on what the machine says."""
        said = self.machine.take_said()
        self.said += said
        if said:
            self.passed.append((self.machine.seconds, "<", bytes(said)))
        return said

    def ahead(self) -> list[tuple[float, int]]:
        """Return how many characters of lines without an answer were on the way, from when on
        [s].
        """
        lines, answers, lengths = b"", b"", deque()
        course = []
        for seconds, direction, came in list(self.passed):
            if direction == ">":
                *whole, lines = (lines + AT_ONCE.sub(b"", came)).split(b"\n")
                lengths.extend(len(line) + 1 for line in whole)
            else:
                *whole, answers = (answers + came).split(b"\n")
                for line in whole:
                    if line.startswith((b"ok", b"error")) and lengths:
                        lengths.popleft()
            course.append((seconds, sum(lengths)))
        return course


class Board:
    """A machine with numbers and chains, its bit in the middle of the sheet, at a port."""

    def __init__(self, elf: str | None):
        machine = usual_machine(elf=elf)
        sender = switched_on(machine, MAKER)
        sender.stream([declaration(machine)])
        machine.advance(KEPT)
        machine.take_said()
        self.tap = Tap(machine)
        self.terminal = PseudoTerminal(self.tap)
        self.port = self.terminal.path
        self.sled, self.seconds = machine.sled, machine.seconds
        self._ended = threading.Event()
        self._thread = threading.Thread(target=self._serve)
        self._thread.start()

    def _serve(self) -> None:
        pace = Pace(SPEED)
        while not self._ended.is_set():
            self.terminal.pass_time(pace.due())
            self.sled, self.seconds = self.tap.machine.sled, self.tap.machine.seconds
        self.terminal.close()

    def end(self) -> None:
        """Take the machine away."""
        self._ended.set()
        self._thread.join()

    def wait(self, seconds: float) -> None:
        """Let so much [s] of the machine's time pass."""
        end = self.seconds + seconds
        until(lambda: self.seconds >= end, "the machine's time passes")

    def moved(self, seconds: float = 1.0) -> float:
        """[mm] How far the sled goes in this time [s]."""
        x, y = self.sled
        self.wait(seconds)
        return abs(self.sled[0] - x) + abs(self.sled[1] - y)

    def rest(self) -> tuple[float, float]:
        """[mm] Where the sled is when it stands."""
        until(lambda: self.moved() < STANDS, "the sled stands")
        return self.sled
