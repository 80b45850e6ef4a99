"""The error that is the fault of a file and not of the program."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from os import PathLike


class InputError(Exception):
    """A file or value that cannot be used: the message names file, place and remedy on a line."""


def refusal(
    source: str | PathLike[str], problem: str, *, place: str = "", remedy: str = ""
) -> InputError:
    """The InputError `source, place: problem; remedy`, on a single line."""
    where = f"{source}, {place}" if place else f"{source}"
    text = f"{where}: {problem}; {remedy}" if remedy else f"{where}: {problem}"
    # File names and old ini files may hold bytes that cannot be printed as they are.
    printable = text.encode("utf-8", "backslashreplace").decode("utf-8")
    return InputError(" ".join(printable.splitlines()))


@contextmanager
def naming(source: str | PathLike[str], place: str) -> Iterator[None]:
    """Turn a ValueError raised inside into an InputError that names the file and the place."""
    try:
        yield
    except ValueError as error:
        raise refusal(source, str(error), place=place) from None
