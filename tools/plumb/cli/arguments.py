"""The arguments that several commands share, and the values that they take."""

import argparse
import math
from collections.abc import Callable, Mapping
from contextlib import suppress
from pathlib import Path
from typing import Any, TypeVar

from plumb.settings.machine import CONTROLLERS
from plumb.text.files import ReadOnce, read_bytes
from plumb.text.values import MM, Unit, typed_length, unit_called

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


def _place(text: str) -> tuple[float, float]:
    x, y = map(typed_length, text.split(","))
    return x, y


any_length = kind(typed_length, "a length, like 100 or 4in")
length = kind(typed_length, "a length above zero, like 100 or 4in", lambda size: size > 0)
positive = kind(float, "a number above zero", lambda number: number > 0)
count = kind(int, "a whole number from 1 on, like 100", lambda number: number > 0)
prior = kind(_named, "NAME=SIGMA, like motor_gap=1.5", lambda named: named[1] >= 0)
held_size = kind(_named, "NAME=SIZE, a name and a number")
place = kind(_place, "X,Y, like 100,-50")  # [mm]
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
    "--sigma": {
        "metavar": "MM",
        "type": length,
        "help": "reading error of a coordinate [{}]",
    },
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
