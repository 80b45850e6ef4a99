"""The error that is the fault of a file and not of the program."""

from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar
from os import PathLike

Source = str | PathLike[str]  # a path, or what stands for a file in a message


class InputError(Exception):
    """A file or value that cannot be used: `source, place: problem; remedy` on a line.

    Where no file is at fault, the first argument is the whole sentence.
    """

    def __init__(
        self,
        source: Source,
        problem: str = "",
        *,
        place: str = "",
        remedy: str = "",
    ) -> None:
        where = f"{source}, {place}" if place else f"{source}"
        text = f"{where}: {problem}" if problem else where
        text = f"{text}; {remedy}" if remedy else text
        # File names and old ini files may hold bytes that cannot be printed as they are.
        printable = text.encode("utf-8", "backslashreplace").decode("utf-8")
        super().__init__(" ".join(printable.splitlines()))


@contextmanager
def naming(source: Source, place: str) -> Iterator[None]:
    """Turn a ValueError raised inside into an InputError that names the file and the place."""
    try:
        yield
    except ValueError as error:
        raise InputError(source, str(error), place=place) from None


# The reader of a message: at a command line, or at the lab's page.
#
# An option of the command line means nothing on the page. So what to do about a fault is written
# for both, and each reader gets what he can do. A test holds every message of the lab's rooms to
# it.

_on_page: ContextVar[bool] = ContextVar("on_page", default=False)


@contextmanager
def read_on_page() -> Iterator[None]:
    """Until the end, messages are read on the lab's page."""
    token = _on_page.set(True)
    try:
        yield
    finally:
        _on_page.reset(token)


def to_do(line: str, *, page: str) -> str:
    """Return what its reader can do: with options on a command line, or on the page."""
    return page if _on_page.get() else line
