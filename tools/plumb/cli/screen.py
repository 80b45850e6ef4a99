"""What people see: tables, sentences and bars, as wide as the screen but at most 80 columns.

Colour and width come from rich: none in a file, in a pipe, or with NO_COLOR set.
"""

from __future__ import annotations

import json
import math
import os
import re
import sys
import textwrap
import time
from collections.abc import Callable, Sequence
from typing import Literal

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TaskProgressColumn, TextColumn
from rich.table import Table
from rich.text import Text

from plumb.text.answers import json_of

WIDEST = 80  # [characters]
PATIENCE = 2.0  # [s] before a bar shows how far the work is
UNIT = re.compile(r"(?<=\d) (?=(?:%|mm|N)(?!\w))")  # a number and its unit stay together
BAD = ("impossible", "NOT ", "missed")  # how cells begin that nobody should overlook


def console() -> Console:
    """Return the screen, or what takes its place."""
    plain = Console(highlight=False, markup=False, emoji=False)
    piped = not plain.is_terminal and "COLUMNS" not in os.environ
    width = WIDEST if piped else min(plain.width, WIDEST)
    return Console(highlight=False, markup=False, emoji=False, width=width)


def table(
    header: Sequence[str],
    rows: Sequence[Sequence[str]],
    *,
    left: int = 1,
    words: Sequence[int] = (),
    gap: int = 2,
) -> str:
    """Aligned columns: the first `left` and those in `words` (-1 is the last) hold words, which
    wrap where the screen ends; the others hold numbers, which stay whole."""
    grid = Table(box=None, padding=(0, gap, 0, 0), pad_edge=False, header_style="bold")
    spoken = {*range(left), *(place % len(header) for place in words)}
    for place, head in enumerate(header):
        cells = [row[place] for row in rows]
        # Nothing is cut: the longest word or number sets how narrow the column may get.
        whole = [word for cell in cells for word in cell.split()] if place in spoken else cells
        narrowest = max(map(len, [*head.split(), *whole]), default=0)
        justify: Literal["left", "right"] = "left" if place in spoken else "right"
        grid.add_column(Text(head), justify=justify, min_width=narrowest)
    for row in rows:
        grid.add_row(*(Text(cell, style="red" if cell.startswith(BAD) else "") for cell in row))
    screen = console()
    with screen.capture() as captured:
        screen.print(grid, crop=False)
    return "\n".join(line.rstrip() for line in captured.get().splitlines())


def sentences(lines: Sequence[str], *, mark: str = "- ") -> str:
    """Sentences below each other, long sentences wrapped."""
    return "\n".join(
        textwrap.fill(
            UNIT.sub("\0", line),
            console().width,
            initial_indent=mark,
            subsequent_indent=" " * len(mark),
            break_on_hyphens=False,
            break_long_words=False,
        )
        for line in lines
    ).replace("\0", " ")


def headline(sentence: str) -> str:
    """Return the sentence that matters most, which comes first."""
    screen = console()
    with screen.capture() as captured:
        for line in sentences([sentence], mark="").splitlines():
            screen.print(Text(line, style="bold"), crop=False)
    return captured.get().rstrip("\n")


class Bar:
    """A bar on standard error that grows, if the work takes long and somebody looks."""

    def __init__(self, what: str, *, patience: float = PATIENCE) -> None:
        self._what = what
        self._start = time.monotonic()
        self._patience = patience
        self._shown: Progress | None = None
        self._task = TaskID(0)

    def show(self, share: float, what: str = "") -> None:
        """Show how much of the work is done, 0 to 1, and on what it is."""
        waited = time.monotonic() - self._start
        if not self._shown and waited >= self._patience and sys.stderr.isatty():
            columns = TextColumn("{task.description}"), BarColumn(), TaskProgressColumn()
            self._shown = Progress(*columns, console=Console(stderr=True), transient=True)
            self._task = self._shown.add_task(self._what, total=1.0)
            self._shown.start()
        if self._shown:
            self._shown.update(
                self._task, completed=share, description=what or self._what, refresh=True
            )
        if share >= 1:
            self.clear()

    def clear(self) -> None:
        """Leave nothing behind."""
        if self._shown:
            self._shown.stop()
            self._shown = None


def bar(what: str) -> Callable[[float], None]:
    """Show how far the work is, by the share that is done."""
    shown = Bar(what)
    return lambda share: shown.show(share)


# What the commands print: a JSON object, and numbers for people.


def print_json(answer: object) -> None:
    """Print an answer as a single JSON object."""
    print(json.dumps(json_of(answer), indent=2, allow_nan=False))


def about(millimetres: float) -> str:
    """Return a length for the title of a picture: a decimal, two below a millimetre."""
    return f"{millimetres:.1f}" if millimetres >= 0.95 else f"{millimetres:.2f}"


def number(value: float | None) -> str:
    """Return a parameter for people: four figures, six for what is measured in metres."""
    if value is None or not math.isfinite(value):
        return "-"
    return f"{value:.6g}" if abs(value) >= 100 else f"{value:.4g}"
