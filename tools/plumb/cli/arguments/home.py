"""The arguments of `plumb home`."""

from __future__ import annotations

import argparse
import re

from plumb.cli.arguments.shared import add_force, add_json, add_settings, add_units
from plumb.cli.arguments.touch import Point, add_touch, point

HELP = "keep a hole as home mark, and restore a lost position with the bit in it"
EXIT = (
    "Exit: 0 done; 1 a second home mark does not fit the first; 2 an input cannot be used, and "
    "nothing was written."
)
WORD = re.compile(r"[A-Za-z0-9_-]+")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb home`."""
    add_settings(parser)
    parser.add_argument(
        "--keep",
        metavar="NAME=X,Y",
        type=named_place,
        help="keep the hole that the machine makes at this place [mm, from the middle of the "
        "sheet, y up], with both chains there; -o writes the program that makes it",
    )
    parser.add_argument(
        "--at",
        metavar="NAME",
        help="the bit is in this home mark: say how long the chains are; -o writes the program "
        "that sets them",
    )
    add_touch(parser, meaning="another home mark, touched after that: say how well it fits")
    parser.add_argument("-o", "--output", metavar="FILE", help="write the program to this file")
    add_force(parser)
    add_units(parser)
    add_json(parser)


def named_place(text: str) -> tuple[str, Point]:
    """Reads NAME=X,Y."""
    name, _, place = text.partition("=")
    if not WORD.fullmatch(name):
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=X,Y, like left=-900,250")
    return name, point(place)
