"""How far a program is on its way to the machine."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal

from plumb.line.waits import Wait


@dataclass(frozen=True)
class Progress:
    """A program on its way."""

    title: str
    done: int  # lines that the machine took
    total: int
    outcome: Literal["running", "done", "stopped", "refused", "lost"] = "running"
    waits: tuple[Wait, ...] = ()  # its pauses
    paused_at: int = -1  # lines that it had taken when it last came to a pause

    @property
    def wait(self) -> Wait | None:
        """The pause in which it is; None if it goes on, or is held elsewhere."""
        if self.outcome != "running" or self.paused_at != self.done:
            return None
        return next((wait for wait in self.waits if wait.lines == self.done), None)
