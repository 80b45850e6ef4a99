"""The command line: `plumb COMMAND ...`; prints, and returns 0 done, 1 bad news, 2 refused."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Mapping, Sequence
from typing import NoReturn, Protocol

from plumb.cli import (
    add,
    bench,
    compare,
    diagnose,
    effects,
    forward,
    grid,
    inverse,
    preview,
    reach,
    settings,
    telemetry,
)
from plumb.cli import next as next_measurement
from plumb.model.sketches import BROKEN
from plumb.text.errors import InputError

DESCRIPTION = "Find and cure the errors of a hanging CNC: grid, compare, diagnose, next, add."
EPILOG = "Lengths are mm, forces N, angles rad. plumb COMMAND --help explains each command."


class Command(Protocol):
    """What the module of a command holds."""

    HELP: str  # a sentence for `plumb --help`
    EXIT: str  # what its exit codes mean

    def add_arguments(self, parser: argparse.ArgumentParser) -> None:
        """Tell the parser the arguments of this command."""

    def run(self, arguments: argparse.Namespace) -> int:
        """Do it and return the exit code."""


# In the order of `plumb --help`. To add a command, write its module and give it a line.
COMMANDS: Mapping[str, Command] = {
    "grid": grid,
    "preview": preview,
    "compare": compare,
    "diagnose": diagnose,
    "next": next_measurement,
    "add": add,
    "effects": effects,
    "telemetry": telemetry,
    "bench": bench,
    "inverse": inverse,
    "forward": forward,
    "settings": settings,
    "reach": reach,
}


class Parser(argparse.ArgumentParser):
    """Complains on a single line, like every other refusal."""

    def error(self, message: str) -> NoReturn:
        """Refuse the command line."""
        raise InputError(f"{' '.join(message.split())}; see {self.prog} --help")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run a command and return its exit code."""
    try:
        parsed = build_parser().parse_args(arguments)
        for line in BROKEN:
            raise InputError(f"sketch {line}")
        code: int = parsed.run(parsed)
        sys.stdout.flush()
        return code
    except InputError as error:
        print(f"plumb: {error}", file=sys.stderr)
        return 2
    except BrokenPipeError:
        # The reader (head, less) has seen enough; nothing may be printed at exit either.
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0


def build_parser() -> Parser:
    """The parser of all commands."""
    parser = Parser(prog="plumb", description=DESCRIPTION, epilog=EPILOG, allow_abbrev=False)
    commands = parser.add_subparsers(metavar="COMMAND", required=True, title="commands")
    for name, command in COMMANDS.items():
        subparser = commands.add_parser(
            name,
            help=command.HELP,
            description=f"{command.HELP[0].upper()}{command.HELP[1:]}.",
            epilog=command.EXIT,
            allow_abbrev=False,
        )
        command.add_arguments(subparser)
        subparser.set_defaults(run=command.run)
    return parser


if __name__ == "__main__":
    sys.exit(main())
