"""Where results go: files, devices and pipes, and `-` for the standard output."""

import argparse
import errno
import json
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager, nullcontext, redirect_stdout
from contextvars import ContextVar
from dataclasses import dataclass
from pathlib import Path
from typing import TextIO

from plumb.text.compiled import refuse_stale
from plumb.text.errors import InputError
from plumb.text.files import is_ours, write_all

STDOUT = "-"
# Where the parsed arguments hold the name of a result that can go there.
RESULTS = ("output", "template", "marks", "write")


@dataclass(frozen=True)
class _Way:
    """The options by which a command writes its results."""

    force: bool
    results: TextIO


_way: ContextVar[_Way | None] = ContextVar("way", default=None)


@contextmanager
def results_of(arguments: argparse.Namespace) -> Iterator[None]:
    """Run a command: while a result goes to the standard output, its report goes to the other."""
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


def write_outputs(files: Mapping[str, bytes], *, inputs: Sequence[str]) -> None:
    """Write all results or none; what was read, and what others wrote, is never replaced."""
    way = _way.get() or _Way(force=False, results=sys.stdout)
    taken = {os.path.realpath(path) for path in inputs}
    for path in files:
        if path != STDOUT and os.path.realpath(path) in taken:
            raise InputError(path, "is read here and kept", remedy="give the result another name")
        if path != STDOUT and not way.force:
            _refuse_foreign(path)
    write_all({path: content for path, content in files.items() if path != STDOUT})
    if STDOUT in files:
        way.results.flush()
        way.results.buffer.write(files[STDOUT])
        way.results.flush()


def refuse_twins(*paths: str | None) -> None:
    """Refuse two results with the same name."""
    named = [os.path.realpath(path) for path in paths if path]
    for path in paths:
        if path and named.count(os.path.realpath(path)) > 1:
            raise InputError(path, "is the name of two results", remedy="give each another name")


def say_failure(sentence: str) -> None:
    """Say on the standard error what failed next to results that were written; nothing for ''."""
    if sentence:
        print(f"plumb: {sentence}", file=sys.stderr)


def _refuse_foreign(path: str) -> None:
    place = Path(path)
    try:
        foreign = place.is_file() and not is_ours(place)
    except OSError as error:
        raise InputError(path, f"cannot be looked into ({error.strerror})") from None
    if foreign:
        raise InputError(
            path,
            "exists, and plumb did not write it",
            remedy="give the result another name, or --force to replace the file",
        )


# How a program of the lab ends: done, refused, interrupted, or with nobody left to read.

REFUSED = 2
INTERRUPTED = 130  # what a shell shows after Ctrl-C
READER_GONE = 141  # what a shell shows after a closed pipe


def ended(run: Callable[[], int], *, name: str, as_json: bool = False) -> int:
    """Return the exit code of `run`; what went wrong is a single line on standard error, and with
    --json an object {"error": ...} on the standard output too.
    """
    try:
        refuse_stale()
        code = run()
        _flush()
        return code
    except InputError as error:
        return _refused(str(error), name=name, as_json=as_json)
    except KeyboardInterrupt:
        _leave_quietly()
        return INTERRUPTED
    except OSError as error:
        # So Windows says that nobody reads a pipe.
        invalid = os.name == "nt" and error.errno == errno.EINVAL and not error.filename
        if invalid or isinstance(error, BrokenPipeError):
            _leave_quietly()
            return READER_GONE
        reason = error.strerror or str(error)
        where = f"{error.filename}: " if error.filename else "the output cannot be written: "
        return _refused(f"{where}{reason}", name=name, as_json=as_json)


def _refused(said: str, *, name: str, as_json: bool) -> int:
    """Say it; where the standard output takes no more, the standard error alone says it."""
    print(f"{name}: {said}", file=sys.stderr)
    try:
        if as_json:
            print(json.dumps({"error": said}))
        _flush()
    except (OSError, ValueError):
        _leave_quietly()
    return REFUSED


def _flush() -> None:
    if sys.stdout is not None:
        sys.stdout.flush()


def _leave_quietly() -> None:
    """Let Python print nothing more when it ends: what is still to be written goes nowhere."""
    try:
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
    except (AttributeError, OSError, ValueError):
        return  # a standard output that is closed, or that is no file
