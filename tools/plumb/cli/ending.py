"""How a program of the lab ends: done, refused, interrupted, or with nobody left to read."""

from __future__ import annotations

import json
import os
import sys
from collections.abc import Callable

from plumb.text.compiled import refuse_stale
from plumb.text.errors import InputError

REFUSED = 2
INTERRUPTED = 130  # what a shell shows after Ctrl-C
READER_GONE = 141  # what a shell shows after a closed pipe


def ended(run: Callable[[], int], *, name: str, as_json: bool = False) -> int:
    """The exit code of `run`; what went wrong is a single line on standard error, and with --json
    an object {"error": ...} on the standard output too."""
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
    except BrokenPipeError:
        _leave_quietly()
        return READER_GONE
    except OSError as error:
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
