"""The arguments of `plumb grid`."""

from __future__ import annotations

import argparse

import plumb.grid as marks_grid
from plumb import _core
from plumb.cli.arguments.shared import limit

HELP = "the G-code for a grid of calibration marks"
EXIT = "Exit: 0 done; 2 the grid cannot be made, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb grid`: those of the tool, and --json."""
    marks_grid.add_arguments(parser)
    parser.add_argument(
        "--most-give",
        metavar="MM_PER_N",
        type=limit,
        default=_core.reach_limits()["most_give"],
        help="how far a newton may move the sled; see plumb reach [%(default)g]",
    )
    parser.add_argument(
        "--paper",
        metavar="FILE.pdf",
        help="also write a sheet to print: the holes with their numbers, and boxes to fill in",
    )
    parser.add_argument("--json", action="store_true", help="print a JSON object and nothing else")
