"""The arguments of `plumb vm`."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import length

FEEDS = ("top", "bottom")
HELP = "start a virtual machine with a serial port, as if a board were plugged in"
EXIT = "Exit: 0 ended with Ctrl-C or after --seconds; 2 it cannot be started."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb vm`."""
    parser.add_argument("--link", metavar="PATH", help="a name for the port, say ./maslow")
    parser.add_argument(
        "--hide",
        metavar="EFFECT",
        nargs="+",
        default=[],
        help="effects that this machine has and its settings do not know; random draws an effect",
    )
    parser.add_argument(
        "--size",
        metavar="MM",
        type=length,
        default=3.0,
        help="how far each effect moves the marks, RMS [%(default)g]",
    )
    parser.add_argument(
        "--seed",
        metavar="N",
        type=int,
        default=0,
        help="draws frame, sheet, motors and the random effect [%(default)s]",
    )
    parser.add_argument(
        "--feed",
        choices=FEEDS,
        default="top",
        help="where the chains leave the sprockets: over the top, or off the bottom [%(default)s]",
    )
    parser.add_argument("--reveal", action="store_true", help="say at the end what was hidden")
    parser.add_argument(
        "--eeprom", metavar="FILE", help="keep the board's memory in this file from run to run"
    )
    parser.add_argument(
        "--fresh",
        action="store_true",
        help="begin with an empty memory: no settings, no chain lengths",
    )
    _add_brain(parser)
    parser.add_argument(
        "--form",
        metavar="FORM",
        help="a form that plumb grid wrote: a tape fills it in once all its marks are cut",
    )
    parser.add_argument("--readings", metavar="FILE", help="write the filled form to this file")
    parser.add_argument(
        "--noise",
        metavar="MM",
        type=length,
        default=0.4,
        help="noise of the tape's readings [%(default)g]",
    )


def _add_brain(parser: argparse.ArgumentParser) -> None:
    """What runs, how fast, and what clients need for its port."""
    parser.add_argument(
        "--mega",
        metavar="ELF",
        help="run this flashed program on a simulated Mega, not the firmware built for the host",
    )
    parser.add_argument(
        "--speed",
        metavar="N",
        type=length,
        default=1.0,
        help="how many times as fast as real time [%(default)g]",
    )
    parser.add_argument("--seconds", metavar="S", type=length, help="end after S seconds")
    parser.add_argument(
        "--preload",
        action="store_true",
        help="print the library that a client needs for this port (LD_PRELOAD), and end",
    )
