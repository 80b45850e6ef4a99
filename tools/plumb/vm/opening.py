"""Notices each time that a program opens a file, however soon it closes it again."""

from __future__ import annotations

import contextlib
import ctypes
import os
import struct

OPENED = 0x20  # IN_OPEN of Linux's inotify
HEAD = struct.Struct("iIII")  # watch, mask, cookie, length of the name


class OpeningWatch:
    """Counts openings by Linux's inotify; Python itself has no door to it."""

    def __init__(self, path: str) -> None:
        """Raises OSError where the system has no inotify."""
        self._libc = ctypes.CDLL(None, use_errno=True)
        try:
            self._handle = self._libc.inotify_init1(os.O_NONBLOCK | os.O_CLOEXEC)
        except AttributeError:
            raise OSError("this system has no inotify") from None
        if (
            self._handle < 0
            or self._libc.inotify_add_watch(self._handle, os.fsencode(path), OPENED) < 0
        ):
            raise OSError(ctypes.get_errno(), f"{path} cannot be watched")

    def count(self) -> int:
        """How often it was opened since the last call."""
        opened = 0
        with contextlib.suppress(BlockingIOError):
            while True:
                events, at = os.read(self._handle, 4096), 0
                while at < len(events):
                    _, mask, _, length = HEAD.unpack_from(events, at)
                    opened += bool(mask & OPENED)
                    at += HEAD.size + length
        return opened

    def close(self) -> None:
        """Look away."""
        os.close(self._handle)
