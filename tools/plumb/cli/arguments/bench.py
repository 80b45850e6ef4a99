"""The arguments of `plumb bench`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import add_json, count

HELP = "how often the diagnosis is right: rates over boards with hidden effects"
BOARDS, FAST = 200, 10  # of each scenario
EXIT = "Exit: 0 done, whatever the rates; 2 it cannot run; 130 interrupted, what is done is kept."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb bench`."""
    parser.add_argument(
        "--scenario",
        metavar="NAME",
        nargs="+",
        action="extend",
        default=[],
        help="only scenarios whose names begin like this (docs/bench.md lists them)",
    )
    parser.add_argument(
        "--boards", metavar="N", type=count, help=f"boards of each scenario [{BOARDS}]"
    )
    parser.add_argument("--fast", action="store_true", help=f"{FAST} boards of each scenario")
    parser.add_argument(
        "--seed",
        metavar="S",
        type=int,
        default=1,
        help="draws the boards; the same seed, the same boards [1]",
    )
    parser.add_argument("--jobs", metavar="N", type=count, default=1, help="processes at once [1]")
    add_json(parser)
