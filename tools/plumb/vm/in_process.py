"""A line to a virtual machine in the same program: no waiting, its time runs as fast as it can."""

from __future__ import annotations

from plumb._vm import VirtualMachine

MOMENT = 50  # [ms] that pass while somebody listens


class InProcessPort:
    """The serial line of a virtual machine that runs."""

    def __init__(self, machine: VirtualMachine) -> None:
        self.machine = machine

    def write(self, characters: bytes) -> None:
        """Put characters on the line."""
        self.machine.send(characters)

    def read(self) -> bytes:
        """What came in a moment of the machine's time."""
        self.machine.advance(MOMENT)
        return self.machine.take_said()

    def seconds(self) -> float:
        """The machine's time."""
        return self.machine.seconds

    def close(self) -> None:
        """Nothing to let go of."""
