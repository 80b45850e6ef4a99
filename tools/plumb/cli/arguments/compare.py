"""The arguments of `plumb compare`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_force, add_json, add_marks, add_units, length

HELP = "how far the marks lie from where the settings predict them"
EXIT = "Exit: 0 done; 1 the RMS is above --limit; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb compare`."""
    add_marks(parser)
    parser.add_argument(
        "--limit", metavar="MM", type=length, help="exit with code 1 if the RMS is above MM"
    )
    add_units(parser)
    parser.add_argument("--picture", metavar="FILE", help="draw the errors: .png, .svg or .pdf")
    parser.add_argument(
        "--names", action="store_true", help="write the marks' names into the picture"
    )
    add_force(parser)
    add_json(parser)
