"""Interface of a line to a machine, whether a board or a simulation hangs on it."""

import os
import re
import sys
import tempfile
import time
from contextlib import suppress
from pathlib import Path
from typing import Protocol

import serial
from serial.tools import list_ports

from plumb.text.errors import InputError, to_do
from plumb.text.files import NO_LINKS, close_to_others, hold


class LostError(InputError):
    """Nothing more comes over the line: a cable, its power, or a program that has it."""


class LinePort(Protocol):
    """Both ways of a serial line, and the time that passes on it."""

    def write(self, characters: bytes) -> None:
        """Put characters on the line."""

    def read(self) -> bytes:
        """Return what came since the last call; a moment passes first if that is nothing."""

    def seconds(self) -> float:
        """Return the time at the machine; only differences count."""

    def close(self) -> None:
        """Let go of the line."""


# The serial line of a board on USB, or of a virtual machine.

BAUD = 57600
PATIENCE = 0.1  # [s] that a read waits
CHUNK = 4096


class SerialPort:
    """An open line. Opening it resets the Mega."""

    def __init__(self, path: str) -> None:
        """Raise InputError if the line cannot be opened, or if another program has it."""
        self.path = path
        try:
            self._lock = LineLock(path)
        except TakenError:
            why, remedy = "another plumb has the line", "wait until it is done, or end it"
            raise InputError(path, why, remedy=remedy) from None
        try:
            self._line = serial.serial_for_url(path, BAUD, timeout=PATIENCE, exclusive=True)
        except serial.SerialException as error:
            self._lock.release()
            # Windows says PermissionError, and the rest in its own language.
            busy = any(word in str(error).lower() for word in ("busy", "lock", "permissionerror"))
            remedy = "close the program that has it" if busy else "check the cable and the name"
            raise InputError(path, "cannot be opened", remedy=remedy) from None
        refuse_others(path, self._line)

    def write(self, characters: bytes) -> None:
        """Put characters on the line."""
        try:
            self._line.write(characters)
        except serial.SerialException:
            raise self._lost() from None

    def read(self) -> bytes:
        """Return what came; waits a moment if nothing did."""
        try:
            came: bytes = self._line.read(max(1, self._line.in_waiting))
            if came and self.path.startswith("socket:"):  # pyserial counts but one there
                self._line.timeout = 0
                came += self._line.read(CHUNK)
                self._line.timeout = PATIENCE
        except (serial.SerialException, OSError):
            raise self._lost() from None
        return came

    def seconds(self) -> float:
        """Return the time of this computer."""
        return time.monotonic()

    def close(self) -> None:
        """Let go of the line."""
        self._line.close()
        self._lock.release()

    def _lost(self) -> LostError:
        return LostError(str(InputError(self.path, "the line was lost", remedy="check the cable")))


def port_for(path: str | None) -> str:
    """Return the line that was named, else that of the only board on USB; InputError if there is
    none.
    """
    if path:
        return path
    boards = [port for port in list_ports.comports() if port.vid is not None]
    if len(boards) == 1:
        return str(boards[0].device)
    if not boards:
        name = to_do("name its line with --port", page="type its port")
        raise InputError("no board on USB: connect the Mega, or " + name)
    names = ", ".join(str(port.device) for port in boards)
    choose = to_do("name one with --port", page="choose its port")
    raise InputError(f"several boards on USB ({names}): " + choose)


# A serial line that a single program has: others are refused before they touch it.
#
# Opening the line resets the board, so a program that comes second must not open it at all.

PSEUDO = "/dev/pts/"  # how lines begin that are no wires


class TakenError(Exception):
    """Another program has the line."""


class LineLock:
    """A lock on a file named after the line. The kernel releases it when its program ends."""

    def __init__(self, path: str) -> None:
        """Raise TakenError if another program of the lab has the line."""
        self._handle: int | None = None
        with suppress(OSError):
            self._handle = _opened(_lock_file(path))
        if self._handle is None:
            return  # of another user, who may have left it: the kernel refuses what is open
        try:
            hold(self._handle, wait=False)
        except OSError:
            self.release()
            raise TakenError from None

    def release(self) -> None:
        """Let others take the line."""
        if self._handle is not None:
            os.close(self._handle)
            self._handle = None


def refuse_others(path: str, line: serial.SerialBase) -> None:
    """Have the kernel refuse to open the line again, except for root; Windows does so by itself."""
    # A pseudo terminal would refuse on, even when the program that had it was killed.
    if sys.platform != "win32" and not os.path.realpath(path).startswith(PSEUDO):
        close_to_others(line.fileno())


def _lock_file(path: str) -> Path:
    """Return the file that stands for the line, by whichever name it is opened."""
    name = re.sub(r"\W+", "-", os.path.realpath(path)).strip("-")
    return Path(tempfile.gettempdir()) / f"plumb-line-{name}.lock"


def _opened(file: Path) -> int:
    """Return a handle of the file, made if it is not there; a lock needs no right to write."""
    try:
        return os.open(file, os.O_RDONLY | os.O_CREAT | NO_LINKS, 0o644)
    except PermissionError:
        return os.open(file, os.O_RDONLY | NO_LINKS)
