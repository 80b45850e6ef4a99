"""`plumb compare`: how far the marks lie from where the settings predict them."""

from __future__ import annotations

import argparse

import numpy as np

from plumb.cli.arguments import add_force, add_json, add_marks, add_picture, add_units, length
from plumb.cli.inputs import inputs_of, picture_form
from plumb.cli.output import write_outputs
from plumb.cli.screen import about, next_step, print_json, same_inputs, sentences, table
from plumb.fit.compare import Comparison, compare
from plumb.marks.benchmark import Score
from plumb.marks.model import Typed
from plumb.model.plain import plain_size, ranked
from plumb.pictures.scale import Panel
from plumb.pictures.sheet import draw
from plumb.settings.toml import FitRecord
from plumb.text.errors import InputError
from plumb.text.values import bare, signed, unit, worded

MACHINE = Typed()  # places count from the middle of the sheet
FRAMES = (
    "from the sheet's top left corner, x right, y down",
    "from the middle of the sheet, x right, y up",
)


def run(arguments: argparse.Namespace) -> int:
    """Compare, print, and return the exit code."""
    inputs = inputs_of(arguments)
    comparison = compare(inputs)
    if arguments.names and not arguments.picture:
        raise InputError("--names is for the picture: add --picture")
    if arguments.picture:
        form = picture_form(arguments.picture)
        drawn = draw(
            panel_of(comparison), sheet=inputs.settings.sheet, form=form, names=arguments.names
        )
        write_outputs({arguments.picture: drawn}, inputs=[arguments.settings, *arguments.marks])
    if arguments.json:
        print_json(comparison)
    else:
        sheet_width, typed = inputs.settings.sheet_width, inputs.measurements.typed
        print(as_text(comparison, sheet_width=sheet_width, typed=typed))
        print(f"\n{next_step('What is missing:', ['calibrate', *same_inputs(arguments)])}")
    return int(arguments.limit is not None and comparison.rms > arguments.limit)


def panel_of(
    comparison: Comparison, *, when: str = "As the settings are", good: bool = False
) -> Panel:
    """Return the comparison as a panel of a picture."""
    if not comparison.marks:
        raise InputError("--picture: there are distances only, so no errors to draw on a sheet")
    return Panel(
        title=f"{when}: {about(comparison.rms)} mm RMS, worst {about(comparison.worst)} mm",
        predicted=np.array([mark.predicted for mark in comparison.marks]),
        errors=np.array([mark.error for mark in comparison.marks]),
        good=good,
        names=tuple(mark.name for mark in comparison.marks),
    )


def as_text(comparison: Comparison, *, sheet_width: float, typed: Typed = MACHINE) -> str:
    """Return the comparison for people, its conclusion first."""
    parts = [conclusion(comparison, sheet_width, typed)]
    if comparison.promised:
        parts.append(sentences([promised_sentence(comparison.promised, sheet_width)], mark=""))
    if comparison.benchmark:
        score = benchmark_sentence(comparison.benchmark, comparison.benchmark_left)
        parts.append(sentences([score], mark=""))
    if comparison.warnings:
        parts.append(sentences(comparison.warnings))
    if comparison.rounds:
        parts.append(_rounds_table(comparison))
    if comparison.marks:
        parts.append(_marks_table(comparison, typed))
        note = (
            "Error: measured - predicted. Chains: how much more of each the measured place needs "
            f"than was paid out. All in {unit()}; {FRAMES[typed.sheet is None]}."
        )
        parts.append(sentences([note], mark=""))
    if comparison.distances:
        rows = [
            [
                " - ".join(distance.between),
                bare(distance.predicted),
                bare(distance.measured),
                signed(distance.error),
            ]
            for distance in comparison.distances
        ]
        parts.append(table(["distance", "predicted", "measured", "error"], rows))
    return "\n\n".join(parts)


def promised_sentence(record: FitRecord, sheet_width: float) -> str:
    """Return what the settings' file knows of these marks."""
    names = [board.cut_with.file.name for board in record.boards if board.cut_with.file]
    cut = f", cut with {' and '.join(dict.fromkeys(names))}" if names else ""
    rise = np.tan(record.sheet_rotation) * sheet_width
    without = f", without {', '.join(record.without)}" if record.without else ""
    said = (
        f"These settings were fitted to these marks{cut}: {worded(record.rms)} RMS was left"
        f"{without}, {bare(record.start_rms)} before."
    )
    if record.sheet_rotation:
        said += (
            f" The sheet counts as turned by {signed(rise)} {unit()} over its width, as the fit "
            "saw it."
        )
    outside = outside_sentence(record)
    return f"{said} {outside}" if outside else said


def outside_sentence(record: FitRecord) -> str:
    """Return what the fit found outside of the machine, which an error as set counts; "" for
    nothing.
    """
    sizes = [
        plain_size(f"{effect}.{name}", size)
        for effect, parameters in record.lab_effects.items()
        for name, size in parameters.items()
    ]
    return f"The error counts what the fit found: {'; '.join(sizes)}." if sizes else ""


def benchmark_sentence(score: Score, left: Score | None) -> str:
    """Return the community's score for people."""
    part = "" if score.complete else " (of a part of its readings)"
    return (
        f"Calibration Benchmark Score{part}: {score} as cut (mean error of the long "
        f"spans and of the 100 mm squares); these settings leave {left} open."
    )


def conclusion(comparison: Comparison, sheet_width: float, typed: Typed = MACHINE) -> str:
    if not comparison.marks:
        farthest = ranked(comparison.distances, lambda distance: -abs(distance.error))[0]
        return (
            f"The distances are {worded(comparison.rms)} RMS from what the settings predict, "
            f"worst {worded(comparison.worst)} ({' - '.join(farthest.between)})."
        )
    worst = ranked(comparison.marks, lambda mark: -mark.length)[0]
    said = [
        f"The marks lie {worded(comparison.rms)} RMS from where the settings predict them, "
        f"worst {worded(comparison.worst)} (mark {worst.name})."
    ]
    shape, shift, rotation = comparison.shape_rms, comparison.shift, comparison.rotation
    if shape is not None and shift is not None and rotation is not None:
        rise = np.tan(rotation) * sheet_width
        across, up = typed.shift(shift)
        said.append(
            f"{worded(shape)} RMS of that is shape: it stays when all marks together are "
            f"shifted (x {signed(across)}, y {signed(up)} {unit()}) and turned "
            f"({signed(rise)} {unit()} over the sheet's width)."
        )
    if comparison.distance_rms is not None:
        said.append(f"The distances between marks are {worded(comparison.distance_rms)} RMS off.")
    return sentences(said, mark="")


def _rounds_table(comparison: Comparison) -> str:
    rows = [
        [cut.name, str(cut.count), bare(cut.rms), bare(cut.distance_rms), cut.date]
        for cut in comparison.rounds
    ]
    return table(["file", "readings", "marks, RMS", "distances, RMS", "date"], rows)


def _marks_table(comparison: Comparison, typed: Typed) -> str:
    rows = [
        [
            mark.name,
            *(bare(value, 1) for value in (*typed.place(mark.target), *typed.place(mark.measured))),
            *(signed(value) for value in typed.shift(mark.error)),
            bare(mark.length),
            signed(mark.left_chain_residual),
            signed(mark.right_chain_residual),
        ]
        for mark in comparison.marks
    ]
    header = ["mark", "target x", "y", "measured x", "y", "error x", "y", "length"]
    return table([*header, "left chain", "right"], rows)


# The arguments of `plumb compare`.

EXAMPLES = (
    "plumb compare groundcontrol.ini marks.toml",
    "plumb compare groundcontrol.ini marks.toml --picture errors.png --names",
)
EXIT = "Exit: 0 done; 1 the RMS is above --limit; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb compare`."""
    add_marks(parser)
    parser.add_argument(
        "--limit", metavar="MM", type=length, help="exit with code 1 if the RMS is above MM"
    )
    add_units(parser)
    add_picture(parser, "draw the errors")
    parser.add_argument(
        "--names", action="store_true", help="write the marks' names into the picture"
    )
    add_force(parser)
    add_json(parser)
