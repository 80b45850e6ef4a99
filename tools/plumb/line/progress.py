"""The progress of a program that is being sent."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass
from typing import Literal

from plumb.line.sender import COMMENT, plain
from plumb.text.answers import Internal


@dataclass(frozen=True)
class Progress:
    """A program on its way."""

    title: str
    done: int  # lines that the machine took
    total: int
    outcome: Literal["running", "done", "stopped", "refused", "lost"] = "running"
    waits: Internal[tuple[Wait, ...]] = ()  # its pauses
    paused_at: Internal[int] = -1  # lines that it had taken when it last came to a pause

    @property
    def wait(self) -> Wait | None:
        """The pause in which it is; None if it goes on, or is held elsewhere."""
        if self.outcome != "running" or self.paused_at != self.done:
            return None
        return next((wait for wait in self.waits if wait.lines == self.done), None)


# The pauses of a program (M0, M1), and what its comments say is to be done then.

SAID_PAUSED = "Maslow Paused"  # said when a program comes to a pause; a hold says nothing
PAUSE = re.compile(r"M0?[01]", re.IGNORECASE)


@dataclass(frozen=True)
class Wait:
    """A pause of a program."""

    lines: int  # that the machine takes before it
    do: str  # the comment before it, or in its line; empty if there is none


def waits_in(lines: Iterable[str], before: int = 0) -> Iterator[Wait]:
    """Yield the pauses of a program, in their order; `before`: lines taken on an earlier day."""
    count, said = before, ""
    for line in lines:
        comment, text = COMMENT.search(line), plain(line)
        said = comment[0][1:-1].strip() if comment else said
        if not text:
            continue
        if PAUSE.fullmatch(text):
            yield Wait(count, said)
        count, said = count + 1, ""
