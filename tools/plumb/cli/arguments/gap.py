"""The arguments of `plumb gap`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_json, add_settings, add_units, length

HELP = "work out the motor gap from a chain that B11 pulled tight"
EXIT = "Exit: 0 done; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb gap`."""
    add_settings(parser)
    parser.add_argument(
        "--length",
        metavar="L",
        type=length,
        nargs="+",
        required=True,
        help="what the machine says to B10 after B11, once or several times",
    )
    parser.add_argument(
        "--flex",
        metavar="MM",
        type=length,
        help="by how much the motors come closer when 100 N pull on them (an untold flex counts "
        "as 0.5 mm, give or take 0.5)",
    )
    parser.add_argument(
        "--drop",
        metavar="MM",
        type=length,
        help="how far the middle of the tight chain hangs below a string from end to end: it says "
        "the pull better than the motor does",
    )
    add_units(parser)
    add_json(parser)
