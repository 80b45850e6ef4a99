"""The arguments of `plumb slip`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import (
    add_force,
    add_json,
    add_settings,
    add_sigma,
    add_units,
)
from plumb.cli.arguments.touch import add_touch

HELP = "say from touched marks whether a chain slipped by whole links, and how to repair it"
EXIT = (
    "Exit: 0 no chain slipped; 1 a chain slipped, or the touches cannot tell, or no slip explains "
    "them; 2 an input cannot be used."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb slip`."""
    add_settings(parser)
    add_touch(parser, meaning="a mark with the bit in it; give two or more")
    parser.add_argument(
        "--taped",
        action="store_true",
        help="the places of the holes were read with a tape [they are where the machine was sent "
        "when it made them]",
    )
    parser.add_argument(
        "--fixed",
        action="store_true",
        help="the holes are in the frame or its board, not in a sheet that can move",
    )
    add_sigma(parser, usual="0.5; with --taped what the fit of SETTINGS left, if that is more")
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="write the program that repairs the slip"
    )
    add_force(parser)
    add_units(parser)
    add_json(parser)
