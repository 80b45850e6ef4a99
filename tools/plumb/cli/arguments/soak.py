"""The arguments of `plumb soak`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import length

HELP = "lets a virtual machine work for an hour, and says what drifted, was late or wore out"
EXIT = "Exit: 0 nothing did; 1 something did; 2 it cannot run."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb soak`."""
    parser.add_argument(
        "--minutes", metavar="M", type=length, default=60.0, help="of the machine's time [60]"
    )
    parser.add_argument("--seed", metavar="S", type=int, default=1, help="other jobs [1]")
    parser.add_argument(
        "--mega",
        metavar="ELF",
        help="run this flashed program on a simulated Mega, not the firmware built for the host",
    )
