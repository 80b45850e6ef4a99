"""What takes long in a game: a thread cuts the sheet, a single piece of work at a time."""

from __future__ import annotations

from collections.abc import Callable
from contextvars import copy_context
from dataclasses import dataclass, replace
from threading import Lock, Thread

from plumb.text.errors import InputError


@dataclass(frozen=True)
class Doing:
    """Work that is under way."""

    words: str
    done: int
    of: int


class PracticeDesk:
    """Does a piece of work at a time, and keeps why the last failed."""

    def __init__(self) -> None:
        self.doing: Doing | None = None
        self.trouble = ""
        self._changing = Lock()

    def start(self, words: str, of: int, work: Callable[[Callable[[int], None]], None]) -> None:
        """Begin; `work` counts what is done. Raises InputError while something else is done."""
        with self._changing:
            if self.doing:
                raise InputError(f"{self.doing.words} first: wait until that is done")
            self.doing, self.trouble = Doing(words, 0, of), ""
        # The thread speaks to whom this thread speaks to, and follows no link either.
        Thread(target=copy_context().run, args=(self._do, work), daemon=True).start()

    def _do(self, work: Callable[[Callable[[int], None]], None]) -> None:
        try:
            work(self._count)
        except Exception as error:  # whatever it is, the page has to hear of it
            self.trouble = str(error)
        finally:
            self.doing = None

    def _count(self, done: int) -> None:
        if self.doing:
            self.doing = replace(self.doing, done=done)
