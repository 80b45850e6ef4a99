"""What holds no program: settings, marks and tables, refused before any line is sent."""

from __future__ import annotations

import re
from collections.abc import Sequence
from os import PathLike

from plumb._dry_run import DryRun
from plumb.line.sender import PlainError, plain
from plumb.text.errors import refusal

SETTINGS = "numbers are sent from a machine.toml"
PROGRAM = "give a program of G-code"
OTHERS = (
    (r"^\s*\[(maslow|advanced) settings\]", "holds settings of GroundControl", SETTINGS),
    (r"\A\s*\{.*\"(maslow|advanced) settings\"", "holds settings of WebControl", SETTINGS),
    (r"\A\s*\{", "holds JSON", PROGRAM),
    (r"^\s*\[\[(mark|distance)\]\]|^\s*numpositions\s*[=:]", "holds marks", PROGRAM),
    (r"\A\s*[^\s,;()]+(,[^\s,;()]+)+\s*$", "holds a table", PROGRAM),
)
# What the firmware says of a line that is no G-code at all.
NO_CODE = re.compile(r"(this begins no word|a number is missing behind|there is no such code).*")


def refuse_other_files(source: str | PathLike[str], text: str) -> None:
    """InputError for a client's settings, marks, tables and JSON."""
    for pattern, what, remedy in OTHERS:
        if re.search(pattern, text, re.IGNORECASE | re.MULTILINE | re.DOTALL):
            raise refusal(source, f"{what}, not a program", remedy=remedy)


def refuse_what_is_no_program(source: str | PathLike[str], text: str) -> None:
    """InputError for a text that is something else, or begins with what the firmware cannot read.

    Later lines are left to the machine, and to `plumb check`.
    """
    refuse_other_files(source, text)
    number, first = _first(text.splitlines())
    machine = DryRun()
    machine.send([first])
    for _, said in machine.said():
        fault = NO_CODE.search(said)
        if fault and said.startswith(("ALARM", "error")):
            why = f"is no G-code ({fault[0].removesuffix(' Press Stop.').rstrip('.')})"
            raise refusal(source, why, place=f"line {number}", remedy=PROGRAM)


def _first(lines: Sequence[str]) -> tuple[int, str]:
    """The first line that the machine would get, and its number; an empty line if none can be."""
    for number, line in enumerate(lines, start=1):
        try:
            text = plain(line)
        except PlainError:
            break  # whoever sends says so
        if text:
            return number, text
    return 0, ""
