"""The command line: `plumb COMMAND ...`; prints, and returns 0 done, 1 bad news, 2 refused."""

from __future__ import annotations

import argparse
import os
import sys
from collections.abc import Callable, Sequence
from typing import NoReturn

from plumb.cli import (
    add,
    bench,
    compare,
    diagnose,
    effects,
    grid,
    kinematics,
    preview,
    reach,
    settings,
    telemetry,
)
from plumb.cli import next as next_marks
from plumb.model.sketches import BROKEN
from plumb.text.errors import InputError

DESCRIPTION = "Find and cure the errors of a hanging CNC: grid, compare, diagnose, next, add."
EPILOG = "Lengths are mm, forces N, angles rad. plumb COMMAND --help explains each command."


class Parser(argparse.ArgumentParser):
    """Complains in one line, like every other refusal."""

    def error(self, message: str) -> NoReturn:
        """Refuse the command line."""
        raise InputError(f"{' '.join(message.split())}; see {self.prog} --help")


def main(arguments: Sequence[str] | None = None) -> int:
    """Run one command and return its exit code."""
    try:
        parsed = build_parser().parse_args(arguments)
        for line in BROKEN:
            raise InputError(f"sketch {line}")
        code = parsed.run(parsed)
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
    _enter(commands, "grid", grid.HELP, grid.EXIT, grid.add_arguments, grid.run)
    for name, module in (
        ("preview", preview),
        ("compare", compare),
        ("diagnose", diagnose),
        ("next", next_marks),
        ("add", add),
        ("effects", effects),
        ("telemetry", telemetry),
        ("bench", bench),
    ):
        _enter(commands, name, module.HELP, module.EXIT, module.add_arguments, module.run)
    _enter(
        commands,
        "inverse",
        kinematics.INVERSE_HELP,
        kinematics.INVERSE_EXIT,
        kinematics.add_inverse_arguments,
        kinematics.run_inverse,
    )
    _enter(
        commands,
        "forward",
        kinematics.FORWARD_HELP,
        kinematics.FORWARD_EXIT,
        kinematics.add_forward_arguments,
        kinematics.run_forward,
    )
    _enter(commands, "settings", settings.HELP, settings.EXIT, settings.add_arguments, settings.run)
    _enter(commands, "reach", reach.HELP, reach.EXIT, reach.add_arguments, reach.run)
    return parser


def _enter(
    commands: argparse._SubParsersAction,
    name: str,
    summary: str,
    exit_codes: str,
    add_arguments: Callable[[argparse.ArgumentParser], None],
    run: Callable[[argparse.Namespace], int],
) -> None:
    """One command with its help, arguments and action."""
    parser = commands.add_parser(
        name,
        help=summary,
        description=f"{summary[0].upper()}{summary[1:]}.",
        epilog=exit_codes,
        allow_abbrev=False,
    )
    add_arguments(parser)
    parser.set_defaults(run=run)


if __name__ == "__main__":
    sys.exit(main())
