"""Locks between programs, on Linux, macOS and Windows. The system ends those of a killed program.

All that the systems do differently with open files is here.
"""

import os
import sys
import time
from collections.abc import Iterator
from contextlib import contextmanager, suppress
from pathlib import Path

import portalocker  # flock where there is one, msvcrt on Windows
from portalocker import LockFlags

# A link is never followed. Windows has no such flag, and lets only administrators make links.
NO_LINKS = getattr(os, "O_NOFOLLOW", 0)
READ_S = 2.0  # [s] within which another program has read a file
AS_IT_IS = getattr(os, "O_BINARY", 0)  # else Windows writes \r\n for \n


@contextmanager
def alone(path: Path) -> Iterator[None]:
    """Until the end, others that ask the same for this file wait. It is made if it is not there."""
    handle = os.open(path, os.O_RDWR | os.O_CREAT | NO_LINKS, 0o600)
    try:
        hold(handle)
        yield
    finally:
        os.close(handle)


def hold(handle: int, *, wait: bool = True) -> None:
    """Lock an open file until it is closed; OSError if another has it and `wait` is false."""
    flags = LockFlags.EXCLUSIVE if wait else LockFlags.EXCLUSIVE | LockFlags.NON_BLOCKING
    try:
        portalocker.lock(handle, flags)
    except portalocker.LockException as error:
        raise OSError(str(error)) from None


def replaced(old: Path, new: str) -> None:
    """Put a file in the place of another. Windows refuses as long as somebody reads that one."""
    end = time.monotonic() + READ_S
    while sys.platform == "win32" and time.monotonic() < end:
        with suppress(PermissionError):
            os.replace(new, old)
            return
        time.sleep(0.01)
    os.replace(new, old)


def close_to_others(handle: int) -> None:
    """Have the kernel refuse to open a terminal again, except for root. POSIX alone."""
    import fcntl
    import termios

    with suppress(OSError):  # what is no terminal knows no such refusal
        fcntl.ioctl(handle, termios.TIOCEXCL)


def is_private(file: os.stat_result) -> bool:
    """Return whether others can neither read a file nor have written it. Windows closes a folder of
    one's own to others.
    """
    return sys.platform == "win32" or (not file.st_mode & 0o077 and file.st_uid == os.getuid())


def reaches_disk(folder: Path) -> None:
    """Return when the names in a folder are on the disk too; Windows does so by itself."""
    if sys.platform != "win32":
        handle = os.open(folder, os.O_RDONLY)
        try:
            os.fsync(handle)
        finally:
            os.close(handle)
