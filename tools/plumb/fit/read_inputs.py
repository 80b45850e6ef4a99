"""What a fit is judged by, read from files: settings, marks, and the settings in force then."""

from __future__ import annotations

import os
from collections.abc import Sequence
from os import PathLike

from plumb.fit.inputs import Inputs
from plumb.fit.known_boards import with_settings_in_force
from plumb.marks.read import join_measurements, read_marks
from plumb.model.predict import known_effects
from plumb.settings.files import read_settings
from plumb.settings.machine import MachineSettings
from plumb.text.errors import refusal

AnyPath = str | PathLike[str]


def settings_in(path: AnyPath) -> MachineSettings:
    """The settings of a file, with effects of our library only."""
    return read_settings(path, known=known_effects())


def read_inputs(
    settings: AnyPath,
    marks: Sequence[AnyPath],
    *,
    cut_with: AnyPath | None = None,
    controller: str | None = None,
) -> Inputs:
    """A machine and its marks; several files of marks make one board. Raises InputError."""
    machine = settings_in(settings)
    in_force = settings_in(cut_with) if cut_with else None
    # Marks count from the edges of the sheet on which they were cut.
    sheet = (in_force or machine).sheet
    refuse_the_same_twice(marks)
    known = known_effects()
    parts = [read_marks(path, sheet=sheet, known=known) for path in marks]
    parts = [with_settings_in_force(machine, part, cut_with=in_force) for part in parts]
    measurements = join_measurements(parts)
    return Inputs(machine, measurements, cut_with=in_force, controller=controller)


def refuse_the_same_twice(paths: Sequence[AnyPath]) -> None:
    """A file given twice would pass for readings that repeat without any noise."""
    seen: set[str] = set()
    for path in paths:
        real = os.path.realpath(path)
        if real in seen:
            raise refusal(path, "is given twice", remedy="name each file of marks once")
        seen.add(real)
