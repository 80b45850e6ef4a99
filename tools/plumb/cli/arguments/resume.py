"""The arguments of `plumb resume`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.job import add_machine, place
from plumb.cli.arguments.shared import add_force, count

HELP = "write a program that goes on with a job after a halt"
EXIT = "Exit: 0 done; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb resume`."""
    add_machine(parser)
    parser.add_argument(
        "--line",
        metavar="N",
        type=count,
        help="go on at this line, from the last place before it where the bit was out of the wood",
    )
    parser.add_argument(
        "--at",
        metavar="X,Y",
        type=place,
        help="go on in the middle of the cut that passes here, mm from mid sheet; of several "
        "passes the first, or that of --line",
    )
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        default="-",
        help="the program [the standard output]",
    )
    add_force(parser)
