"""The arguments of `plumb read`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_force, add_json, add_port

HELP = "read the machine's numbers and where its sled is"
EXIT = "Exit: 0 done; 2 no machine answers, or the file cannot be written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb read`."""
    add_port(parser)
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="write the numbers to this file, as a machine.toml"
    )
    add_force(parser)
    add_json(parser)
