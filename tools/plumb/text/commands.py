"""A command as the shell of this computer reads it."""

import shlex
import subprocess
import sys

# What ends a line that goes on below; the two shells of Windows differ there.
GOES_ON = "" if sys.platform == "win32" else " \\"


def quoted(word: str) -> str:
    """Return a word of a command, in quotes where it needs them."""
    return subprocess.list2cmdline([word]) if sys.platform == "win32" else shlex.quote(word)
