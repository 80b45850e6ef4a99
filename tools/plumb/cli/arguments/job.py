"""What commands on a job share: the program, the machine, where it begins."""

from __future__ import annotations

import argparse
import math
import re

from plumb.cli.arguments.shared import add_settings, file

PLACE = re.compile(r"\s*([-+.\d]+)\s*,\s*([-+.\d]+)\s*")


def add_machine(parser: argparse.ArgumentParser) -> None:
    """JOB, SETTINGS, --start and --set."""
    parser.add_argument("job", metavar="JOB", type=file, help="a program of G-code")
    add_settings(parser)
    parser.add_argument(
        "--start",
        metavar="X,Y",
        type=place,
        default=(0.0, 0.0),
        help="where the bit is when the program begins, mm from mid sheet [0,0]",
    )
    parser.add_argument(
        "--set",
        metavar="N=VALUE",
        type=number,
        action="append",
        default=[],
        help="a number of the firmware that SETTINGS do not hold, like 15=800 [as clients send it]",
    )


def place(text: str) -> tuple[float, float]:
    """Reads X,Y [mm]."""
    match = PLACE.fullmatch(text)
    try:
        x, y = (float(part) for part in match.groups()) if match else (math.nan, math.nan)
    except ValueError:
        x = y = math.nan
    if not (math.isfinite(x) and math.isfinite(y)):
        raise argparse.ArgumentTypeError(f"'{text}' is not X,Y, like 100,-50")
    return x, y


def number(text: str) -> tuple[int, float]:
    """Reads N=VALUE."""
    name, _, value = text.lstrip("$").partition("=")
    try:
        pair = int(name), float(value)
    except ValueError:
        pair = -1, math.nan
    if not (0 <= pair[0] <= 255 and math.isfinite(pair[1])):
        raise argparse.ArgumentTypeError(f"'{text}' is not N=VALUE, like 15=800")
    return pair
