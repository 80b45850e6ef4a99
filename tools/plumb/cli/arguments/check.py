"""The arguments of `plumb check`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.job import add_machine
from plumb.cli.arguments.shared import add_force, add_json, add_units, file

HELP = "run a program dry: what is wrong with it, how long it takes, how well it will fit"
EXIT = "Exit: 0 nothing is wrong; 1 something is; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb check`."""
    add_machine(parser)
    parser.add_argument(
        "--marks",
        metavar="MARKS",
        type=file,
        action="append",
        default=[],
        help="measured marks of this machine: they tell which errors to expect of each part",
    )
    parser.add_argument(
        "--cut-with",
        metavar="SETTINGS",
        type=file,
        help="the settings in force when the marks were cut, if they are not SETTINGS",
    )
    parser.add_argument(
        "--picture", metavar="FILE", help="draw the job on its sheet: .png, .svg or .pdf"
    )
    parser.add_argument(
        "--outline",
        metavar="FILE",
        help="write a program that goes round the job, slowly, with the bit above the sheet",
    )
    add_force(parser)
    add_units(parser)
    add_json(parser)
