"""The arguments of `plumb preview`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import (
    add_controller,
    add_force,
    add_json,
    add_prior,
    add_settings,
    add_units,
    file,
    length,
)

COLUMNS, ROWS = 5, 3  # of the usual grid
HELP = "before any hole is drilled: which effects a plan of marks could tell apart"
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb preview`."""
    add_settings(parser)
    parser.add_argument(
        "plan",
        metavar="PLAN",
        type=file,
        nargs="?",
        help="a file of marks whose targets are the plan, like that of plumb grid --marks [a grid]",
    )
    for name, usual in (("columns", COLUMNS), ("rows", ROWS)):
        parser.add_argument(f"--{name}", metavar="N", type=int, help=f"{name} of a grid [{usual}]")
    parser.add_argument(
        "--margin",
        metavar="MM",
        type=length,
        help="distance of the outer marks from the sheet's edge [100]",
    )
    parser.add_argument(
        "--sigma",
        metavar="MM",
        type=length,
        help="reading error of a coordinate [tape_sigma_mm of PLAN, else 0.5]",
    )
    add_prior(parser)
    add_controller(parser)
    parser.add_argument(
        "--picture", metavar="FILE", help="draw the plan and what to add to it: .png, .svg or .pdf"
    )
    add_force(parser)
    add_units(parser)
    add_json(parser)
