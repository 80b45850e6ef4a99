"""The arguments of `plumb recheck`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.checked import add_checked
from plumb.cli.arguments.shared import (
    add_controller,
    add_json,
    add_prior,
    add_settings,
    add_sigma,
    add_units,
    file,
)
from plumb.cli.arguments.touch import add_touch

HELP = "say from two marks whether the machine is still as it was fitted, or what changed"
EXIT = "Exit: 0 the marks lie within the interval; 1 something changed; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb recheck`."""
    add_settings(parser)
    add_touch(parser, meaning="a mark: where it is, then where the machine was or is in it")
    parser.add_argument(
        "--check",
        metavar="FORM",
        type=file,
        help="marks that a tape has read and no fit has seen: hold them against a fit of MARKS",
    )
    parser.add_argument(
        "marks",
        metavar="MARKS",
        type=file,
        nargs="*",
        help="with --check: the marks to which SETTINGS were fitted",
    )
    parser.add_argument(
        "--cut-with",
        metavar="SETTINGS",
        type=file,
        help="the settings in force when MARKS were cut, if neither they nor SETTINGS say so",
    )
    add_controller(parser)
    add_prior(parser)
    add_checked(parser)
    add_sigma(parser, usual="0.5; with --check what MARKS say")
    add_units(parser)
    add_json(parser)
