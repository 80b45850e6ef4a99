"""What differs between systems: tests of what Windows has not, and how it reads a command."""

import os
import shlex

import pytest
from plumb.text.commands import GOES_ON

ON_POSIX = pytest.mark.skipif(os.name == "nt", reason="Windows has no such thing")


def words_of(command: str) -> list[str]:
    """The words of a printed command, as the shell of this system reads them."""
    plain = command.replace("\\", "\\\\") if os.name == "nt" else command.replace("\\\n", " ")
    return shlex.split(plain)


def widest(said: str) -> int:
    """The length of the longest line; a command has a single one on Windows, however long."""
    lines = [each for each in said.splitlines() if GOES_ON or not each.startswith("  plumb ")]
    return max(map(len, lines))
