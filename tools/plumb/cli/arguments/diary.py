"""The arguments of `plumb diary`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_force, add_json, add_units

HELP = "show how errors and numbers of a machine went over time"
EXIT = "Exit: 0 done; 2 there is no diary, or a file cannot be written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb diary`."""
    parser.add_argument(
        "folder",
        metavar="FOLDER",
        nargs="?",
        default=".",
        help="the machine's folder [this folder]",
    )
    parser.add_argument(
        "--picture", metavar="FILE", help="draw errors and numbers over time: .png, .svg, .pdf"
    )
    add_force(parser)
    add_units(parser)
    add_json(parser)
