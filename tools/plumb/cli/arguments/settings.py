"""The arguments of `plumb settings`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.client import add_client
from plumb.cli.arguments.shared import add_force, add_json, add_settings

FORMS = ("gcode", "table")
HELP = "a fitted machine as $ lines for the firmware, with its client's file, or as a table"
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb settings`."""
    add_settings(parser)
    parser.add_argument("--to", choices=FORMS, default="table", help="what to write [%(default)s]")
    add_client(parser)
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="write to this file, not to the screen"
    )
    add_force(parser)
    add_json(parser)
