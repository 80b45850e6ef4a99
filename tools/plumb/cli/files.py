"""The files and options that several commands share."""

from __future__ import annotations

import argparse
import math
import os
from collections.abc import Mapping, Sequence
from pathlib import Path

from plumb.fit.inputs import Inputs
from plumb.marks.read import join_measurements, read_marks
from plumb.model.predict import known_effects
from plumb.pictures.sheet import FORMATS
from plumb.settings.files import read_settings
from plumb.settings.machine import CONTROLLERS, MachineSettings
from plumb.text.errors import InputError, refusal
from plumb.text.files import write_all


def add_settings(parser: argparse.ArgumentParser) -> None:
    """The argument SETTINGS."""
    parser.add_argument("settings", metavar="SETTINGS", help="groundcontrol.ini or machine.toml")


def add_marks(parser: argparse.ArgumentParser) -> None:
    """SETTINGS, MARKS and how the marks were cut."""
    add_settings(parser)
    parser.add_argument(
        "marks",
        metavar="MARKS",
        nargs="+",
        help="Calibration Measurements.ini, marks.toml or marks.csv; several make one board",
    )
    parser.add_argument(
        "--cut-with",
        metavar="SETTINGS",
        help="the settings in force when the marks were cut, if they are not SETTINGS",
    )
    add_controller(parser)


def add_controller(parser: argparse.ArgumentParser) -> None:
    """The option --controller."""
    parser.add_argument(
        "--controller",
        choices=CONTROLLERS,
        help="whose formula turned targets into chain lengths "
        "[what MARKS say, else stock for a groundcontrol.ini]",
    )


def add_prior(parser: argparse.ArgumentParser) -> None:
    """The option --prior."""
    parser.add_argument(
        "--prior",
        metavar="NAME=SIGMA",
        action="append",
        type=prior,
        default=[],
        help="how far (one sigma; mm, N, rad) a stated number may be wrong; 0 holds it",
    )


def add_sigma(parser: argparse.ArgumentParser, *, usual: str) -> None:
    """The option --sigma; `usual` says what holds without it."""
    parser.add_argument(
        "--sigma",
        metavar="MM",
        type=length,
        help=f"reading error of a coordinate [{usual}]",
    )


def add_json(parser: argparse.ArgumentParser) -> None:
    """The option --json."""
    parser.add_argument("--json", action="store_true", help="print a JSON object and nothing else")


def length(text: str) -> float:
    """A length above zero [mm]."""
    value = float(text)
    if not (math.isfinite(value) and value > 0):
        raise argparse.ArgumentTypeError(f"'{text}' is not a number above zero")
    return value


def limit(text: str) -> float:
    """A limit of zero or more."""
    value = float(text)
    if not (math.isfinite(value) and value >= 0):
        raise argparse.ArgumentTypeError(f"'{text}' is not a number of zero or more")
    return value


def prior(text: str) -> tuple[str, float]:
    """Reads NAME=SIGMA."""
    name, separator, value = text.partition("=")
    try:
        sigma = float(value)
    except ValueError:
        sigma = -1.0
    if not (separator and math.isfinite(sigma) and sigma >= 0):
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=SIGMA, like motor_gap=1.5")
    return name, sigma


def settings_in(path: str) -> MachineSettings:
    """The settings of a file, with effects of our library only."""
    return read_settings(path, known=known_effects())


def inputs_of(arguments: argparse.Namespace) -> Inputs:
    """Everything that a command with marks reads."""
    settings = settings_in(arguments.settings)
    cut_with = settings_in(arguments.cut_with) if arguments.cut_with else None
    # Marks count from the edges of the sheet on which they were cut.
    sheet = (cut_with or settings).sheet
    _refuse_the_same_twice(arguments.marks)
    known = known_effects()
    parts = [read_marks(path, sheet=sheet, known=known) for path in arguments.marks]
    measurements = join_measurements(parts)
    return Inputs(settings, measurements, cut_with=cut_with, controller=arguments.controller)


def _refuse_the_same_twice(paths: Sequence[str]) -> None:
    """A file given twice would pass for readings that repeat without any noise."""
    seen: set[str] = set()
    for path in paths:
        real = os.path.realpath(path)
        if real in seen:
            raise refusal(path, "is given twice", remedy="name each file of marks once")
        seen.add(real)


def write_outputs(files: Mapping[str, bytes], *, inputs: Sequence[str]) -> None:
    """Write all files or none; what was read is never overwritten."""
    taken = {os.path.realpath(path) for path in inputs}
    for path in files:
        if os.path.realpath(path) in taken:
            raise refusal(path, "is read here and kept", remedy="give the result another name")
    write_all(files)


def refuse_twins(*paths: str | None) -> None:
    """Refuse two results with the same name."""
    named = [os.path.realpath(path) for path in paths if path]
    for path in paths:
        if path and named.count(os.path.realpath(path)) > 1:
            raise refusal(path, "is the name of two results", remedy="give each another name")


def picture_form(path: str, *, option: str = "--picture") -> str:
    """The form of a picture by its name's ending."""
    form = Path(path).suffix.lower().lstrip(".")
    if form not in FORMATS:
        raise InputError(f"{option} {path}: end the name with .{', .'.join(FORMATS)}")
    return form
