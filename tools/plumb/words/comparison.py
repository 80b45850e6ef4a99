"""How far off the marks are: a headline, the worst in a few rows, or all."""

from collections.abc import Sequence

import numpy as np

from plumb.fit.compare import ComparedDistance, ComparedMark, Comparison
from plumb.fit.inputs import Inputs
from plumb.marks.model import Typed
from plumb.model.plain import plain_size, ranked
from plumb.settings import FitRecord
from plumb.text.errors import to_do
from plumb.text.values import Unit
from plumb.words import Part, Rows, Sentences

WORST, NOTES = 8, 2  # rows and sentences of a short answer
MARKS = ["mark", "target x", "y", "measured x", "y", "error x", "y", "length"]
DISTANCES = ["distance", "predicted", "measured", "error"]
ROUNDS = ["file", "readings", "marks, RMS", "distances, RMS", "date"]
FRAMES = (
    "from the sheet's top left corner, x right, y down",
    "from the middle of the sheet, x right, y up",
)


def conclusion(comparison: Comparison, unit: Unit) -> str:
    """Return how far off it is, in at most forty words."""
    if not comparison.marks:
        farthest = _worst_distances(comparison)[0]
        return (
            f"The distances are {unit.worded(comparison.rms)} RMS off. "
            f"The worst is {' - '.join(farthest.between)}: {unit.worded(comparison.worst)}."
        )
    said = (
        f"The marks lie {unit.worded(comparison.rms)} RMS from where the settings put them. "
        f"The worst is mark {_worst_marks(comparison)[0].name}: {unit.worded(comparison.worst)}."
    )
    if comparison.distance_rms is not None:
        said += f" The distances are {unit.worded(comparison.distance_rms)} RMS off."
    if comparison.shape_rms is not None:
        said += f" Moving the whole sheet would leave {unit.worded(comparison.shape_rms)}."
    return said


def readings_said(inputs: Inputs) -> str:
    """Return how many readings there are, on which sheet, and when they were taken."""
    measured = inputs.measurements
    counts = ((len(measured.measured_marks), "mark"), (len(measured.distances), "distance"))
    read = [f"{count} {noun}{'s' if count != 1 else ''}" for count, noun in counts if count]
    width, height = (inputs.unit.worded(length, 0) for length in inputs.settings.sheet)
    dates = ", ".join(dict.fromkeys(part.date for part in measured.rounds if part.date))
    when = f", measured {dates}" if dates else ""
    return f"{' and '.join(read)} on a sheet of {width} by {height}{when}"


def picture_title(comparison: Comparison) -> str:
    """Return the title of a picture of the errors."""
    worst = about(comparison.worst)
    return f"As the settings are: {about(comparison.rms)} mm RMS, worst {worst} mm"


def about(millimetres: float) -> str:
    """Return a length for the title of a picture: a decimal, two below a millimetre."""
    return f"{millimetres:.1f}" if millimetres >= 0.95 else f"{millimetres:.2f}"


def without_doubted(comparison: Comparison, unit: Unit) -> str:
    """Return how far off it is where readings that disagree were left out."""
    return f"{conclusion(comparison, unit)} That is without what disagrees."


def short(comparison: Comparison, inputs: Inputs) -> list[Part]:
    """Return what was compared in a few rows, the worst last, and what is to be known of it."""
    typed, unit = inputs.measurements.typed, inputs.unit
    if comparison.marks:
        marks = _worst_marks(comparison)[:WORST]
        header, rows = MARKS, [_mark_row(mark, typed, unit) for mark in reversed(marks)]
        left_out, said = len(comparison.marks) - len(marks), _all_in(inputs)
    else:
        distances = _worst_distances(comparison)[:WORST]
        header, rows = DISTANCES, [_distance_row(each, unit) for each in reversed(distances)]
        left_out, said = len(comparison.distances) - len(distances), f"All in {unit.name}."
    if left_out:
        are = "is" if left_out == 1 else "are"
        said += f" {left_out} more {are} off by less" + to_do("; --details shows them.", page=".")
    outside = outside_sentence(comparison.promised, unit) if comparison.promised else ""
    notes = [*filter(None, [outside]), *comparison.warnings][:NOTES]
    return [Rows(header, rows, note=said), *([Sentences(notes)] if notes else [])]


def full(comparison: Comparison, inputs: Inputs) -> list[Part]:
    """Return all that was compared."""
    typed, unit = inputs.measurements.typed, inputs.unit
    parts: list[Part] = []
    if comparison.promised:
        parts.append(Sentences([promised_sentence(comparison.promised, inputs)], ""))
    if comparison.warnings:
        parts.append(Sentences(comparison.warnings))
    if comparison.rounds:
        errors = [[*map(unit.bare, (each.rms, each.distance_rms))] for each in comparison.rounds]
        both = zip(comparison.rounds, errors, strict=True)
        parts.append(
            Rows(ROUNDS, [[cut.name, str(cut.count), *rms, cut.date] for cut, rms in both])
        )
    if comparison.marks:
        chains = [
            (each.left_chain_residual, each.right_chain_residual) for each in comparison.marks
        ]
        rows = [
            [*_mark_row(mark, typed, unit), *map(unit.signed, more)]
            for mark, more in zip(comparison.marks, chains, strict=True)
        ]
        meaning = (
            "Error: measured - predicted. Chains: how much more of each the measured place needs "
            f"than was paid out. {_all_in(inputs)}"
        )
        parts += [Rows([*MARKS, "left chain", "right"], rows), Sentences([meaning], "")]
    if comparison.distances:
        parts.append(Rows(DISTANCES, [_distance_row(each, unit) for each in comparison.distances]))
    moved = pose_sentence(comparison, inputs)
    return [*parts, Sentences([moved], "")] if moved else parts


def _all_in(inputs: Inputs) -> str:
    """Return the unit and the frame of the places."""
    return f"All in {inputs.unit.name}, {FRAMES[inputs.measurements.typed.sheet is None]}."


def _worst_marks(comparison: Comparison) -> Sequence[ComparedMark]:
    return ranked(comparison.marks, lambda mark: -mark.length)


def _worst_distances(comparison: Comparison) -> Sequence[ComparedDistance]:
    return ranked(comparison.distances, lambda distance: -abs(distance.error))


def _mark_row(mark: ComparedMark, typed: Typed, unit: Unit) -> list[str]:
    places = (*typed.place(mark.target), *typed.place(mark.measured))
    error = map(unit.signed, typed.shift(mark.error))
    return [mark.name, *(unit.bare(each, 1) for each in places), *error, unit.bare(mark.length)]


def _distance_row(distance: ComparedDistance, unit: Unit) -> list[str]:
    sizes = map(unit.bare, (distance.predicted, distance.measured))
    return [" - ".join(distance.between), *sizes, unit.signed(distance.error)]


def promised_sentence(record: FitRecord, inputs: Inputs) -> str:
    """Return what the settings' file knows of these marks."""
    names = [board.cut_with.file.name for board in record.boards if board.cut_with.file]
    cut = f", cut with {' and '.join(dict.fromkeys(names))}" if names else ""
    rise, unit = np.tan(record.sheet_rotation) * inputs.settings.sheet_width, inputs.unit
    without = f", without {', '.join(record.without)}" if record.without else ""
    said = (
        f"These settings were fitted to these marks{cut}: {unit.worded(record.rms)} RMS was left"
        f"{without}, {unit.bare(record.start_rms)} before."
    )
    if record.sheet_rotation:
        said += (
            f" The sheet counts as turned by {unit.signed(rise)} {unit.name} over its width, as "
            "the fit saw it."
        )
    outside = outside_sentence(record, unit)
    return f"{said} {outside}" if outside else said


def outside_sentence(record: FitRecord, unit: Unit) -> str:
    """Return what the fit found outside of the machine, which an error as set counts; "" for
    nothing.
    """
    sizes = [
        plain_size(f"{effect}.{name}", size, unit=unit)
        for effect, parameters in record.lab_effects.items()
        for name, size in parameters.items()
    ]
    return f"The error counts what the fit found: {'; '.join(sizes)}." if sizes else ""


def pose_sentence(comparison: Comparison, inputs: Inputs) -> str:
    """Return how the whole sheet would have to move to fit best; "" without marks."""
    shift, rotation = comparison.shift, comparison.rotation
    if comparison.shape_rms is None or shift is None or rotation is None:
        return ""
    unit, name = inputs.unit, inputs.unit.name
    across, up = map(unit.signed, inputs.measurements.typed.shift(shift))
    rise = unit.signed(np.tan(rotation) * inputs.settings.sheet_width)
    return (
        f"The sheet fits best when it is shifted by x {across}, y {up} {name}, and turned by "
        f"{rise} {name} over its width: {unit.worded(comparison.shape_rms)} RMS is left then."
    )
