"""The files that several commands read and write."""

from __future__ import annotations

import argparse
import os
from collections.abc import Sequence
from pathlib import Path

from plumb.fit.inputs import Inputs
from plumb.fit.known_boards import with_settings_in_force
from plumb.marks.read import join_measurements, read_marks
from plumb.model.predict import known_effects
from plumb.pictures.sheet import FORMATS
from plumb.settings.files import read_settings
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError, refusal
from plumb.text.shown import show_in


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
    parts = [with_settings_in_force(settings, part, cut_with=cut_with) for part in parts]
    measurements = join_measurements(parts)
    if "json" in arguments and not arguments.json:  # the functions of the package show nothing
        show_in(arguments.units or measurements.typed.unit)
    return Inputs(settings, measurements, cut_with=cut_with, controller=arguments.controller)


def _refuse_the_same_twice(paths: Sequence[str]) -> None:
    """A file given twice would pass for readings that repeat without any noise."""
    seen: set[str] = set()
    for path in paths:
        real = os.path.realpath(path)
        if real in seen:
            raise refusal(path, "is given twice", remedy="name each file of marks once")
        seen.add(real)


def picture_form(path: str, *, option: str = "--picture") -> str:
    """The form of a picture by its name's ending."""
    form = Path(path).suffix.lower().lstrip(".")
    if form not in FORMATS:
        raise InputError(f"{option} {path}: end the name with .{', .'.join(FORMATS)}")
    return form
