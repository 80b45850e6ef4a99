"""What a line to a machine must be able to do, whether a board or a simulation hangs on it."""

from __future__ import annotations

from typing import Protocol

from plumb.text.errors import InputError


class LostError(InputError):
    """Nothing more comes over the line: a cable, its power, or a program that has it."""


class Port(Protocol):
    """Both ways of a serial line, and the time that passes on it."""

    def write(self, characters: bytes) -> None:
        """Put characters on the line."""

    def read(self) -> bytes:
        """What came since the last call; a moment passes first if that is nothing."""

    def seconds(self) -> float:
        """The time at the machine; only differences count."""

    def close(self) -> None:
        """Let go of the line."""
