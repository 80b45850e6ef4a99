"""The arguments of `plumb faults`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_force

HELP = "lets faults strike a virtual machine, and says what it did with each"
EXIT = (
    "Exit: 0 no machine was sure of a wrong place and no setting was lost; 1 otherwise; "
    "2 it cannot run."
)
TRIES = 10


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb faults`."""
    parser.add_argument(
        "--only",
        metavar="NAME",
        nargs="+",
        action="extend",
        default=[],
        help="only faults whose names begin so (docs/faults.md lists them)",
    )
    parser.add_argument(
        "--tries",
        metavar="N",
        type=_count,
        default=TRIES,
        help="machines for each fault [%(default)s]",
    )
    parser.add_argument("--seed", metavar="S", type=int, default=1, help="other machines [1]")
    parser.add_argument(
        "--mega",
        metavar="ELF",
        help="run this flashed program on a simulated Mega, not the firmware built for the host",
    )
    parser.add_argument("--write", metavar="FILE", help="write the page with the table (markdown)")
    add_force(parser)


def _count(text: str) -> int:
    count = int(text) if text.isdecimal() else 0
    if count < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number, like 10")
    return count
