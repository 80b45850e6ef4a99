"""The arguments of `plumb report`."""

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
    add_without,
)

HELP = "all that the marks say, as a page to read, print and keep"
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb report`."""
    add_marks(parser)
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        required=True,
        help="the page: .html, a single file that needs no network",
    )
    add_without(parser)
    add_prior(parser)
    add_sigma(parser, usual="as plumb diagnose takes it")
    add_checked(parser)
    add_units(parser)
    add_force(parser)
    add_json(parser)
