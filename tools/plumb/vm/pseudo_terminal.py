"""A virtual machine behind a pseudo terminal, which other programs open as a serial port."""

import contextlib
import ctypes
import os
import pty
import select
import struct
import tty
from pathlib import Path

import plumb._vm
from plumb._vm import VirtualMachine
from plumb.line.port import PSEUDO, LineLock, TakenError
from plumb.text.errors import InputError
from plumb.vm.served_port import BOOTLOADER, CHUNK, ServedPort


def preload() -> str:
    """Return the library that lets a client treat a pseudo terminal as a serial port.

    InputError where it was not built.
    """
    library = Path(plumb._vm.__file__).with_name("serial_port.so")
    if not library.exists():
        raise InputError(str(library), "was not built", remedy="it is for Linux only")
    return str(library)


class PseudoTerminal(ServedPort):
    """A pseudo terminal as the port. An opening shows by Linux's inotify."""

    def __init__(self, machine: VirtualMachine, *, boot_time: int = BOOTLOADER) -> None:
        """boot_time [ms]: 0 for a machine with a bootloader of its own."""
        super().__init__(machine, boot_time=boot_time)
        self._master, slave = pty.openpty()
        tty.setraw(slave)
        self.path = os.ttyname(slave)
        # Without a program at the other end the master hangs up; so an opening shows.
        os.close(slave)
        os.set_blocking(self._master, False)
        self._poll = select.poll()
        self._poll.register(self._master, select.POLLIN)
        self._openings = OpeningWatch(self.path)
        self._name: LineLock | None = None  # held as long as the machine has its name

    def close(self) -> None:
        """Take the port away."""
        if self.link and _leads_to(self.link) == self.path:
            self.link.unlink()
        self._openings.close()
        os.close(self._master)
        if self._name:
            self._name.release()

    def link_as(self, link: str) -> None:
        """Give the port a name; InputError if something else has it."""
        path = Path(link)
        if path.exists() and not _leads_to(path).startswith(PSEUDO):
            raise InputError(link, "is the name of something else", remedy="give another --link")
        try:
            # The kernel may have given a killed machine's number to another: the name counts.
            self._name = LineLock(f"{path.parent.resolve() / path.name}-machine")
        except TakenError:
            why = "a virtual machine is at it already"
            raise InputError(link, why, remedy="end it or give another --link") from None
        try:
            if path.is_symlink():
                path.unlink()
            path.symlink_to(self.path)
        except OSError as error:
            self._name.release()
            why = f"cannot be the name of the port ({error.strerror})"
            raise InputError(link, why, remedy="give another --link") from None
        self.link = path

    def _is_open(self) -> bool:
        return not self._events() & select.POLLHUP

    def _was_opened(self) -> bool:
        return self._openings.count() > 0

    def _take(self) -> bytes:
        if self._events() & select.POLLIN:
            with contextlib.suppress(OSError):
                return os.read(self._master, CHUNK)
        return b""

    def _give(self, said: bytes) -> bytes:
        with contextlib.suppress(OSError):
            return said[os.write(self._master, said) :]
        return said

    def _events(self) -> int:
        return dict(self._poll.poll(0)).get(self._master, 0)


def _leads_to(link: Path) -> str:
    """Return where a link leads; empty if it is none."""
    return os.readlink(link) if link.is_symlink() else ""


# Notices each time that a program opens a file, however soon it closes it again.

OPENED = 0x20  # IN_OPEN of Linux's inotify
HEAD = struct.Struct("iIII")  # watch, mask, cookie, length of the name


class OpeningWatch:
    """Counts openings by Linux's inotify; Python itself has no door to it."""

    def __init__(self, path: str) -> None:
        """Raise OSError where the system has no inotify."""
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
        """Return how often it was opened since the last call."""
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
