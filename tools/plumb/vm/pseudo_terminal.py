"""A virtual machine behind a pseudo terminal, which other programs open as a serial port."""

from __future__ import annotations

import contextlib
import os
import pty
import select
import time
import tty
from pathlib import Path

from plumb._vm import VirtualMachine
from plumb.text.errors import refusal
from plumb.vm.opening import OpeningWatch

BOOTLOADER = 1000  # [ms] in which a board that was reset swallows what comes
MOST_AT_ONCE = 20  # [ms] of the machine's time between two looks at the line
CHUNK = 4096


class PseudoTerminal:
    """The serial port of a virtual machine.

    Opening it resets the board, as the line DTR does on a Mega.
    """

    def __init__(self, machine: VirtualMachine, *, link: str | None = None) -> None:
        """`link`: a name for the port; InputError if something else has it."""
        self.machine = machine
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
        self.link = self._linked(link) if link else None

    def close(self) -> None:
        """Take the port away."""
        if self.link:
            self.link.unlink(missing_ok=True)
        self._openings.close()
        os.close(self._master)

    def pass_time(self, milliseconds: int) -> None:
        """Let the machine's time pass, and carry what is on the line both ways."""
        while milliseconds > 0:
            step = min(milliseconds, MOST_AT_ONCE)
            self._carry_in()
            self._boot(step)
            self.machine.advance(step)
            self._carry_out()
            milliseconds -= step

    def _linked(self, link: str) -> Path:
        path = Path(link)
        if path.is_symlink():
            path.unlink()
        try:
            path.symlink_to(self.path)
        except OSError as error:
            why = f"cannot be the name of the port ({error.strerror})"
            raise refusal(link, why, remedy="give another --link") from None
        return path

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
        if self._openings.count():
            self.machine.stop()
            self._booting = BOOTLOADER
        if not events & select.POLLIN:
            return
        with contextlib.suppress(OSError):
            came = os.read(self._master, CHUNK)
            if self._booting <= 0:
                self.machine.send(came)

    def _carry_out(self) -> None:
        said = self.machine.take_said()
        if said and self._is_open:
            # What nobody reads is lost, as on a wire.
            with contextlib.suppress(OSError):
                os.write(self._master, said)


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
