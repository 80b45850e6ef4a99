"""The arguments of `plumb lab`."""

from __future__ import annotations

import argparse

HELP = "open the lab in your browser: measure, see why the machine errs, and cure it"
EXIT = "Exit: 0 ended with Ctrl-C; 2 it cannot be started."
PORT = 8450


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb lab`."""
    parser.add_argument(
        "folder", metavar="FOLDER", nargs="?", default=".", help="where the work is kept [.]"
    )
    parser.add_argument(
        "--port",
        metavar="N",
        type=port,
        default=PORT,
        help="listen on this port; 0: any [%(default)s]",
    )
    parser.add_argument(
        "--no-browser", action="store_true", help="print the address, open no browser"
    )


def port(text: str) -> int:
    """The number of a port."""
    number = int(text)
    if not 0 <= number <= 65535:
        raise ValueError
    return number
