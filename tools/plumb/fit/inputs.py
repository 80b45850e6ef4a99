"""Settings and readings of a board, as they go into a fit, a diagnosis and the proposals."""

import os
from collections.abc import Mapping, Sequence
from dataclasses import KW_ONLY, dataclass, field, replace
from os import PathLike

from plumb.fit.fit import PRIORS, Checked
from plumb.fit.observations import (
    POSE_AXES,
    SHEET_ROTATION,
    ZERO_AXES,
    Observations,
    model_and_observations,
)
from plumb.marks.read import Measurements, join_measurements, read_marks
from plumb.model.predict import known_effects
from plumb.settings import FitRecord, MachineSettings, read_settings
from plumb.text.errors import InputError, to_do
from plumb.text.values import MM, Unit


@dataclass(frozen=True)
class Stated:
    """Stated accuracy of a reading."""

    sigma: float  # [mm]
    is_final: bool = False  # given to the command: it is used as it is, whatever repeats say


@dataclass(frozen=True)
class Inputs:
    """A machine as its settings say, what was measured, and what else is known."""

    settings: MachineSettings
    measurements: Measurements
    _: KW_ONLY
    cut_with: MachineSettings | None = None  # in force when the marks were cut; None: `settings`
    controller: str | None = None  # whose formula moved the sled; None: as marks or settings say
    # Standard deviations of the frame's numbers.
    priors: Mapping[str, float] = field(default_factory=lambda: PRIORS)
    sigma: float | None = None  # [mm] of one reading, used as it is; None: diagnosis/noise.py
    checked: Sequence[Checked] = ()  # numbers that were measured directly
    unit: Unit = MM  # of the lengths in what is said of it

    @property
    def stated(self) -> Stated | None:
        """Accuracy of a reading, as stated here or in the file of the marks."""
        if self.sigma:
            return Stated(self.sigma, is_final=True)
        tape = self.measurements.tape_sigma
        return Stated(tape) if tape else None

    def model_and_observations(self) -> tuple[MachineSettings, Observations]:
        """Our model of the settings, and what was observed; InputError for a bad target."""
        return model_and_observations(
            self.settings, self.measurements, cut_with=self.cut_with, controller=self.controller
        )


# What a fit is judged by, read from files: settings, marks, and the settings in force then.

AnyPath = str | PathLike[str]


def settings_in(path: AnyPath) -> MachineSettings:
    """Return the settings of a file, with effects of our library only."""
    return read_settings(path, known=known_effects())


def read_inputs(
    settings: AnyPath,
    marks: Sequence[AnyPath],
    *,
    cut_with: AnyPath | None = None,
    controller: str | None = None,
) -> Inputs:
    """Return a machine and its marks; several files of marks make one board. Raises InputError."""
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
    """Refuse a file that is given twice: it would pass for readings that repeat without any
    noise.
    """
    seen: set[str] = set()
    for path in paths:
        real = os.path.realpath(path)
        if real in seen:
            raise InputError(path, "is given twice", remedy="name each file of marks once")
        seen.add(real)


# Marks that the settings were fitted to: how they were cut, and where their sheet lay.
#
# The file of the settings keeps it, as no setting holds it. So the error that a fit promised can be
# seen again, and nobody takes fitted settings for those that the marks were cut with.


def with_settings_in_force(
    settings: MachineSettings, part: Measurements, *, cut_with: MachineSettings | None
) -> Measurements:
    """Return a file of marks with the settings that it was cut with, if the fit's record knows
    them.

    What the marks or `cut_with` say goes first. Raises InputError where nobody says it and the
    settings were fitted to marks of others: the settings after a fit are not those before.
    """
    record, file_round = settings.fitted, part.rounds[0]
    board = record.board(file_round.digest) if record else None
    if file_round.cut_with or cut_with:
        return part
    if board:
        return replace(part, rounds=(replace(file_round, cut_with=board.cut_with),))
    if file_round.changed:
        raise InputError(
            part.source,
            f"was cut with {file_round.changed}, which has changed since",
            place="cut_with",
            remedy=to_do(
                "give the settings that were in force with --cut-with, or correct cut_with",
                page="put the settings that were in force into the folder, and name them there",
            ),
        )
    needs_settings = any(mark.chains is None for mark in part.marks)
    if record and needs_settings and any(each.cut_with != settings for each in record.boards):
        name = settings.file.name if settings.file else "these settings"
        raise InputError(
            part.source,
            f"does not say which settings it was cut with, and {name} was fitted to marks that "
            f"were cut with {_others(record)}",
            remedy=to_do(
                f"give --cut-with SETTINGS ({name} itself if it was in force), or write cut_with "
                "in the marks.toml",
                page=f'write cut_with = "{name}" at the top of the form if it was in force, else '
                "the name of what was",
            ),
        )
    return part


def known_outside(
    settings: MachineSettings, measurements: Measurements, *, cut_with: MachineSettings | None
) -> dict[str, float]:
    """Return what the fit found outside of the machine, by the names of the fit's unknowns: how the
    sheet of each known board lay, how its chains were zeroed, and effects that no setting holds.
    """
    record = settings.fitted
    outside: dict[str, float] = {}
    if record is None:
        return outside
    for file_round in measurements.rounds:
        board = record.board(file_round.digest)
        in_force = file_round.cut_with or cut_with or settings
        if board is None or board.cut_with != in_force:
            continue
        outside[SHEET_ROTATION] = record.sheet_rotation
        outside |= {
            f"{effect}.{name}": size
            for effect, parameters in record.lab_effects.items()
            for name, size in parameters.items()
        }
        sheet, zero = file_round.sheet_group + 1, file_round.zero_group + 1
        names = [f"sheet{sheet}.{axis}" for axis in POSE_AXES]
        names += [f"zero{zero}.{axis}" for axis in ZERO_AXES]
        outside |= dict(zip(names, (*board.sheet, *board.zeros), strict=True))
    return outside


def _others(record: FitRecord) -> str:
    names = {board.cut_with.file.name for board in record.boards if board.cut_with.file}
    return " and ".join(sorted(names)) or "other settings"
