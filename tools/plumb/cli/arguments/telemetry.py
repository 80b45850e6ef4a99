"""The arguments of `plumb telemetry`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_json, file

HELP = "how the machine is doing, from a client's log with an answer to B30"
EXIT = "Exit: 0 done and all is well, 1 something to look at, 2 the log cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb telemetry`."""
    parser.add_argument(
        "log",
        metavar="LOG",
        type=file,
        help="a text with a [Telemetry|...] line; the last such line counts",
    )
    parser.add_argument(
        "--limit",
        type=float,
        default=2.0,
        metavar="MM",
        help="the machine's $42, the limit of the following error [2]",
    )
    parser.add_argument(
        "--rate",
        type=int,
        default=100,
        choices=(100, 200),
        help="the machine's $69, the rate of the control tick [100]",
    )
    add_json(parser)
