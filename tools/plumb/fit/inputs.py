"""Settings and readings of a board, as they go into a fit, a diagnosis and the proposals."""

import os
from collections.abc import Iterable, Mapping, Sequence
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
from plumb.model.catalogue import LAB_EFFECTS
from plumb.model.predict import RuleReading, known_effects, library
from plumb.settings import GRAVITY, FitRecord, MachineSettings, read_settings
from plumb.text.errors import InputError, to_do
from plumb.text.values import INCH, INCHES, MM, Unit, length_in, number_in


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


# Numbers that are measured by hand: what is read, and how the number follows.
#
# An effect brings its readings along; those of the frame are here. The steps and the accuracies are
# those of plumb next.


WEIGHT = "sled_weight"
WEIGHED = 0.2  # [kg] to which a sled is weighed


def readings(settings: MachineSettings, sled_weight: float) -> Mapping[str, RuleReading]:
    """Return the readings by the names of numbers, for this sheet and this weight [N]."""
    edge = settings.sheet_height / 2
    height = "how far the motors are above the sheet's top edge, the mean of both"
    read = {
        "motor_gap": RuleReading("the gap between the motors", 1.0),
        "motor_height": RuleReading(height, 1.0, zero=-edge),
        "rotation_radius": RuleReading("from the bit to the first link pin of a chain", 0.5),
        WEIGHT: RuleReading("the weight of the sled", WEIGHED, GRAVITY, "kg"),
    }
    for words in library():
        for parameter in words["parameters"]:
            if parameter["reading"]:
                reading = RuleReading(**parameter["reading"])
                factor = reading.factor * sled_weight ** words["weight_power"]
                read[f"{words['name']}.{parameter['name']}"] = replace(reading, factor=factor)
    for effect in LAB_EFFECTS:
        if effect.reading:
            read[effect.parameter] = effect.reading(*settings.sheet)
    return read


# A typed reading with the unit of its rule or scale.

VALUE = "VALUE"  # stands where the owner types his number
INCH_WORDS = ("inches", "inch", "in", '"')
UNITS = ("mm", *INCH_WORDS, "kg", "g", "degrees")


def to_fill_in(name: str, sigma: float, settings: MachineSettings, unit: Unit) -> str:
    """Return the words of --checked for a number that is measured next: `motor_gap=VALUE+-1mm`.

    sigma: of a number that is not read off a rule or scale [its unit].
    """
    reading = _reading_of(name, settings)
    if reading is None:
        return f"{name}={VALUE}+-{sigma:g}"
    if reading.unit == "mm" and unit == INCHES:
        return f"{name}={VALUE}+-{reading.usual / INCH:.1g}in"
    return f"{name}={VALUE}+-{reading.usual:g}{reading.unit}"


def what_to_type(names: Iterable[str], settings: MachineSettings, unit: Unit) -> str:
    """Return the word for VALUE, for people; "" for numbers that cannot be read."""
    read = [reading for name in names if (reading := _reading_of(name, settings))]
    if not read:
        return ""
    shown = "inches" if read[0].unit == "mm" and unit == INCHES else read[0].unit
    titles = "; then ".join(unit.reading(reading.title) for reading in read)
    return f"{VALUE}: {titles}, in {shown}."


def number_read(
    name: str, value: str, sigma: str, typed: str, settings: MachineSettings
) -> tuple[float, float]:
    """Return a number and its error [its unit] by what was read, in a unit of UNITS.

    Raises ValueError for text that is not a number, and for a unit that does not fit.
    """
    reading = _reading_of(name, settings)
    if reading is None:
        raise ValueError(f"this is not measured in {typed}: write the number without a unit")
    is_length = typed == "mm" or typed in INCH_WORDS
    if reading.unit != ("mm" if is_length else typed):
        raise ValueError(f"it is read in {reading.unit}, not in {typed}")
    if is_length:
        size = INCH if typed in INCH_WORDS else 1.0
        read, off = length_in(value, unit=size), length_in(sigma, unit=size)
    else:
        read, off = number_in(value), number_in(sigma)
    number, more, less = map(reading.value, (read, read + off, read - off))
    return number, max(abs(more - number), abs(number - less))


def _reading_of(name: str, settings: MachineSettings) -> RuleReading | None:
    return readings(settings, settings.sled_weight).get(name)
