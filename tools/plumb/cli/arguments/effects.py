"""The arguments of `plumb effects`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_json

HELP = "the library of effects: what each does, its units, and what looks like it"
EXIT = "Exit: 0 done."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb effects`."""
    add_json(parser)
