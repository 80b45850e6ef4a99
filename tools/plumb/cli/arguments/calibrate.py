"""The arguments of `plumb calibrate`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.checked import add_checked
from plumb.cli.arguments.client import add_client, add_firmware
from plumb.cli.arguments.shared import (
    add_force,
    add_json,
    add_marks,
    add_prior,
    add_sigma,
    add_units,
    add_without,
)

HELP = "compare, diagnose, then add what is proved or say what to measure next, all in one go"
EXIT = (
    "Exit: 0 done, the new settings are written; 1 a reading has to be looked at, or something "
    "measured, first, and nothing was written; 2 an input cannot be used, and nothing was written."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb calibrate`."""
    add_marks(parser)
    add_without(parser)
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="the new machine.toml [machine.toml, or machine-2.toml and so on if that exists]",
    )
    add_client(parser)
    add_firmware(parser)
    add_prior(parser)
    add_sigma(parser, usual="as plumb diagnose takes it")
    add_checked(parser)
    add_units(parser)
    add_force(parser)
    add_json(parser)
