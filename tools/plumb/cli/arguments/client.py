"""The options that name the client and the firmware that files are for."""

from __future__ import annotations

import argparse

from plumb.cli.arguments.shared import file
from plumb.settings.controllers import CLIENTS, FIRMWARES


def add_client(parser: argparse.ArgumentParser) -> None:
    """The options --client and --original."""
    parser.add_argument(
        "--client",
        choices=CLIENTS,
        help="the program that sends G-code to the machine. It stores numbers too, and sends them "
        "each time it connects. none: a sender that stores no numbers",
    )
    parser.add_argument(
        "--original",
        metavar="INI",
        type=file,
        help="the client's groundcontrol.ini or webcontrol.json; its other keys stay as they are",
    )


def add_firmware(parser: argparse.ArgumentParser) -> None:
    """The option --firmware."""
    parser.add_argument(
        "--firmware",
        choices=FIRMWARES,
        default="plumb",
        help="which firmware the machine runs; with the published firmware the client carries all "
        "corrections [%(default)s]",
    )
