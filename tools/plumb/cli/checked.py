"""The option --checked: numbers of the machine that were measured directly."""

from __future__ import annotations

import argparse
import math
import re

from plumb.diagnose import Checked
from plumb.fit.problem import PRIORS
from plumb.model.catalogue import parameter_words
from plumb.text.errors import InputError

# A number that can be measured, as it is given.
EXAMPLE = next(
    f"{name}={words['typical']:g}+-{words['sigma']:g}"
    for name, words in parameter_words().items()
    if words["sigma"]
)


def add_checked(parser: argparse.ArgumentParser) -> None:
    """The option --checked."""
    parser.add_argument(
        "--checked",
        metavar="NAME=VALUE+-SIGMA",
        action="append",
        type=checked,
        default=[],
        help="a number of the machine that you measured directly, like "
        f"{EXAMPLE} (one sigma); see plumb next and plumb effects",
    )


def checked(text: str) -> Checked:
    """Reads NAME=VALUE+-SIGMA."""
    name, _, numbers = text.partition("=")
    value, _, sigma = re.sub("±", "+-", numbers).partition("+-")
    try:
        check = Checked(name.strip(), float(value), float(sigma))
    except ValueError:
        check = Checked(name, math.nan, math.nan)
    if not (math.isfinite(check.value) and math.isfinite(check.sigma)):
        raise argparse.ArgumentTypeError(f"'{text}' is not like motor_gap=2978.4+-1")
    if check.sigma <= 0:
        raise argparse.ArgumentTypeError(f"'{text}': a sigma is above zero")
    return check


def usable_checks(checks: list[Checked], priors: dict[str, float]) -> list[Checked]:
    """The checks, if each is of a number that is fitted here."""
    known = [*parameter_words(), *(name for name, sigma in priors.items() if sigma > 0)]
    for check in checks:
        if check.name not in known:
            frame = ", ".join(name for name in PRIORS)
            raise InputError(
                f"--checked {check.name}: no such number is fitted; give a parameter as plumb "
                f"effects names it, like {EXAMPLE.partition('=')[0]}, or of the frame {frame}"
            )
    if len({check.name for check in checks}) < len(checks):
        raise InputError("--checked: a number is given twice; give the mean of both")
    return checks
