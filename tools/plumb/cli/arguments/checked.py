"""The argument --checked: numbers of the machine that were measured directly."""

from __future__ import annotations

import argparse
import math
import re
from typing import NamedTuple

EXAMPLE = "motor_level.height_difference=4+-1"


class Measured(NamedTuple):
    """What --checked says; whether such a number is fitted comes out when the model is loaded."""

    name: str
    value: float  # [its unit]
    sigma: float  # [its unit]


def add_checked(parser: argparse.ArgumentParser) -> None:
    """The option --checked."""
    parser.add_argument(
        "--checked",
        metavar="NAME=VALUE+-SIGMA",
        action="append",
        type=checked,
        default=[],
        help="a number of the machine that you measured directly, like "
        f"{EXAMPLE} (1 sigma); see plumb next and plumb effects",
    )


def checked(text: str) -> Measured:
    """Reads NAME=VALUE+-SIGMA."""
    name, _, numbers = text.partition("=")
    value, _, sigma = re.sub("±", "+-", numbers).partition("+-")
    if "VALUE" in numbers:
        raise argparse.ArgumentTypeError(f"'{text}': put your number in place of VALUE")
    if "," in numbers:
        raise argparse.ArgumentTypeError(f"'{text}': write a point, not a comma")
    try:
        check = Measured(name.strip(), float(value), float(sigma))
    except ValueError:
        check = Measured(name, math.nan, math.nan)
    if not (math.isfinite(check.value) and math.isfinite(check.sigma)):
        raise argparse.ArgumentTypeError(f"'{text}' is not like motor_gap=2978.4+-1")
    if check.sigma <= 0:
        raise argparse.ArgumentTypeError(f"'{text}': a sigma is above zero")
    return check
