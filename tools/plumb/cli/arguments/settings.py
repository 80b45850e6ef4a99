"""The arguments of `plumb settings`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_json, add_settings, file

FORMS = ("gcode", "groundcontrol.ini", "table")
HELP = "a fitted machine as $ lines for the firmware, as a groundcontrol.ini, or as a table"
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb settings`."""
    add_settings(parser)
    parser.add_argument("--to", choices=FORMS, default="table", help="the form [%(default)s]")
    parser.add_argument(
        "--original",
        metavar="INI",
        type=file,
        help="the groundcontrol.ini whose other keys --to groundcontrol.ini keeps",
    )
    parser.add_argument("-o", "--output", metavar="FILE", help="write it there instead of printing")
    add_json(parser)
