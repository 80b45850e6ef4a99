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
        help="what sends G-code to the machine: it keeps numbers too, and sends them each time it "
        "connects. none: a sender that keeps none",
    )
    parser.add_argument(
        "--original",
        metavar="INI",
        type=file,
        help="the groundcontrol.ini or webcontrol.json of the client, whose other keys are kept",
    )


def add_firmware(parser: argparse.ArgumentParser) -> None:
    """The option --firmware."""
    parser.add_argument(
        "--firmware",
        choices=FIRMWARES,
        default="plumb",
        help="which firmware the machine runs; for the published one the client carries all "
        "corrections [%(default)s]",
    )
