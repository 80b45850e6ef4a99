"""Where results go: files, devices and pipes, and `-` for the standard output."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext, redirect_stdout
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

from plumb.text.errors import InputError, refusal
from plumb.text.files import write_all
from plumb.text.ours import is_ours

STDOUT = "-"
# Where the parsed arguments hold the name of a result that can go there.
RESULTS = ("output", "template", "marks", "write")


@dataclass(frozen=True)
class _Way:
    """How results are written while a command runs."""

    force: bool
    results: TextIO


_way: ContextVar[_Way | None] = ContextVar("way", default=None)


@contextmanager
def results_of(arguments: argparse.Namespace) -> Iterator[None]:
    """Runs a command: while a result goes to the standard output, its report goes to the other."""
    named = [name for name in RESULTS if getattr(arguments, name, None) == STDOUT]
    if len(named) > 1:
        raise InputError("two results are to go to the standard output (-); name a file for one")
    if named and getattr(arguments, "json", False):
        raise InputError("- and --json both go to the standard output; name a file instead of -")
    token = _way.set(_Way(getattr(arguments, "force", False), sys.stdout))
    try:
        with redirect_stdout(sys.stderr) if named else nullcontext():
            yield
    finally:
        _way.reset(token)


def refuse_early(*paths: str | None) -> None:
    """Refuse, before long work, the results that write_outputs() would refuse after it."""
    way = _way.get() or _Way(force=False, results=sys.stdout)
    for path in paths:
        if not path or path == STDOUT:
            continue
        if not Path(os.path.realpath(path)).parent.is_dir():
            raise refusal(path, "cannot be written (its folder does not exist)")
        if not way.force:
            _refuse_foreign(path)


def write_outputs(files: Mapping[str, bytes], *, inputs: Sequence[str]) -> None:
    """Write all results or none; what was read, and what others wrote, is never replaced."""
    way = _way.get() or _Way(force=False, results=sys.stdout)
    taken = {os.path.realpath(path) for path in inputs}
    for path in files:
        if path != STDOUT and os.path.realpath(path) in taken:
            raise refusal(path, "is read here and kept", remedy="give the result another name")
        if path != STDOUT and not way.force:
            _refuse_foreign(path)
    write_all({path: content for path, content in files.items() if path != STDOUT})
    if STDOUT in files:
        _print_bytes(files[STDOUT], way.results)


def refuse_twins(*paths: str | None) -> None:
    """Refuse two results with the same name."""
    named = [os.path.realpath(path) for path in paths if path]
    for path in paths:
        if path and named.count(os.path.realpath(path)) > 1:
            raise refusal(path, "is the name of two results", remedy="give each another name")


def say_failure(sentence: str) -> None:
    """Say on the standard error what failed next to results that were written; nothing for ''."""
    if sentence:
        print(f"plumb: {sentence}", file=sys.stderr)


def _refuse_foreign(path: str) -> None:
    place = Path(path)
    try:
        foreign = place.is_file() and not is_ours(place)
    except OSError as error:
        raise refusal(path, f"cannot be looked into ({error.strerror})") from None
    if foreign:
        raise refusal(
            path,
            "exists, and plumb did not write it",
            remedy="give the result another name, or --force to replace the file",
        )


def _print_bytes(content: bytes, stream: TextIO) -> None:
    stream.flush()
    stream.buffer.write(content)
    stream.flush()
