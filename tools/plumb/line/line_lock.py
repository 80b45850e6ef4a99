"""A serial line that a single program has: others are refused before they touch it.

Opening the line resets the board, so a program that comes second must not open it at all.
"""

from __future__ import annotations

import fcntl
import os
import re
import tempfile
import termios
from contextlib import suppress
from pathlib import Path

PSEUDO = "/dev/pts/"  # how lines begin that are no wires


class TakenError(Exception):
    """Another program has the line."""


class LineLock:
    """A lock on a file named after the line. The kernel releases it when its program ends."""

    def __init__(self, path: str) -> None:
        """Raises TakenError if another program of the lab has the line."""
        self._handle: int | None = None
        with suppress(OSError):
            self._handle = _opened(_lock_file(path))
        if self._handle is None:
            return  # of another user, who may have left it: the kernel refuses what is open
        try:
            fcntl.flock(self._handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            self.release()
            raise TakenError from None

    def release(self) -> None:
        """Let others take the line."""
        if self._handle is not None:
            os.close(self._handle)
            self._handle = None


def refuse_others(path: str, handle: int) -> None:
    """Have the kernel refuse to open the line at `handle` again, whoever asks but root."""
    # A pseudo terminal would refuse on, even when the program that had it was killed.
    if os.path.realpath(path).startswith(PSEUDO):
        return
    with suppress(OSError):  # what is no terminal knows no such refusal
        fcntl.ioctl(handle, termios.TIOCEXCL)


def _lock_file(path: str) -> Path:
    """The file that stands for the line, by whichever name it is opened."""
    name = re.sub(r"\W+", "-", os.path.realpath(path)).strip("-")
    return Path(tempfile.gettempdir()) / f"plumb-line-{name}.lock"


def _opened(file: Path) -> int:
    """A handle of the file, made if it is not there; a lock needs no right to write."""
    try:
        return os.open(file, os.O_RDONLY | os.O_CREAT | os.O_NOFOLLOW, 0o644)
    except PermissionError:
        return os.open(file, os.O_RDONLY | os.O_NOFOLLOW)
