"""`plumb compare`: how far the marks lie from where the settings predict them."""

import argparse

import numpy as np

from plumb.cli.arguments import BOARD, add_shared
from plumb.cli.inputs import inputs_of, picture_form
from plumb.cli.output import write_outputs
from plumb.cli.screen import (
    GOOD,
    OPEN,
    about,
    headline,
    next_step,
    print_json,
    same_inputs,
    sentences,
    table,
)
from plumb.fit.compare import ComparedDistance, ComparedMark, Comparison, compare
from plumb.fit.inputs import Inputs
from plumb.fit.problem import USUAL_SIGMA
from plumb.marks.model import Typed
from plumb.model.plain import plain_size, ranked
from plumb.pictures.drawing import Panel, draw
from plumb.settings.toml import FitRecord
from plumb.text.errors import InputError
from plumb.text.values import Unit

FRAMES = (
    "from the sheet's top left corner, x right, y down",
    "from the middle of the sheet, x right, y up",
)


def run(arguments: argparse.Namespace) -> int:
    """Compare, print, and return the exit code."""
    inputs = inputs_of(arguments)
    comparison = compare(inputs)
    if arguments.picture:
        form = picture_form(arguments.picture)
        panels = [panel_of(comparison)]
        drawn = draw(panels, sheet=inputs.settings.sheet, form=form)
        write_outputs({arguments.picture: drawn}, inputs=[arguments.settings, *arguments.marks])
    if arguments.json:
        print_json(comparison)
    else:
        facts = details(comparison, inputs) if arguments.details else worst_rows(comparison, inputs)
        kind = kind_of(comparison, inputs)
        verdict = headline(conclusion(comparison, inputs.unit), kind)
        following = next_step("What is missing:", ["calibrate", *same_inputs(arguments)])
        print("\n\n".join([*facts, verdict, following]))
    return 0


NOISY = 1.5  # times the error of a reading, up to which an RMS may be reading alone


def kind_of(comparison: Comparison, inputs: Inputs) -> str:
    """Return whether the RMS may be reading alone."""
    sigma = inputs.stated.sigma if inputs.stated else USUAL_SIGMA
    read = sigma * np.sqrt(2.0) if comparison.marks else sigma
    return GOOD if comparison.rms <= NOISY * read else OPEN


def panel_of(comparison: Comparison) -> Panel:
    """Return the comparison as a panel of a picture."""
    if not comparison.marks:
        raise InputError("--picture: there are distances only, so no errors to draw on a sheet")
    sizes = f"{about(comparison.rms)} mm RMS, worst {about(comparison.worst)} mm"
    return Panel(
        title=f"As the settings are: {sizes}",
        predicted=np.array([mark.predicted for mark in comparison.marks]),
        errors=np.array([mark.error for mark in comparison.marks]),
    )


WORST, NOTES = 8, 2  # rows and sentences of a short answer
MARKS = ["mark", "target x", "y", "measured x", "y", "error x", "y", "length"]
DISTANCES = ["distance", "predicted", "measured", "error"]


def worst_rows(comparison: Comparison, inputs: Inputs) -> list[str]:
    """Return what was compared in a few rows, the worst last."""
    typed, unit = inputs.measurements.typed, inputs.unit
    if comparison.marks:
        marks = ranked(comparison.marks, lambda mark: -mark.length)[:WORST]
        rows = table(MARKS, [_mark_row(mark, typed, unit) for mark in reversed(marks)])
        left_out = len(comparison.marks) - len(marks)
        said = f"All in {unit.name}, {FRAMES[typed.sheet is None]}."
    else:
        distances = ranked(comparison.distances, lambda distance: -abs(distance.error))[:WORST]
        rows = table(DISTANCES, [_distance_row(distance, unit) for distance in reversed(distances)])
        left_out = len(comparison.distances) - len(distances)
        said = f"All in {unit.name}."
    is_or_are = "is" if left_out == 1 else "are"
    more = f" {left_out} more {is_or_are} off by less; --details shows them." if left_out else ""
    parts = [f"{rows}\n{sentences([f'{said}{more}'], mark='')}"]
    outside = outside_sentence(comparison.promised, unit) if comparison.promised else ""
    notes = [*filter(None, [outside]), *comparison.warnings][:NOTES]
    return [*parts, sentences(notes)] if notes else parts


def details(comparison: Comparison, inputs: Inputs) -> list[str]:
    """Return all that was compared."""
    parts = []
    typed, unit = inputs.measurements.typed, inputs.unit
    if comparison.promised:
        parts.append(sentences([promised_sentence(comparison.promised, inputs)], mark=""))
    if comparison.warnings:
        parts.append(sentences(comparison.warnings))
    if comparison.rounds:
        parts.append(_rounds_table(comparison, unit))
    if comparison.marks:
        rows = [
            [
                *_mark_row(mark, typed, unit),
                unit.signed(mark.left_chain_residual),
                unit.signed(mark.right_chain_residual),
            ]
            for mark in comparison.marks
        ]
        parts.append(table([*MARKS, "left chain", "right"], rows))
        note = (
            "Error: measured - predicted. Chains: how much more of each the measured place needs "
            f"than was paid out. All in {unit.name}; {FRAMES[typed.sheet is None]}."
        )
        parts.append(sentences([note], mark=""))
    if comparison.distances:
        parts.append(table(DISTANCES, [_distance_row(each, unit) for each in comparison.distances]))
    moved = pose_sentence(comparison, inputs)
    return [*parts, sentences([moved], mark="")] if moved else parts


def _mark_row(mark: ComparedMark, typed: Typed, unit: Unit) -> list[str]:
    return [
        mark.name,
        *(
            unit.bare(value, 1)
            for place in (mark.target, mark.measured)
            for value in typed.place(place)
        ),
        *(unit.signed(value) for value in typed.shift(mark.error)),
        unit.bare(mark.length),
    ]


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


def conclusion(comparison: Comparison, unit: Unit) -> str:
    """Return how far off it is, in at most forty words."""
    if not comparison.marks:
        farthest = ranked(comparison.distances, lambda distance: -abs(distance.error))[0]
        return (
            f"The distances are {unit.worded(comparison.rms)} RMS off. "
            f"The worst is {' - '.join(farthest.between)}: {unit.worded(comparison.worst)}."
        )
    worst = ranked(comparison.marks, lambda mark: -mark.length)[0]
    said = (
        f"The marks lie {unit.worded(comparison.rms)} RMS from where the settings put them. "
        f"The worst is mark {worst.name}: {unit.worded(comparison.worst)}."
    )
    if comparison.distance_rms is not None:
        said += f" The distances are {unit.worded(comparison.distance_rms)} RMS off."
    if comparison.shape_rms is not None:
        said += f" Moving the whole sheet would leave {unit.worded(comparison.shape_rms)}."
    return said


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


def _rounds_table(comparison: Comparison, unit: Unit) -> str:
    rows = [
        [cut.name, str(cut.count), unit.bare(cut.rms), unit.bare(cut.distance_rms), cut.date]
        for cut in comparison.rounds
    ]
    return table(["file", "readings", "marks, RMS", "distances, RMS", "date"], rows)


# The arguments of `plumb compare`.

EXAMPLES = (
    "plumb compare groundcontrol.ini marks.toml",
    "plumb compare groundcontrol.ini marks.toml --picture errors.png",
)
EXIT = "Exit: 0 done; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb compare`."""
    add_shared(parser, *BOARD, "--units")
    add_shared(parser, picture="draw the errors")
    add_shared(parser, details="every mark, the chains, and how the sheet would have to move")
    add_shared(parser, "--force", "--json")
