"""The arguments of `plumb reach`."""

from __future__ import annotations

import argparse

from plumb import _core
from plumb.cli.arguments.shared import (
    add_force,
    add_json,
    add_prior,
    add_settings,
    add_units,
    limit,
)

OPTIONS = {
    "most_tension": ("N", "largest tension of a chain at its sprocket; motors stall near 290 N"),
    "least_tension": ("N", "least tension of a chain at its sprocket; the bungee pulls about 18 N"),
    "least_free": ("MM", "least length of chain between ring and sprocket"),
    "most_give": ("MM_PER_N", "largest move of the sled for each newton that pushes it"),
}
HELP = "which part of the sheet a machine can use: chains too tight, too slack, sled too soft"
EXIT = "Exit: 0 done; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb reach`."""
    usual = _core.reach_limits()
    add_settings(parser)
    parser.add_argument("-o", "--output", metavar="FILE", help="draw the map: .png, .svg or .pdf")
    for name, (unit, meaning) in OPTIONS.items():
        parser.add_argument(
            "--" + name.replace("_", "-"),
            metavar=unit,
            type=limit,
            default=usual[name],
            help=f"{meaning} [%(default)g]",
        )
    add_prior(parser)
    add_force(parser)
    add_units(parser)
    add_json(parser)
