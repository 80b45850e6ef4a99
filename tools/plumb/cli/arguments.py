"""The arguments that several commands share, and the values that they take."""

from __future__ import annotations

import argparse
import math
from pathlib import Path

from plumb.settings.machine import CONTROLLERS
from plumb.text.files import read_bytes
from plumb.text.values import typed_length


def add_settings(parser: argparse.ArgumentParser) -> None:
    """Add the argument SETTINGS."""
    parser.add_argument(
        "settings",
        metavar="SETTINGS",
        type=file,
        help="groundcontrol.ini, webcontrol.json or machine.toml",
    )


def add_marks(parser: argparse.ArgumentParser) -> None:
    """Add the arguments SETTINGS and MARKS, and how the marks were cut."""
    add_settings(parser)
    parser.add_argument(
        "marks",
        metavar="MARKS",
        type=file,
        nargs="+",
        help="Calibration Measurements.ini, marks.toml or marks.csv; several files count together",
    )
    add_cut_with(parser)
    add_controller(parser)


def add_cut_with(parser: argparse.ArgumentParser) -> None:
    """Add the option --cut-with."""
    parser.add_argument(
        "--cut-with",
        metavar="SETTINGS",
        type=file,
        help="the settings in force when the marks were cut, if they are not SETTINGS",
    )


def add_picture(parser: argparse.ArgumentParser, draws: str) -> None:
    """Add the option --picture; `draws` says what for."""
    parser.add_argument("--picture", metavar="FILE", help=f"{draws}: .png, .svg or .pdf")


def add_controller(parser: argparse.ArgumentParser) -> None:
    """Add the option --controller."""
    parser.add_argument(
        "--controller",
        choices=CONTROLLERS,
        help="the controller whose formula turned targets into chain lengths "
        "[what MARKS say, else stock for a groundcontrol.ini]",
    )


def add_prior(parser: argparse.ArgumentParser) -> None:
    """Add the option --prior."""
    parser.add_argument(
        "--prior",
        metavar="NAME=SIGMA",
        action="append",
        type=prior,
        default=[],
        help="how far (1 sigma; mm, N, rad) a stated number may be wrong; 0 holds the number",
    )


def add_sigma(parser: argparse.ArgumentParser, *, usual: str) -> None:
    """Add the option --sigma; `usual` says what holds without it."""
    parser.add_argument(
        "--sigma",
        metavar="MM",
        type=length,
        help=f"reading error of a coordinate [{usual}]",
    )


def add_without(parser: argparse.ArgumentParser) -> None:
    """Add the option --without."""
    parser.add_argument(
        "--without",
        metavar="MARK",
        action="append",
        default=[],
        help="leave this mark out, for example because its reading is wrong",
    )


def add_units(parser: argparse.ArgumentParser) -> None:
    """Add the option --units."""
    parser.add_argument(
        "--units",
        choices=("mm", "inch"),
        help="unit of the lengths on the screen [as places were typed]",
    )


def add_json(parser: argparse.ArgumentParser) -> None:
    """Add the option --json."""
    parser.add_argument("--json", action="store_true", help="print a JSON object and nothing else")


def add_details(parser: argparse.ArgumentParser, what: str) -> None:
    """Add the option --details; `what` says what it shows."""
    parser.add_argument("--details", action="store_true", help=f"also show {what}")


def add_force(parser: argparse.ArgumentParser) -> None:
    """Add the option --force."""
    parser.add_argument(
        "--force", action="store_true", help="replace files that plumb did not write"
    )


def file(path: str) -> str:
    """Return the name of a file that exists; another is refused before the model is loaded."""
    if not Path(path).exists() or Path(path).is_dir():
        read_bytes(path)  # refuses it; what comes through a pipe is read only once, and later
    return path


def length(text: str) -> float:
    """Return a length above zero [mm], typed in mm or with its unit."""
    try:
        value = typed_length(text)
    except ValueError:
        value = math.nan
    if not (math.isfinite(value) and value > 0):
        raise argparse.ArgumentTypeError(f"'{text}' is not a length above zero, like 100 or 4in")
    return value


def positive(text: str) -> float:
    """Return a number above zero."""
    value = float(text)
    if not (math.isfinite(value) and value > 0):
        raise argparse.ArgumentTypeError(f"'{text}' is not a number above zero")
    return value


def count(text: str) -> int:
    """Return a whole number from 1 on."""
    number = int(text) if text.isdecimal() else -1
    if number == 0:
        raise argparse.ArgumentTypeError("'0' is too low: it counts from 1")
    if number < 1:
        raise argparse.ArgumentTypeError(f"'{text}' is not a whole number, like 100")
    return number


def limit(text: str) -> float:
    """Return a limit of zero or more."""
    value = float(text)
    if not (math.isfinite(value) and value >= 0):
        raise argparse.ArgumentTypeError(f"'{text}' is not a number of zero or more")
    return value


def prior(text: str) -> tuple[str, float]:
    """Read NAME=SIGMA."""
    name, sigma = named_number(text)
    if sigma is None or sigma < 0:
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=SIGMA, like motor_gap=1.5")
    return name, sigma


def named_number(text: str) -> tuple[str, float | None]:
    """Return a name and the number behind its =; None if there is no such number."""
    name, _, value = text.partition("=")
    try:
        number = float(value)
    except ValueError:
        return name, None
    return name, number if math.isfinite(number) else None


def add_port(parser: argparse.ArgumentParser) -> None:
    """Add the option --port."""
    parser.add_argument(
        "--port", metavar="PATH", help="the machine's serial port [that of the only board on USB]"
    )


# What commands on a job share: the program, the machine, where it begins.


def add_machine(parser: argparse.ArgumentParser) -> None:
    """JOB, SETTINGS, --start and --set."""
    parser.add_argument("job", metavar="JOB", type=file, help="a program of G-code")
    add_settings(parser)
    parser.add_argument(
        "--start",
        metavar="X,Y",
        type=place,
        default=(0.0, 0.0),
        help="where the bit is when the program begins, mm or like 4in,-2in from mid sheet [0,0]",
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
    """Read X,Y [mm], typed in mm or with their units."""
    try:
        x, y = map(typed_length, text.split(","))
    except ValueError:
        x = y = math.nan
    if not (math.isfinite(x) and math.isfinite(y)):
        raise argparse.ArgumentTypeError(f"'{text}' is not X,Y, like 100,-50")
    return x, y


def number(text: str) -> tuple[int, float]:
    """Read N=VALUE."""
    name, _, value = text.lstrip("$").partition("=")
    try:
        pair = int(name), float(value)
    except ValueError:
        pair = -1, math.nan
    if not (0 <= pair[0] <= 255 and math.isfinite(pair[1])):
        raise argparse.ArgumentTypeError(f"'{text}' is not N=VALUE, like 15=800")
    return pair
