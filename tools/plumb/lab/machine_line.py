"""The machine that the lab is connected to: a board, or a virtual machine in this program."""

import os
import re
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager
from dataclasses import dataclass
from threading import Lock
from typing import Annotated, TypeVar

from fastapi import Depends
from serial.tools import list_ports
from starlette.requests import HTTPConnection

from plumb.firmware.settings import (
    MACHINE,
    Difference,
    both_values,
    differences,
    digest_of_numbers,
    refuse_other_numbers,
    refuse_other_origin,
)
from plumb.fit.inputs import settings_in
from plumb.lab.project import Project
from plumb.lab.rounds import opened, settings_of
from plumb.line.bootloader import hex_file, write_program
from plumb.line.port import SerialPort
from plumb.line.sender import Sender, StoppedError
from plumb.line.worker import LineState, LineWorker
from plumb.settings import MachineSettings
from plumb.text.errors import InputError
from plumb.vm.garage import PacedPort, VirtualOwner, set_up

Result = TypeVar("Result")
PATIENCE = 60.0  # [s] for an answer of the machine
# What may be opened as a serial line: never a file.
PORT = re.compile(
    r"/dev/(tty[\w.-]+|cu\.[\w.-]+|rfcomm\d+|pts/\d+|serial/by-id/[\w.:-]+)|COM\d+|socket://localhost:\d+"
)


@dataclass(frozen=True)
class Port:
    """A serial port of this computer."""

    path: str
    title: str
    is_board: bool  # on USB, so it may be a machine


def ports() -> list[Port]:
    """Return the serial ports, those on USB first."""
    each = [
        Port(port.device, port.description or port.device, port.vid is not None)
        for port in list_ports.comports()
    ]
    return sorted(each, key=lambda port: (not port.is_board, port.path))


def _port_at(path: str) -> str:
    """Return the serial port of this name, or that a link of this name leads to."""
    port = os.path.realpath(path) if os.path.islink(path) else path
    if not PORT.fullmatch(port) or ".." in port:
        raise InputError(f"{path!r} is not a serial port: choose one, or type a name like COM3")
    return port


class MachineLine:
    """A line at most, which all tabs share."""

    def __init__(self) -> None:
        self._lock = Lock()
        self._worker: LineWorker | None = None
        self._before: LineWorker | None = None  # that may still have its line
        self.name = ""  # of what is connected
        self.virtual: VirtualOwner | None = None  # what hangs on the line, if it is virtual
        self._port: PacedPort | None = None
        self.written: float | None = None  # share of our firmware, while it is written

    @property
    def state(self) -> LineState:
        """The state of the line and the machine."""
        worker = self._worker
        return worker.state if worker else LineState()

    @property
    def subject(self) -> str:
        """What the machine is called where a sentence begins."""
        return "The virtual machine" if self.virtual else "The machine"

    @property
    def silence(self) -> float:
        """The time since a board last reported [s]; 0 where no report is due."""
        worker = self._worker
        return worker.silence if worker and not self.virtual else 0.0

    def connect_board(self, path: str, *, first: Callable[[str], None] = lambda port: None) -> None:
        """Connect the board at a serial port, or at a link to a port; `first` is done at the port
        before. Raises InputError for what is no port.
        """
        port = _port_at(path)
        with self._lock:
            same, was = path == self.name, self._let_go()
            self.name, self.virtual, self._port = path, None, None
            # A board that was lost may come back at another port.
            knows_place = was.knows_place or not (same or was.phase == "lost")
            before = self._before

            def opened() -> SerialPort:
                if before:
                    before.await_end()
                first(port)
                return SerialPort(port)

            self._worker = LineWorker(opened, knows_place=knows_place)

    def flash(self) -> None:
        """Write our firmware to the board, then connect it again. Raises InputError."""
        file, state = hex_file(), self.worker.state
        if state.phase not in ("ready", "lost") or state.moves:
            raise InputError("the machine moves: wait until it stands")

        def progress(share: float) -> None:
            self.written = share

        def write(port: str) -> None:
            progress(0.0)
            try:
                write_program(port, file, progress)
            finally:
                self.written = None

        self.connect_board(self.name, first=write)

    def connect_virtual(self, owner: VirtualOwner, *, speed: float) -> None:
        """Switch on a virtual machine and connect it. Its time runs `speed` times as fast at
        work."""

        def opened() -> PacedPort:
            set_up(port, owner.settings)
            return port

        with self._lock:
            self._let_go()
            port = PacedPort(owner.machine, speed=speed)
            self.name, self.virtual, self._port = "virtual machine", owner, port
            self._worker = LineWorker(opened, working=lambda works: setattr(port, "works", works))

    def disconnect(self) -> None:
        """Let go of the line; a machine that moves is stopped."""
        with self._lock:
            self._let_go()
            self._worker, self.virtual, self._port, self.name = None, None, None, ""

    def do(self, work: Callable[[Sender], Result]) -> Result:
        """Return what a piece of work with the machine brings. Raises InputError if it cannot be
        done.
        """
        try:
            return self.worker.do(work).result(PATIENCE)
        except StoppedError:
            raise InputError("Stop was pressed; the machine has stopped") from None
        except TimeoutError:
            raise InputError(f"the machine did not do it in {PATIENCE:.0f} s: look at it") from None

    def read_numbers(self) -> Mapping[int, float]:
        """Return all numbers that the machine lists now. Raises InputError."""
        self.do(self.worker.read_numbers)
        return self.state.numbers

    @contextmanager
    def resting(self) -> Iterator[None]:
        """Let a virtual machine rest in the middle of work while a person thinks."""
        port = self._port
        if port:
            port.works = False
        try:
            yield
        finally:
            if port:
                port.works = True

    @property
    def worker(self) -> LineWorker:
        """The worker that has the line. Raises InputError if no machine is connected."""
        worker = self._worker
        if worker is None:
            raise InputError("no machine is connected: connect it first")
        return worker

    def _let_go(self) -> LineState:
        """Close the line; how it was."""
        if self._worker is None:
            return LineState()
        was = self._worker.state
        self._worker.close()
        self._before = self._worker
        return was


def line_of(connection: HTTPConnection) -> MachineLine:
    """Return the line of this server."""
    line = connection.app.state.line
    assert isinstance(line, MachineLine)
    return line


async def _line(connection: HTTPConnection) -> MachineLine:
    """Return the same without a thread, so that Stop never waits for one."""
    return line_of(connection)


TheLine = Annotated[MachineLine, Depends(_line)]


# What the connected machine holds against what is open in the folder: never two machines in one
# fit.


def held_otherwise(project: Project, line: MachineLine) -> tuple[Difference, ...]:
    """Return what the open settings and the connected machine say otherwise, as far as both are
    known.
    """
    settings = settings_of(project, project.choices)
    return differences(settings, line.state.numbers) if settings and line.state.numbers else ()


def is_fit_of_machine(project: Project, line: MachineLine) -> bool:
    """Return whether the open settings were fitted to marks of the machine as it is: they go into
    it next.
    """
    settings = settings_of(project, project.choices)
    boards = settings.fitted.boards if settings and settings.fitted else ()
    return any(not differences(board.cut_with, line.state.numbers) for board in boards)


def refuse_unknown_place(line: MachineLine) -> None:
    """Raise InputError while the machine does not know where its sled is."""
    if not line.state.knows_place:
        raise InputError("where the sled is, is not known: set its chains first")


def refuse_other_machine(
    project: Project, line: MachineLine, cut_with: MachineSettings | None
) -> None:
    """InputError unless the machine, asked now, holds the numbers that its next marks name: those
    of the open settings, or of their form."""
    settings = opened(project)
    file = cut_with.file.name if cut_with and cut_with.file else project.choices.settings
    refuse_other_numbers(cut_with or settings, line.read_numbers(), file=file)


def refuse_unanswered(project: Project, line: MachineLine) -> None:
    """InputError while another machine is connected than is open: a correction would begin
    at other numbers than it holds."""
    others = held_otherwise(project, line)
    if others and not is_fit_of_machine(project, line):
        file = project.choices.settings
        both = both_values(others, file, MACHINE)
        raise InputError(f"{both}. Which holds? Answer the question above, or disconnect")


def refuse_foreign_fit(project: Project, line: MachineLine, file: str, *, replaces: str) -> None:
    """InputError if a file was fitted to marks of another machine than is connected.

    `replaces` is the digest of the numbers that the owner gave up for those of the file.
    """
    held = line.read_numbers()
    if not replaces:
        refuse_other_origin(settings_in(project.path(file)), held, file=file)
    elif replaces != digest_of_numbers(held):
        raise InputError("the machine holds other numbers by now: look at them again")
