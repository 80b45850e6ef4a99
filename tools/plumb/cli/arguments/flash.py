"""The arguments of `plumb flash`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_port

HELP = "write the firmware to the Mega"
EXIT = "Exit: 0 written; 2 no board, no firmware.hex, or avrdude refused."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb flash`."""
    parser.add_argument(
        "hex",
        metavar="HEX",
        nargs="?",
        default=".pio/build/megaatmega2560/firmware.hex",
        help="the file to write [%(default)s]",
    )
    add_port(parser)
