"""The serial port of a virtual machine, whatever the other program opens to reach it."""

import contextlib
import re
import socket
import time
from abc import ABC, abstractmethod
from pathlib import Path

from plumb._vm import VirtualMachine
from plumb.text.errors import InputError

BOOTLOADER = 1000  # [ms] in which a board that was reset swallows what comes
MOST_AT_ONCE = 20  # [ms] of the machine's time between two looks at the line
CHUNK = 4096


class ServedPort(ABC):
    """Carries characters both ways between a machine and who opened its port.

    Opening it resets the board, as the line DTR does on a Mega.
    """

    path: str  # what a client opens
    link: Path | None = None  # its other name

    def __init__(self, machine: VirtualMachine, *, boot_time: int = BOOTLOADER) -> None:
        """boot_time [ms]: 0 for a machine with a bootloader of its own."""
        self.machine, self.boot_time = machine, boot_time
        self._booting = 0
        self._lines = WholeLines()
        self._waiting = b""  # what the machine said and the client has no room for yet

    @abstractmethod
    def close(self) -> None:
        """Take the port away."""

    @abstractmethod
    def _is_open(self) -> bool:
        """Whether a program is at the other end."""

    @abstractmethod
    def _was_opened(self) -> bool:
        """Whether a program opened the port since the last call."""

    @abstractmethod
    def _take(self) -> bytes:
        """Return what came; empty if nothing did."""

    @abstractmethod
    def _give(self, said: bytes) -> bytes:
        """Hand over what the client has room for, and return the rest."""

    def pass_time(self, milliseconds: int) -> None:
        """Let the machine's time pass, and carry what is on the line both ways.

        It stands still while a program has the port open and has not taken what was said: a
        program on a busy computer would lose lines that no wire loses.
        """
        while milliseconds > 0:
            step = min(milliseconds, MOST_AT_ONCE)
            self._reset_if_opened()
            came = self._take()
            if came and self._booting <= 0:
                self.machine.send(came)
            self._hand_over()
            if self._waiting:
                return
            self._boot(step)
            self.machine.advance(step)
            self._waiting = self._lines.take(self.machine.take_said(), step)
            self._hand_over()
            milliseconds -= step

    def _boot(self, step: int) -> None:
        """Count the bootloader's time down, then start the program."""
        if self._booting <= 0:
            return
        self._booting -= step
        if self._booting <= 0:
            self.machine.start()

    def _reset_if_opened(self) -> None:
        if not self._was_opened():
            return
        self.machine.stop()
        # Who opened the port hears nothing that was said before.
        self._lines, self._waiting = WholeLines(), b""
        self._booting = self.boot_time
        if not self.boot_time:
            self.machine.start()

    def _hand_over(self) -> None:
        if not self._waiting:
            return
        # The machine's time took a while, in which a client may have opened or left the port.
        self._reset_if_opened()
        # Unread characters are lost, as on a wire.
        self._waiting = self._give(self._waiting) if self._is_open() else b""


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


# A virtual machine behind a socket, for systems without pseudo terminals.
#
# plumb, and what else opens ports with pyserial, takes its name: socket://localhost:7000.


NAME = re.compile(r"socket://(localhost|127\.0\.0\.1):(\d{1,5})")
ANY = "socket://localhost:0"  # a number that is free


class SocketPort(ServedPort):
    """A socket of this computer alone as the port. A new connection ends the one before."""

    def __init__(
        self, machine: VirtualMachine, name: str = ANY, *, boot_time: int = BOOTLOADER
    ) -> None:
        """boot_time [ms]: 0 for a machine with a bootloader of its own.

        Raises InputError for a name of another kind, or one that is taken.
        """
        super().__init__(machine, boot_time=boot_time)
        parts = NAME.fullmatch(name)
        if not parts or int(parts[2]) > 65535:
            raise InputError(name, "is not like socket://localhost:7000", remedy="write it so")
        try:
            self._listener = socket.create_server(("127.0.0.1", int(parts[2])))
        except OSError:
            why = "a virtual machine is at it already"
            raise InputError(name, why, remedy="end it or give another number") from None
        self._listener.setblocking(False)
        self._client: socket.socket | None = None
        self.path = f"socket://localhost:{self._listener.getsockname()[1]}"

    def close(self) -> None:
        """Take the port away."""
        self._leave()
        self._listener.close()

    def _leave(self) -> None:
        if self._client:
            self._client.close()
            self._client = None

    def _is_open(self) -> bool:
        return self._client is not None

    def _was_opened(self) -> bool:
        try:
            client, _ = self._listener.accept()
        except OSError:  # nobody came
            return False
        self._leave()
        client.setblocking(False)
        client.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        self._client = client
        return True

    def _take(self) -> bytes:
        if self._client:
            try:
                came = self._client.recv(CHUNK)
            except BlockingIOError:
                return b""
            except OSError:
                came = b""
            if came:
                return came
            self._leave()
        return b""

    def _give(self, said: bytes) -> bytes:
        if self._client:
            with contextlib.suppress(BlockingIOError):
                try:
                    return said[self._client.send(said) :]
                except ConnectionError:
                    self._leave()
        return said
