"""The serial line of a board on USB, or of a virtual machine."""

from __future__ import annotations

import time

import serial
from serial.tools import list_ports

from plumb.line.line_lock import LineLock, TakenError, refuse_others
from plumb.line.port import LostError
from plumb.text.errors import InputError, refusal
from plumb.text.readers import to_do

BAUD = 57600
PATIENCE = 0.1  # [s] that a read waits


class SerialPort:
    """An open line. Opening it resets the Mega."""

    def __init__(self, path: str) -> None:
        """Raises InputError if the line cannot be opened, or if another program has it."""
        self.path = path
        try:
            self._lock = LineLock(path)
        except TakenError:
            why, remedy = "another plumb has the line", "wait until it is done, or end it"
            raise refusal(path, why, remedy=remedy) from None
        try:
            self._line = serial.Serial(path, BAUD, timeout=PATIENCE, exclusive=True)
        except serial.SerialException as error:
            self._lock.release()
            busy = "busy" in str(error).lower() or "lock" in str(error).lower()
            remedy = "close the program that has it" if busy else "check the cable and the name"
            raise refusal(path, "cannot be opened", remedy=remedy) from None
        refuse_others(path, self._line.fileno())

    def write(self, characters: bytes) -> None:
        """Put characters on the line."""
        try:
            self._line.write(characters)
        except serial.SerialException:
            raise self._lost() from None

    def read(self) -> bytes:
        """What came; waits a moment if nothing did."""
        try:
            came: bytes = self._line.read(max(1, self._line.in_waiting))
        except (serial.SerialException, OSError):
            raise self._lost() from None
        return came

    def seconds(self) -> float:
        """The time of this computer."""
        return time.monotonic()

    def close(self) -> None:
        """Let go of the line."""
        self._line.close()
        self._lock.release()

    def _lost(self) -> LostError:
        return LostError(str(refusal(self.path, "the line was lost", remedy="check the cable")))


def port_for(path: str | None) -> str:
    """The line that was named, else that of the only board on USB; InputError if there is none."""
    if path:
        return path
    boards = [port for port in list_ports.comports() if port.vid is not None]
    if len(boards) == 1:
        return str(boards[0].device)
    if not boards:
        name = to_do("name its line with --port", page="type its port")
        raise InputError(f"no board on USB: connect the Mega, or {name}")
    names = ", ".join(str(port.device) for port in boards)
    choose = to_do("name one with --port", page="choose its port")
    raise InputError(f"several boards on USB ({names}): {choose}")
