"""`plumb recover`: keeps home marks, brings a lost place back, and repairs a slipped chain."""

import argparse
import re

from plumb.cli import home, slip
from plumb.cli.arguments import add_shared, place
from plumb.job.home import Point
from plumb.text.errors import InputError


def run(arguments: argparse.Namespace) -> int:
    """Keep, restore or list home marks, or weigh what touched holes say; return the exit code."""
    if arguments.touch and not (arguments.keep or arguments.at):
        return slip.run(arguments)
    for option in ("taped", "fixed", "sigma"):
        if getattr(arguments, option):
            raise InputError(f"--{option} is for touched holes: give --touch, and no home mark")
    return home.run(arguments)


# The arguments of `plumb recover`.

EXAMPLES = (
    "plumb recover machine.toml --keep left=-900,250 -o hole.nc",
    "plumb recover machine.toml --touch=-900,250:-895.4,253.7 --touch=900,-250:897.9,-246.5",
)
EXIT = (
    "Exit: 0 done, or no chain slipped; 1 a chain slipped, the touches cannot tell, no slip "
    "explains them, or a second home mark does not fit the first; 2 an input cannot be used, and "
    "nothing was written."
)
WORD = re.compile(r"[A-Za-z0-9_-]+")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb recover`."""
    add_shared(parser, "settings")
    parser.add_argument(
        "--keep",
        metavar="NAME=X,Y",
        type=named_place,
        help="keep a home mark at this place [mm, from the middle of the sheet, y up]; -o writes "
        "the program that makes the hole",
    )
    parser.add_argument(
        "--at",
        metavar="NAME",
        help="print how long the chains are with the bit in this home mark; -o writes the program "
        "that sets them",
    )
    parser.add_argument(
        "--touch",
        metavar="HOLE:SHOWN",
        action="append",
        type=touch,
        default=[],
        help="a hole with the bit in it, like --touch=-900,250:-896.2,253.1 (x,y of the hole, or "
        "the name of a home mark; then what the machine shows): with two or more say whether a "
        "chain slipped; with --at, how well another home mark fits",
    )
    parser.add_argument(
        "--taped",
        action="store_true",
        help="you measured the places of the holes with a tape [else they are where the machine "
        "was sent when it made them]",
    )
    parser.add_argument(
        "--fixed",
        action="store_true",
        help="the holes are in the frame or its board, not in a sheet that can move",
    )
    add_shared(parser, sigma="0.5; with --taped what the fit of SETTINGS left, if that is more")
    add_shared(parser, output="write the program to this file")
    add_shared(parser, "--force", "--units", "--json")


def named_place(text: str) -> tuple[str, Point]:
    """Read NAME=X,Y."""
    name, _, where = text.partition("=")
    if not WORD.fullmatch(name):
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=X,Y, like left=-900,250")
    return name, place(where)


def touch(text: str) -> tuple[str | Point, Point]:
    """Read HOLE:SHOWN; a hole is a place or a name."""
    hole, separator, shown = text.rpartition(":")
    if not (separator and hole):
        raise argparse.ArgumentTypeError(f"'{text}' is not HOLE:SHOWN, like -900,250:-896.2,253.1")
    return (place(hole) if "," in hole else hole), place(shown)
