"""The arguments of `plumb practice`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_force, add_json, add_units

STEPS = ("start", "measure", "read", "check", "hint", "solve")
LEVELS = (1, 2, 3, 4, 5)
HELP = "find what is hidden in a virtual machine"
EXIT = (
    "Exit: 0 done; 1 solved, but something was missed or claimed that is not there; 2 it cannot be "
    "done."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb practice`."""
    parser.add_argument("step", metavar="STEP", nargs="?", choices=STEPS, help=", ".join(STEPS))
    parser.add_argument("folder", metavar="FOLDER", nargs="?", help="where the game is")
    parser.add_argument(
        "what",
        metavar="WHAT",
        nargs="*",
        help="measure: a form of plumb grid or plumb next, or a grid like 5x5; read: names of "
        "marks; check: what to measure directly, like motor_gap; solve: the new machine.toml",
    )
    parser.add_argument(
        "--level",
        metavar="N",
        type=int,
        choices=LEVELS,
        help="1 one large effect, 2 one with look-alikes, 3 two, 4 not in the library, 5 with a "
        "wrong reading [1]",
    )
    parser.add_argument("--seed", metavar="S", type=int, help="another machine [drawn]")
    add_units(parser)
    add_force(parser)
    add_json(parser)
