"""Output for people: tables, sentences and bars, as wide as the screen but at most 80 columns.

Colour and width come from rich: none in a file, in a pipe, or with NO_COLOR set.
"""

import argparse
import json
import math
import os
import re
import sys
import textwrap
import time
from collections.abc import Callable, Iterable, Sequence
from pathlib import Path
from threading import Thread
from typing import Literal

from rich.console import Console
from rich.progress import BarColumn, Progress, TaskID, TaskProgressColumn, TextColumn
from rich.table import Table
from rich.text import Text

from plumb.text.answers import json_of
from plumb.text.commands import GOES_ON, quoted
from plumb.text.files import numbered
from plumb.text.values import MM, Unit
from plumb.words import Part, Rows, Sentences
from plumb.words.states import ADD, AGAIN, Follows

WIDEST = 80  # [characters]
PATIENCE = 2.0  # [s] before a bar shows how far the work is
UNIT = re.compile(r"(?<=\d) (?=(?:%|mm|N)(?!\w))")  # a number and its unit stay together
WARNED = ("impossible", "NOT ", "missed")  # beginnings of cells that must not be overlooked
GOOD, OPEN, BAD = "good", "open", "bad"  # kinds of verdicts
COLOURS = {GOOD: "bold green", OPEN: "bold yellow", BAD: "bold red"}


def console() -> Console:
    """Return the screen, or what takes its place."""
    # A pipe has all its columns; rich takes one from what may be an old console of Windows.
    old = None if Console().is_terminal else False
    plain = Console(highlight=False, markup=False, emoji=False, legacy_windows=old)
    piped = not plain.is_terminal and "COLUMNS" not in os.environ
    width = WIDEST if piped else min(plain.width, WIDEST)
    return Console(highlight=False, markup=False, emoji=False, width=width, legacy_windows=old)


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
        grid.add_row(*(Text(cell, style="red" if cell.startswith(WARNED) else "") for cell in row))
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


def in_text(parts: Iterable[Part]) -> list[str]:
    """Return tables and sentences as a terminal shows them."""
    return [
        sentences(part.lines, mark=part.mark) if isinstance(part, Sentences) else _rows_text(part)
        for part in parts
    ]


def _rows_text(part: Rows) -> str:
    shown = table(part.header, part.rows, left=part.left, words=part.words)
    return f"{shown}\n{sentences([part.note], mark='')}" if part.note else shown


def headline(sentence: str, kind: str = "") -> str:
    """Return the sentence that matters most, where the screen has colours in that of its kind of
    verdict; "": it is no verdict.
    """
    style = COLOURS.get(kind, "bold")
    screen = console()
    with screen.capture() as captured:
        for line in sentences([sentence], mark="").splitlines():
            screen.print(Text(line, style=style), crop=False)
    return captured.get().rstrip("\n")


class Bar:
    """A bar on standard error that grows, if the work takes long and it is a terminal."""

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
            columns = TextColumn("{task.description}"), BarColumn(20), TaskProgressColumn()
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
    print(json.dumps(json_of(answer), indent=2, allow_nan=False), flush=True)


def number(value: float | None) -> str:
    """Return a parameter for people: four figures, six for what is measured in metres."""
    if value is None or not math.isfinite(value):
        return "-"
    return f"{value:.6g}" if abs(value) >= 100 else f"{value:.4g}"


# The next step: the exact command, so that it can be copied.

INDENT = "  "
AUTO = "auto"  # as an effect: those that the marks ask for
CLIENT_OF = {".ini": "groundcontrol", ".json": "webcontrol"}  # by the ending of its file
# What the next command has to be given again, by the name that the parser has for it.
REPEATED = {
    "--cut-with": "cut_with",
    "--controller": "controller",
    "--sigma": "sigma",
    "--without": "without",
}


def next_step(words: str, command: Sequence[str]) -> str:
    """Return what to do next, and its command below; a long command goes on after a backslash."""
    return f"{words}\n{command_text(['plumb', *command])}"


def command_text(words: Iterable[str]) -> str:
    """Return a command that a shell reads, on lines that fit the screen where that shell has lines
    that go on; an option keeps its value.
    """
    parts: list[str] = []
    for word in map(quoted, words):
        value_of_last = parts and parts[-1].startswith("-") and " " not in parts[-1]
        if value_of_last and not word.startswith("-"):
            parts[-1] += f" {word}"
        else:
            parts.append(word)
    width = console().width - 2  # a blank and the backslash
    lines = [f"{INDENT}{parts[0]}"]
    for part in parts[1:]:
        if GOES_ON and len(f"{lines[-1]} {part}") > width:
            lines.append(f"{2 * INDENT}{part}")
        else:
            lines[-1] += f" {part}"
    return f"{GOES_ON}\n".join(lines)


def same_inputs(
    arguments: argparse.Namespace, *more: str, effects: Sequence[str] = (AUTO,)
) -> list[str]:
    """Return the settings, the marks (with `more` of them) and how they are read, as they were
    given.

    Checks of effects that are not fitted are left out; with "auto" any may be.
    """
    words = [arguments.settings, *arguments.marks, *more]
    for option, name in REPEATED.items():
        value = getattr(arguments, name, None)
        for each in value if isinstance(value, list) else [value]:
            if each is not None:
                words += [option, f"{each:g}" if isinstance(each, float) else str(each)]
    for name, sigma in getattr(arguments, "prior", None) or ():
        words += ["--prior", f"{name}={sigma:.12g}"]
    for check in getattr(arguments, "checked", None) or ():
        effect = check.name.rpartition(".")[0]
        if not effect or effect in effects or AUTO in effects:
            words += ["--checked", str(check)]
    return words


def usual_client(arguments: argparse.Namespace) -> list[str]:
    """Return the client as it was named, or as the settings file tells it: by its name, or by the
    client's file that was written with it.
    """
    client = getattr(arguments, "client", None)
    original = getattr(arguments, "original", None)
    settings = Path(arguments.settings)
    for ending, name in CLIENT_OF.items():
        kept = settings.with_name(f"{settings.stem}-{name}{ending}")
        if client is None and settings.suffix.lower() == ending:
            client = name
        elif client in (None, name) and original is None and kept.is_file():
            client, original = name, str(kept)
    words = ["--client", client or "none"]
    return [*words, "--original", original] if original else words


def add_named(arguments: argparse.Namespace, effects: Sequence[str]) -> list[str]:
    """Return the command that adds these effects and writes the files."""
    same = same_inputs(arguments, effects=effects)
    machine = free_name("machine", ".toml")
    named = ["--effect", *effects] if effects else []
    for name, size in getattr(arguments, "hold", []):
        named += ["--hold", f"{name}={size:.12g}"]
    patch = ["--patch"] if getattr(arguments, "patch", False) else []
    return ["add", *same, *named, *patch, *usual_client(arguments), "-o", machine]


def auto_words(arguments: argparse.Namespace) -> list[str]:
    """Return the command that adds what is most likely and writes the files."""
    return add_named(arguments, [AUTO])


def what_follows(
    follows: Follows, arguments: argparse.Namespace, again: Sequence[str], *more: str
) -> str:
    """Return what comes after an answer, with its command; `again` and `more` are the words before
    and behind the board that ask the same again.
    """
    if not follows.command:
        return sentences([follows.said], mark="")
    if follows.command == ADD:
        return next_step(follows.said, auto_words(arguments))
    before, behind = (again, more) if follows.command == AGAIN else ([follows.command], ())
    return next_step(follows.said, [*before, *same_inputs(arguments), *behind])


def into_machine(machine: str) -> str:
    """Return how the numbers of a machine.toml come into a machine whose client is not named."""
    words = "Write it into the machine (for GroundControl or WebControl give --client):"
    return next_step(words, ["send", machine])


def second_round(arguments: argparse.Namespace, files: Sequence[str], unit: Unit) -> str:
    """Return how to see on new marks that the new settings hold; the machine leads the files."""
    machine = files[0]
    marks, program = free_name("marks", ".toml"), free_name("grid", ".nc")
    tape = ["--units", unit.name] if unit != MM else []
    grid = ["grid", "--settings", machine, *tape, "--marks", marks, "--output", program]
    again = ["calibrate", machine, marks]
    if not any(Path(path).suffix in CLIENT_OF for path in files):
        again += usual_client(arguments)
    cut = next_step("See that it holds on new marks, cut with the new settings:", grid)
    return f"{cut}\n{next_step('and when they are measured:', again)}"


def free_name(stem: str, ending: str) -> str:
    """Return the first of `machine.toml`, `machine-2.toml` ... that no file has."""
    names = (f"{each}{ending}" for each in numbered(stem))
    return next(name for name in names if not os.path.exists(name))


# A question in the terminal; the program goes on working, and looks for the answer meanwhile.

STDIN = 0  # not sys.stdin: its lock would be held at the end of the program


class Prompt:
    """A question whose answer is a line."""

    def __init__(self, text: str) -> None:
        self.answer: str | None = None  # None: not yet; empty: just Enter
        self.is_unheard = False  # no answer can come: the input has ended
        print(text, end="", flush=True)
        Thread(target=self._listen, daemon=True).start()

    def _listen(self) -> None:
        typed = b""
        while not typed.endswith(b"\n"):
            came = os.read(STDIN, 1)
            if not came:
                self.is_unheard = True
                print()
                break
            typed += came
        self.answer = typed.decode(errors="replace").strip()
