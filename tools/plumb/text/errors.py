"""The error that is the fault of a file and not of the program."""

from collections.abc import Callable, Iterator
from contextlib import contextmanager
from os import PathLike

Source = str | PathLike[str]  # a path, or what stands for a file in a message


class InputError(Exception):
    """A file or value that cannot be used: `source, place: problem; remedy` on a line.

    Where no file is at fault, the first argument is the whole sentence.
    """

    def __init__(
        self, source: Source, problem: str = "", *, place: str = "", remedy: str = ""
    ) -> None:
        where = source if isinstance(source, str) else str(source)
        where = f"{where}, {place}" if place else where
        text = where + ": " + problem if problem else where
        text = text + "; " + remedy if remedy else text
        super().__init__(in_both(text, _printable))


def _printable(text: str) -> str:
    """Return a text as a line; file names and old ini files may hold bytes that are no text."""
    return " ".join(text.encode("utf-8", "backslashreplace").decode("utf-8").splitlines())


@contextmanager
def naming(source: Source, place: str = "") -> Iterator[None]:
    """Turn a ValueError raised inside into an InputError that names the file and the place."""
    try:
        yield
    except ValueError as error:
        raise InputError(source, said_by(error), place=place) from None


# The reader of a message: at a command line, or at the lab's page.
#
# An option of the command line means nothing on the page. So what to do about a fault is written
# for both, and whoever shows it takes what his reader can do. A test holds every message of the
# lab's rooms to it.


class _Said(str):
    """Words for a command line that know those for the page; with + they stay both, and in an
    f-string they would lose the page's.
    """

    page: str

    def __add__(self, after: str) -> str:
        return to_do(f"{self}{after}", page=self.page + on_page(after))

    def __radd__(self, before: str) -> str:
        return to_do(f"{before}{self}", page=before + self.page)


def to_do(line: str, *, page: str) -> str:
    """Return what its reader can do: with options on a command line, or on the page."""
    said = _Said(line)
    said.page = page
    return said


def in_both(words: str, change: Callable[[str], str]) -> str:
    """Return words that are changed alike for both readers."""
    return to_do(change(words), page=change(on_page(words)))


def on_page(said: str | BaseException) -> str:
    """Return words, or those of an error, as the lab's page shows them."""
    words = said_by(said) if isinstance(said, BaseException) else said
    return words.page if isinstance(words, _Said) else words


def said_by(error: BaseException) -> str:
    """Return the words of an error for both readers."""
    return error.args[0] if error.args and isinstance(error.args[0], _Said) else str(error)
