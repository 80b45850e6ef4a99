"""The arguments that several commands share, and the values that they take."""

from __future__ import annotations

import argparse
import math
import re
from collections.abc import Callable, Collection, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from pathlib import Path
from typing import Any, NamedTuple, TypeVar

from plumb.diagnosis import Checked
from plumb.fit.compare import refuse_absurd
from plumb.fit.fit import PRIORS, priors_with
from plumb.fit.inputs import UNITS, Inputs, number_read, read_inputs
from plumb.grid import pair
from plumb.marks.read import without_marks
from plumb.model.catalogue import parameter_words
from plumb.settings import CONTROLLERS, MachineSettings
from plumb.text.errors import InputError, naming
from plumb.text.files import ReadOnce, read_bytes
from plumb.text.values import MM, Unit, length_in, number_in, typed_length, unit_called

# The values of arguments: each is read from what was typed, or refused.

Value = TypeVar("Value")


def kind(
    read: Callable[[str], Value], what: str, holds: Callable[[Value], bool] = lambda _: True
) -> Callable[[str], Value]:
    """Return what reads a value, and refuses what is not such: no number is infinite."""

    def typed(text: str) -> Value:
        with suppress(ValueError):
            value = read(text)
            parts = value if isinstance(value, tuple) else (value,)
            if all(math.isfinite(part) for part in parts if isinstance(part, float)) and holds(
                value
            ):
                return value
        raise argparse.ArgumentTypeError(f"'{text}' is not {what}")

    return typed


def _named(text: str) -> tuple[str, float]:
    name, _, value = text.partition("=")
    return name, float(value)


def _numbered(text: str) -> tuple[int, float]:
    name, _, value = text.lstrip("$").partition("=")
    return int(name), float(value)


any_length = kind(typed_length, "a length, like 100 or 4in")
length = kind(typed_length, "a length above zero, like 100 or 4in", lambda size: size > 0)
positive = kind(float, "a number above zero", lambda number: number > 0)
count = kind(int, "a whole number from 1 on, like 100", lambda number: number > 0)
prior = kind(_named, "NAME=SIGMA, like motor_gap=1.5", lambda named: named[1] >= 0)
held_size = kind(_named, "NAME=SIZE, a name and a number")
place = kind(pair, "X,Y, like 100,-50")  # [mm]
number = kind(_numbered, "N=VALUE, like 15=800", lambda pair: 0 <= pair[0] <= 255)


def file(path: str) -> str:
    """Return the name of a file that exists; another is refused before the model is loaded."""
    if not Path(path).exists() or Path(path).is_dir():
        read_bytes(path)  # refuses it; a pipe is read later
    return ReadOnce(path)


def unit_of(arguments: argparse.Namespace, typed: str = MM.name) -> Unit:
    """Return the unit of lengths on the screen: as it was named, else as places were typed. JSON is
    in mm.
    """
    return MM if arguments.json else unit_called(arguments.units or typed)


# The arguments. {} stands for what a command says of it.

FLAG: Mapping[str, Any] = {"action": "store_true"}
SHARED: Mapping[str, Mapping[str, Any]] = {
    "settings": {
        "metavar": "SETTINGS",
        "type": file,
        "help": "groundcontrol.ini, webcontrol.json or machine.toml",
    },
    "marks": {
        "metavar": "MARKS",
        "type": file,
        "nargs": "+",
        "help": "Calibration Measurements.ini, marks.toml or marks.csv; "
        "several files count together",
    },
    "job": {"metavar": "JOB", "type": file, "help": "a program of G-code"},
    "--cut-with": {
        "metavar": "SETTINGS",
        "type": file,
        "help": "the settings in force when the marks were cut, if they are not SETTINGS",
    },
    "--controller": {
        "choices": CONTROLLERS,
        "help": "the controller whose formula turned targets into chain lengths "
        "[what MARKS say, else stock for a groundcontrol.ini]",
    },
    "--start": {
        "metavar": "X,Y",
        "type": place,
        "default": (0.0, 0.0),
        "help": "where the bit is when the program begins, "
        "mm or like 4in,-2in from the middle of the sheet [0,0]",
    },
    "--set": {
        "metavar": "N=VALUE",
        "type": number,
        "action": "append",
        "default": [],
        "help": "a number of the firmware that SETTINGS do not hold, like 15=800 "
        "[as clients send it]",
    },
    "--prior": {
        "metavar": "NAME=SIGMA",
        "action": "append",
        "type": prior,
        "default": [],
        "help": "how far (1 sigma; mm, N, rad) a stated number may be wrong; 0 holds the number",
    },
    "--sigma": {"metavar": "MM", "type": length, "help": "reading error of a coordinate [{}]"},
    "--without": {
        "metavar": "MARK",
        "action": "append",
        "default": [],
        "help": "leave this mark out, for example because its reading is wrong",
    },
    "--port": {
        "metavar": "PATH",
        "help": "the machine's serial port [that of the only board on USB]",
    },
    "-o --output": {"metavar": "FILE", "help": "{}"},
    "--picture": {"metavar": "FILE", "help": "{}: .png, .svg or .pdf"},
    "--details": {**FLAG, "help": "also show {}"},
    "--units": {
        "choices": ("mm", "inch"),
        "help": "unit of the lengths on the screen [as places were typed]",
    },
    "--force": {**FLAG, "help": "replace files that plumb did not write"},
    "--json": {**FLAG, "help": "print a JSON object and nothing else"},
}
BOARD = ("settings", "marks", "--cut-with", "--controller")  # and how these were cut
PROGRAM = ("job", "settings", "--start", "--set")


def add_shared(parser: argparse.ArgumentParser, *names: str, **said: str) -> None:
    """Add shared arguments; with some goes what the command says of them."""
    words = {next(each for each in SHARED if each.endswith(f"--{name}")): name for name in said}
    for name in (*names, *words):
        argument = dict(SHARED[name])
        if name in words:
            argument["help"] = argument["help"].format(said[words[name]])
        parser.add_argument(*name.split(), **argument)


# Machine, marks and picture, as named on a command line.


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
