"""The arguments of `plumb add`."""

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
    named_number,
)

HELP = "fit the frame and the named effects to the marks, and write the new settings"
EXIT = (
    "Exit: 0 done; 1 done, but marks left out of the fit are not predicted better than without the "
    "effects, or auto cannot explain the marks (nothing is written for a slip); 2 an input cannot "
    "be used, and nothing was written."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb add`."""
    add_marks(parser)
    parser.add_argument(
        "--effect",
        metavar="NAME",
        nargs="+",
        action="extend",
        default=[],
        help="effects to fit (plumb effects lists them); auto: what plumb diagnose proves; none: "
        "the frame alone. Other effects of SETTINGS stay as they are",
    )
    parser.add_argument(
        "--hold",
        metavar="NAME=SIZE",
        action="append",
        type=held_size,
        default=[],
        help="keep a parameter of these effects at a size, like chain_pitch.left=0.001; the rest "
        "is fitted",
    )
    parser.add_argument(
        "--patch",
        action="store_true",
        help="also fit a smooth map of the errors that no effect explains; it is no physics",
    )
    add_without(parser)
    parser.add_argument(
        "-o", "--output", metavar="FILE", help="write the fitted machine to this file"
    )
    add_client(parser)
    add_firmware(parser)
    add_prior(parser)
    add_sigma(parser, usual="tape_sigma_mm of MARKS and repeats, else from the residuals")
    add_checked(parser)
    parser.add_argument(
        "--picture", metavar="FILE", help="draw how the error falls: .png, .svg, .pdf"
    )
    add_force(parser)
    add_units(parser)
    add_json(parser)


def held_size(text: str) -> tuple[str, float]:
    """Reads NAME=SIZE."""
    name, size = named_number(text)
    if size is None:
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=SIZE, like chain_pitch.left=0.001")
    return name, size
