"""The arguments of `plumb guide`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_port

HELP = "go through a machine's first day: wires, numbers, reach, chains, first mark"
EXIT = "Exit: 0 all steps are done; 1 a step is open; 2 no machine answers."
STEPS = ("read", "wires", "numbers", "reach", "chains", "mark")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb guide`."""
    parser.add_argument(
        "folder", metavar="FOLDER", nargs="?", default=".", help="where the answers are kept [.]"
    )
    add_port(parser)
    parser.add_argument(
        "--step", choices=STEPS, metavar="STEP", help=f"begin again at: {', '.join(STEPS)}"
    )
    parser.add_argument(
        "--units", choices=("mm", "inch"), default="mm", help="of your tape [%(default)s]"
    )
