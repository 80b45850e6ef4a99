"""The arguments of `plumb next`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.checked import add_checked
from plumb.cli.arguments.shared import (
    add_force,
    add_json,
    add_marks,
    add_prior,
    add_sigma,
    add_units,
)

HELP = "what to measure next: the chance that it settles the question, and the minutes it costs"
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb next`."""
    add_marks(parser)
    add_prior(parser)
    add_sigma(parser, usual="as plumb diagnose takes it")
    add_checked(parser)
    parser.add_argument(
        "--choose",
        metavar="N",
        type=int,
        help="the number of the proposal for --picture, --marks and --output [the best that has "
        "them]",
    )
    parser.add_argument(
        "--picture", metavar="FILE", help="draw the proposal on the sheet: .png, .svg, .pdf"
    )
    parser.add_argument(
        "--marks", dest="template", metavar="FILE", help="write a marks.toml to fill in"
    )
    parser.add_argument(
        "--output", metavar="FILE", help="write the G-code that cuts the proposed marks"
    )
    parser.add_argument(
        "--cut-next-with",
        metavar="SETTINGS",
        help="the settings that the machine has now, if they are not those of MARKS; the form "
        "names them",
    )
    add_force(parser)
    add_units(parser)
    add_json(parser)
