"""A line to a virtual machine in the same program, whose time runs with this computer's."""

from __future__ import annotations

import time

from plumb._vm import VirtualMachine
from plumb.vm.in_process import MOMENT, InProcessPort

SLEEP = 0.002  # [s] shorter waits are saved up


class PacedPort(InProcessPort):
    """The serial line of a virtual machine: real time at rest, `speed` times as fast at work."""

    def __init__(self, machine: VirtualMachine, *, speed: float) -> None:
        super().__init__(machine)
        self.speed = speed
        self.works = False
        self._due = time.monotonic()

    def read(self) -> bytes:
        """What came in a moment of the machine's time."""
        said = super().read()
        self._due += MOMENT / 1000 / (self.speed if self.works else 1.0)
        now = time.monotonic()
        if self._due - now > SLEEP:
            time.sleep(self._due - now)
        # A computer that is too slow falls behind; it never hurries afterwards.
        self._due = max(self._due, now)
        return said
