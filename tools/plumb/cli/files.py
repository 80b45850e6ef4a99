"""The files that several commands read and write."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path

from plumb.cure.auto import without_marks
from plumb.fit.inputs import Inputs, read_inputs
from plumb.pictures.sheet import FORMATS
from plumb.text.errors import InputError
from plumb.text.values import show_in


def inputs_of(arguments: argparse.Namespace) -> Inputs:
    """Return everything that a command with marks reads; lengths are shown as the marks
    were typed.
    """
    inputs = read_inputs(
        arguments.settings,
        arguments.marks,
        cut_with=arguments.cut_with,
        controller=arguments.controller,
    )
    if not arguments.json:
        show_in(arguments.units or inputs.measurements.typed.unit)
    without = vars(arguments).get("without")
    marks = without_marks(inputs.measurements, without) if without else inputs.measurements
    return replace(inputs, measurements=marks)


def picture_form(path: str, *, option: str = "--picture") -> str:
    """Return the form of a picture by its name's ending."""
    form = Path(path).suffix.lower().lstrip(".")
    if form not in FORMATS:
        raise InputError(f"{option} {path}: end the name with .{', .'.join(FORMATS)}")
    return form
