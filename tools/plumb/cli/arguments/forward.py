"""The arguments of `plumb forward`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_json, add_settings, add_units, file

HELP = "places for chain lengths, by our model"
EXIT = "Exit: 0 done; 1 some lengths lead nowhere; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb forward`."""
    add_settings(parser)
    parser.add_argument(
        "--lengths",
        metavar="FILE",
        type=file,
        required=True,
        help="CSV: left,right per line, mm paid out from 12 o'clock; a header is allowed",
    )
    add_units(parser)
    add_json(parser)
