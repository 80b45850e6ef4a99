"""The command line: `plumb COMMAND ...`; prints, and returns 0 done, 1 bad news, 2 refused.

Help and refusals of words come from `arguments/` alone, which needs no numpy; the file of a command
is loaded when it runs.
"""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Mapping, Sequence
from importlib import import_module as loaded
from typing import Protocol

from plumb.cli.arguments import (
    add,
    bench,
    calibrate,
    check,
    compare,
    diagnose,
    diary,
    effects,
    flash,
    forward,
    gap,
    grid,
    guide,
    home,
    inverse,
    lab,
    practice,
    preview,
    reach,
    read,
    recheck,
    report,
    resume,
    send,
    settings,
    slip,
    telemetry,
    vm,
)
from plumb.cli.arguments import next as next_measurement
from plumb.cli.ending import ended
from plumb.cli.output import results_of
from plumb.cli.parser import Completion, Parser, Version
from plumb.text.errors import InputError
from plumb.text.shown import shown_in

DESCRIPTION = "Find and cure the errors of a hanging CNC: grid, cut, measure, then calibrate."
EPILOG = "Lengths are mm, forces N, angles rad. plumb COMMAND --help explains each command."


class Command(Protocol):
    """What the file of a command in `arguments/` holds."""

    HELP: str  # a sentence for `plumb --help`
    EXIT: str  # what its exit codes mean

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Tell the parser the arguments of this command."""


# In the order of `plumb --help`. To add a command, write its two files and give it a line.
GROUPS: Mapping[str, Mapping[str, Command]] = {
    "first day": {"guide": guide, "lab": lab, "flash": flash, "reach": reach},
    "calibrate": {
        "grid": grid,
        "preview": preview,
        "calibrate": calibrate,
        "compare": compare,
        "diagnose": diagnose,
        "next": next_measurement,
        "add": add,
        "settings": settings,
        "report": report,
    },
    "job": {"check": check, "send": send, "resume": resume},
    "trouble": {
        "read": read,
        "recheck": recheck,
        "home": home,
        "slip": slip,
        "gap": gap,
        "diary": diary,
        "telemetry": telemetry,
    },
    "engineers": {
        "vm": vm,
        "practice": practice,
        "effects": effects,
        "inverse": inverse,
        "forward": forward,
        "bench": bench,
    },
}
COMMANDS: Mapping[str, Command] = {
    name: command for group in GROUPS.values() for name, command in group.items()
}


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code."""
    words = list(sys.argv[1:] if arguments is None else arguments) or ["--help"]
    return ended(lambda: _run(words), name="plumb", as_json="--json" in words)


def _run(arguments: Sequence[str]) -> int:
    # The lab's matrices are small: threads of the linear algebra only wait for each other.
    os.environ.setdefault("OPENBLAS_NUM_THREADS", "1")
    parsed = build_parser().parse_args(arguments)
    run: Callable[[argparse.Namespace], int] = loaded(f"plumb.cli.{parsed.command}").run
    for line in loaded("plumb.model.sketches").BROKEN:
        raise InputError(f"sketch {line}")
    units = "mm" if "json" in parsed and parsed.json else getattr(parsed, "units", None)
    with results_of(parsed), shown_in(units or "mm"):
        return run(parsed)


def build_parser() -> Parser:
    """The parser of all commands."""
    parser = Parser(
        prog="plumb",
        description=DESCRIPTION,
        epilog=EPILOG,
        allow_abbrev=False,
        groups={title: list(group) for title, group in GROUPS.items()},
    )
    parser.add_argument("--version", action=Version, help="show the version and exit")
    completion = "print what lets a shell complete commands; see docs/README.md"
    parser.add_argument("--completion", action=Completion, help=completion)
    commands = parser.add_subparsers(metavar="COMMAND", required=True, dest="command")
    for name, command in COMMANDS.items():
        subparser = commands.add_parser(
            name,
            help=command.HELP,
            description=f"{command.HELP[0].upper()}{command.HELP[1:]}.",
            epilog=command.EXIT,
            allow_abbrev=False,
        )
        command.add_arguments(subparser)
    return parser


if __name__ == "__main__":
    sys.exit(main())
