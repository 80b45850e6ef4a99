"""The arguments of `plumb diagnose`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.checked import add_checked
from plumb.cli.arguments.shared import add_json, add_marks, add_prior, add_sigma, add_units

HELP = "which effect the settings miss, as far as the marks can prove it"
EXIT = (
    "Exit: 0 done; 1 done, but a mark should be measured again or no effect of the library "
    "explains the marks; 2 an input cannot be used."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb diagnose`."""
    add_marks(parser)
    add_prior(parser)
    add_sigma(parser, usual="tape_sigma_mm of MARKS and repeats, else 0.5")
    add_checked(parser)
    add_units(parser)
    add_json(parser)
