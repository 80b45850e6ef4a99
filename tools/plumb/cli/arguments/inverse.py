"""The arguments of `plumb inverse`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_controller, add_json, add_settings, add_units, file

HELP = "chain lengths for places, by the controller's formula or by our model"
EXIT = "Exit: 0 done; 1 some place is out of reach; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb inverse`."""
    add_settings(parser)
    parser.add_argument(
        "--points",
        metavar="FILE",
        type=file,
        required=True,
        help="CSV: x,y per line, mm from the middle of the sheet, y up; a header is allowed",
    )
    parser.add_argument("--float32", action="store_true", help="compute as the board does")
    add_controller(parser)
    add_units(parser)
    add_json(parser)
