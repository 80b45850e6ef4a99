"""A virtual machine behind a pseudo terminal, which other programs open as a serial port."""

import contextlib
import ctypes
import os
import pty
import select
import struct
import time
import tty
from pathlib import Path

import plumb._vm
from plumb._vm import VirtualMachine
from plumb.line.port import PSEUDO, LineLock, TakenError
from plumb.text.errors import InputError

BOOTLOADER = 1000  # [ms] in which a board that was reset swallows what comes
MOST_AT_ONCE = 20  # [ms] of the machine's time between two looks at the line
CHUNK = 4096


def preload() -> str:
    """Return the library that lets a client treat a pseudo terminal as a serial port.

    InputError where it was not built.
    """
    library = Path(plumb._vm.__file__).with_name("serial_port.so")
    if not library.exists():
        raise InputError(str(library), "was not built", remedy="it is for Linux only")
    return str(library)


class PseudoTerminal:
    """The serial port of a virtual machine.

    Opening it resets the board, as the line DTR does on a Mega.
    """

    def __init__(self, machine: VirtualMachine, *, boot_time: int = BOOTLOADER) -> None:
        """boot_time [ms]: 0 for a machine with a bootloader of its own."""
        self.machine, self.boot_time = machine, boot_time
        self._master, slave = pty.openpty()
        tty.setraw(slave)
        self.path = os.ttyname(slave)
        # Without a program at the other end the master hangs up; so an opening shows.
        os.close(slave)
        os.set_blocking(self._master, False)
        self._poll = select.poll()
        self._poll.register(self._master, select.POLLIN)
        self._openings = OpeningWatch(self.path)
        self._is_open = False
        self._booting = 0
        self._lines = WholeLines()
        self._waiting = b""  # what the machine said and the client has no room for yet
        self.link: Path | None = None
        self._name: LineLock | None = None  # held as long as the machine has its name

    def close(self) -> None:
        """Take the port away."""
        if self.link and _leads_to(self.link) == self.path:
            self.link.unlink()
        self._openings.close()
        os.close(self._master)
        if self._name:
            self._name.release()

    def pass_time(self, milliseconds: int) -> None:
        """Let the machine's time pass, and carry what is on the line both ways.

        It stands still while a program has the port open and has not taken what was said: a
        program on a busy computer would lose lines that no wire loses.
        """
        while milliseconds > 0:
            step = min(milliseconds, MOST_AT_ONCE)
            self._carry_in()
            self._hand_over()
            if self._waiting:
                return
            self._boot(step)
            self.machine.advance(step)
            self._waiting = self._lines.take(self.machine.take_said(), step)
            self._hand_over()
            milliseconds -= step

    def link_as(self, link: str) -> None:
        """Give the port a name; InputError if something else has it."""
        path = Path(link)
        if path.exists() and not _leads_to(path).startswith(PSEUDO):
            raise InputError(link, "is the name of something else", remedy="give another --link")
        try:
            # The kernel may have given a killed machine's number to another: the name counts.
            self._name = LineLock(f"{path.parent.resolve() / path.name}-machine")
        except TakenError:
            why = "a virtual machine is at it already"
            raise InputError(link, why, remedy="end it or give another --link") from None
        try:
            if path.is_symlink():
                path.unlink()
            path.symlink_to(self.path)
        except OSError as error:
            self._name.release()
            why = f"cannot be the name of the port ({error.strerror})"
            raise InputError(link, why, remedy="give another --link") from None
        self.link = path

    def _boot(self, step: int) -> None:
        """Count the bootloader's time down, then start the program."""
        if self._booting <= 0:
            return
        self._booting -= step
        if self._booting <= 0:
            self.machine.start()

    def _carry_in(self) -> None:
        events = dict(self._poll.poll(0)).get(self._master, 0)
        self._is_open = not events & select.POLLHUP
        self._reset_if_opened()
        if not events & select.POLLIN:
            return
        with contextlib.suppress(OSError):
            came = os.read(self._master, CHUNK)
            if self._booting <= 0:
                self.machine.send(came)

    def _reset_if_opened(self) -> None:
        if not self._openings.count():
            return
        self.machine.stop()
        # Who opened the port hears nothing that was said before.
        self._lines, self._waiting = WholeLines(), b""
        self._booting = self.boot_time
        if not self.boot_time:
            self.machine.start()

    def _hand_over(self) -> None:
        """Give the client what it has room for."""
        if not self._waiting:
            return
        # The machine's time took a while, in which a client may have opened or left the port.
        self._reset_if_opened()
        if not self._is_open:
            self._waiting = b""  # unread characters are lost, as on a wire
        with contextlib.suppress(OSError):
            self._waiting = self._waiting[os.write(self._master, self._waiting) :]


def _leads_to(link: Path) -> str:
    """Return where a link leads; empty if it is none."""
    return os.readlink(link) if link.is_symlink() else ""


class Pace:
    """Holds a machine to a multiple of real time."""

    def __init__(self, speed: float) -> None:
        self.speed = speed
        self._last = time.monotonic()
        self._owed = 0.0  # [ms]

    def due(self) -> int:
        """[ms] of the machine's time that are due; waits until there are some."""
        while True:
            now = time.monotonic()
            self._owed += (now - self._last) * 1000 * self.speed
            self._last = now
            if self._owed >= 1:
                # A computer that is too slow falls behind; it never hurries afterwards.
                whole = min(int(self._owed), int(MOST_AT_ONCE * max(1.0, self.speed)))
                self._owed = min(self._owed - whole, 1.0)
                return whole
            time.sleep(0.002)


# Notices each time that a program opens a file, however soon it closes it again.

OPENED = 0x20  # IN_OPEN of Linux's inotify
HEAD = struct.Struct("iIII")  # watch, mask, cookie, length of the name


class OpeningWatch:
    """Counts openings by Linux's inotify; Python itself has no door to it."""

    def __init__(self, path: str) -> None:
        """Raise OSError where the system has no inotify."""
        self._libc = ctypes.CDLL(None, use_errno=True)
        try:
            self._handle = self._libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        except AttributeError:
            raise OSError("this system has no inotify") from None
        if (
            self._handle < 0
            or self._libc.inotify_add_watch(self._handle, os.fsencode(path), OPENED) < 0
        ):
            raise OSError(ctypes.get_errno(), f"{path} cannot be watched")

    def count(self) -> int:
        """Return how often it was opened since the last call."""
        opened = 0
        with contextlib.suppress(BlockingIOError):
            while True:
                events, at = os.read(self._handle, 4096), 0
                while at < len(events):
                    _, mask, _, length = HEAD.unpack_from(events, at)
                    opened += bool(mask & OPENED)
                    at += HEAD.size + length
        return opened

    def close(self) -> None:
        """Look away."""
        os.close(self._handle)


# What a virtual machine says, handed over in whole lines.
#
# A serial client takes what it read within a quarter of a second for a line. A board's bytes
# follow each other by fractions of a millisecond. A computer that is busy can stop a program for
# longer, in the middle of a line, and a client would take the half for the whole.

LONGEST_PAUSE = 20  # [ms] of the machine's time; then what it said was no line


class WholeLines:
    """Holds the begin of a line until its end has come."""

    def __init__(self) -> None:
        self._begun = b""
        self._since = 0  # [ms] since its last byte

    def take(self, said: bytes, milliseconds: int) -> bytes:
        """Return what can go to the client.

        `said`: what the machine said in the `milliseconds` of its time that just passed.
        """
        whole, end, begun = (self._begun + said).rpartition(b"\n")
        self._since = 0 if said else self._since + milliseconds
        if self._since >= LONGEST_PAUSE:
            self._begun, self._since = b"", 0
            return whole + end + begun
        self._begun = begun
        return whole + end
