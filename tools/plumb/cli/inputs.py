"""Machine, marks and picture, as named on a command line."""

from __future__ import annotations

import argparse
import re
from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace
from pathlib import Path
from typing import NamedTuple

from plumb.cli.arguments import add_shared, unit_of
from plumb.diagnosis import Checked
from plumb.fit.by_hand import UNITS, number_read
from plumb.fit.expected import refuse_absurd
from plumb.fit.inputs import Inputs, read_inputs
from plumb.fit.problem import PRIORS, priors_with
from plumb.marks.read import without_marks
from plumb.model.catalogue import parameter_words
from plumb.pictures.drawing import FORMATS
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError, naming
from plumb.text.values import length_in, number_in


def inputs_of(arguments: argparse.Namespace) -> Inputs:
    """Return everything that a command with marks reads."""
    inputs = read_inputs(
        arguments.settings,
        arguments.marks,
        cut_with=arguments.cut_with,
        controller=arguments.controller,
    )
    without = vars(arguments).get("without")
    marks = without_marks(inputs.measurements, without) if without else inputs.measurements
    unit = unit_of(arguments, inputs.measurements.typed.unit)
    return replace(inputs, measurements=marks, unit=unit)


def stated_inputs(arguments: argparse.Namespace) -> Inputs:
    """Return the same with all numbers that the command line states."""
    inputs = inputs_of(arguments)
    priors = priors_with(arguments.prior)
    checks = usable_checks(arguments.checked, priors, inputs.settings)
    refuse_absurd(checks, inputs.settings)
    return replace(inputs, priors=priors, sigma=arguments.sigma, checked=checks)


def usable_checks(
    said: Sequence[Measured], priors: Mapping[str, float], settings: MachineSettings
) -> list[Checked]:
    """Return the checks, if each is of a number that is fitted here."""
    known = [*parameter_words(), *(name for name, sigma in priors.items() if sigma > 0)]
    for check in said:
        if check.name not in known:
            frame = ", ".join(name for name in PRIORS)
            raise InputError(
                f"--checked {check.name}: no such number is fitted; give a parameter as plumb "
                f"effects names it, like {EXAMPLE.partition('=')[0]}, or of the frame {frame}"
            )
    if len({check.name for check in said}) < len(said):
        raise InputError("--checked: a number is given twice; give the mean of both")
    return [Checked(check.name, *_number_of(check, settings)) for check in said]


def _number_of(check: Measured, settings: MachineSettings) -> tuple[float, float]:
    """Return the number and its error [its unit], of a reading too."""
    if not check.unit:
        return float(check.value), float(check.sigma)
    with naming("--checked", check.name):
        return number_read(check.name, check.value, check.sigma, check.unit, settings)


def refuse_unfitted(
    checks: Sequence[Checked], effects: Collection[str], held: Collection[str]
) -> None:
    """Raise InputError for a check of a number that these effects do not fit."""
    for check in checks:
        effect = check.name.rpartition(".")[0]
        if effect and effect not in effects:
            raise InputError(
                f"--checked {check.name}: {effect} is not fitted here; name it with --effect, or "
                "leave this check out"
            )
        if check.name in held:
            raise InputError(
                f"--checked {check.name}: --hold keeps it at a size; leave out either of the two"
            )


# The options that state numbers; --checked has those that were measured directly.

EXAMPLE = "motor_level.height_difference=4+-1"


class Measured(NamedTuple):
    """Number of --checked; whether it is fitted comes out when the model is loaded."""

    name: str
    value: str  # in the unit, or without one in that of the number
    sigma: str
    unit: str  # of the rule or scale; empty: none

    def __str__(self) -> str:
        return f"{self.name}={self.value}+-{self.sigma}{self.unit}"


def add_stated(parser: argparse.ArgumentParser, *, sigma: str) -> None:
    """Add the options --prior, --sigma and --checked; `sigma` says what holds without it."""
    add_shared(parser, "--prior", sigma=sigma)
    parser.add_argument(
        "--checked",
        metavar="NAME=VALUE+-SIGMA",
        action="append",
        type=checked,
        default=[],
        help="a number of the machine that you measured directly, like "
        f"{EXAMPLE} (1 sigma), or with a unit what the rule or scale shows, like "
        "motor_gap=117-1/4+-1/16in; see plumb next and plumb effects",
    )


def checked(text: str) -> Measured:
    """Read NAME=VALUE+-SIGMA, with a unit behind it or without."""
    name, _, numbers = text.partition("=")
    if "VALUE" in numbers:
        raise argparse.ArgumentTypeError(f"'{text}': put your number in place of VALUE")
    if "," in numbers:
        raise argparse.ArgumentTypeError(f"'{text}': write a point, not a comma")
    numbers = re.sub("±", "+-", numbers).strip()
    unit = next((unit for unit in UNITS if re.search(rf"[\d. ]{unit}$", numbers)), "")
    value, _, sigma = numbers.removesuffix(unit).partition("+-")
    value = value.strip().removesuffix(unit)
    try:
        sizes = [length_in(part) if unit else number_in(part) for part in (value, sigma)]
    except ValueError:
        said = f"'{text}' is not like motor_gap=2978.4+-1"
        raise argparse.ArgumentTypeError(said) from None
    if sizes[1] <= 0:
        raise argparse.ArgumentTypeError(f"'{text}': a sigma is above zero")
    return Measured(name.strip(), value.strip(), sigma.strip(), unit)


def picture_form(path: str, *, option: str = "--picture") -> str:
    """Return the form of a picture by its name's ending."""
    form = Path(path).suffix.lower().lstrip(".")
    if form not in FORMATS:
        raise InputError(f"{option} {path}: end the name with .{', .'.join(FORMATS)}")
    return form
