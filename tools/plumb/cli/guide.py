"""`plumb guide`: a machine's first day, step by step."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Mapping
from contextlib import nullcontext, redirect_stdout
from dataclasses import dataclass
from pathlib import Path
from textwrap import wrap

from plumb.cli.arguments import add_json, add_port
from plumb.cli.screen import next_step, print_json
from plumb.guide.steps import SETTINGS, Visit, walk
from plumb.guide.talk import Progress, Talk, progress_in
from plumb.line.port import SerialPort, port_for
from plumb.line.sender import Sender
from plumb.text.errors import InputError

WIDTH = 79  # characters of a line


@dataclass(frozen=True)
class GuideAnswer:
    """How far a machine's first day is; what the guide says goes to the standard error."""

    done: tuple[str, ...]  # steps
    open: tuple[str, ...]
    settings: str
    sigmas: Mapping[str, float]  # [mm] how far each number that the owner gave may be wrong


def run(arguments: argparse.Namespace) -> int:
    """Walk, and return the exit code."""
    folder = Path(arguments.folder)
    if not folder.is_dir():
        raise InputError(folder, "there is no such folder", remedy="make it, or name another")
    progress = progress_in(folder)
    with redirect_stdout(sys.stderr) if arguments.json else nullcontext():
        code = _walk(arguments, folder, progress)
    if arguments.json:
        open_ = tuple(step for step in STEPS if step not in progress.done)
        settings = str(folder / SETTINGS)
        print_json(GuideAnswer(tuple(progress.done), open_, settings, progress.sigmas))
    return code


def _walk(arguments: argparse.Namespace, folder: Path, progress: Progress) -> int:
    _say("Nothing moves before you say yes to it. Keep a hand on the power switch all the same.")
    port = SerialPort(port_for(arguments.port))
    try:
        sender = Sender(port)
        sender.await_start()
        talk = Talk(_say, _answer, unit=arguments.units)
        if not walk(Visit(sender, talk, progress), first=arguments.step or ""):
            return 1
    finally:
        port.close()
    grid = ["grid", "--settings", str(folder / SETTINGS), "--marks", "marks.toml"]
    _say("\nAll steps are done.")
    print(next_step("Cut a grid of marks:", [*grid, "--output", "grid.nc"]))
    calibrate = ["calibrate", str(folder / SETTINGS), "marks.toml"]
    for name, sigma in progress.sigmas.items():
        calibrate += ["--prior", f"{name}={sigma:g}"]
    print(next_step("Type in what you measured. Then calibrate, with what you know:", calibrate))
    return 0


def _say(text: str) -> None:
    """Print lines, none wider than a terminal."""
    print(_folded(text), flush=True)


def _answer(question: str) -> str:
    """Return what the owner types; from a pipe it is printed too, so that it can be read
    afterwards.
    """
    text = input(_folded(question))
    if not sys.stdin.isatty():
        print(text)
    return text


def _folded(text: str) -> str:
    end = " " if text.endswith(" ") else ""
    return (
        "\n".join(
            "\n".join(
                wrap(
                    line,
                    WIDTH,
                    subsequent_indent=" " * (len(line) - len(line.lstrip())),
                    break_on_hyphens=False,  # names of files stay whole
                    break_long_words=False,
                )
            )
            for line in text.rstrip().split("\n")
        )
        + end
    )


# The arguments of `plumb guide`.

EXAMPLES = (
    "plumb guide my-maslow",
    "plumb guide my-maslow --step numbers",
)
EXIT = "Exit: 0 all steps are done; 1 a step is open; 2 no machine answers."
STEPS = ("read", "wires", "numbers", "reach", "chains", "mark")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb guide`."""
    parser.add_argument(
        "folder", metavar="FOLDER", nargs="?", default=".", help="where the answers are kept [.]"
    )
    add_port(parser)
    parser.add_argument(
        "--step", choices=STEPS, metavar="STEP", help=f"begin again at: {', '.join(STEPS)}"
    )
    parser.add_argument(
        "--units", choices=("mm", "inch"), default="mm", help="of your tape [%(default)s]"
    )
    add_json(parser)
