"""The arguments of `plumb send`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_port

HELP = "send a program, a line of G-code or a machine's numbers to the machine"
EXIT = "Exit: 0 all was done; 1 stopped after Ctrl-C; 2 refused, or no machine."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb send`."""
    parser.add_argument(
        "what",
        metavar="FILE|LINE",
        help="a program to run; a machine.toml, whose numbers are written and read back; or a "
        "single line",
    )
    add_port(parser)
    parser.add_argument(
        "--undo",
        action="store_true",
        help="write back the numbers that the machine had before you sent FILE",
    )
    parser.add_argument(
        "--force",
        action="store_true",
        help="send marks, or numbers, though the machine holds others than those that they were "
        "made for",
    )
