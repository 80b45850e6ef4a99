"""`plumb compare`: how far the marks lie from where the settings predict them."""

from __future__ import annotations

import argparse
from typing import Any

import numpy as np

from plumb.cli.files import (
    add_json,
    add_marks,
    inputs_of,
    length,
    picture_form,
    write_outputs,
)
from plumb.cli.text import about, millimetres, print_json, sentences, signed, table
from plumb.fit.compare import Comparison, compare
from plumb.marks.score import Score
from plumb.pictures.sheet import Panel, draw
from plumb.text.errors import InputError

HELP = "how far the marks lie from where the settings predict them"
EXIT = "Exit: 0 done; 1 the RMS is above --limit; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb compare`."""
    add_marks(parser)
    parser.add_argument("--limit", metavar="MM", type=length, help="exit 1 if the RMS is above it")
    parser.add_argument("--picture", metavar="FILE", help="draw the errors: .png, .svg or .pdf")
    add_json(parser)


def run(arguments: argparse.Namespace) -> int:
    """Compare, print, and return the exit code."""
    inputs = inputs_of(arguments)
    found = compare(
        inputs.settings,
        inputs.measurements,
        cut_with=inputs.cut_with,
        controller=arguments.controller,
    )
    if arguments.picture:
        form = picture_form(arguments.picture)
        drawn = draw([panel_of(found)], sheet=inputs.settings.sheet, form=form)
        write_outputs({arguments.picture: drawn}, inputs=[arguments.settings, *arguments.marks])
    if arguments.json:
        print_json(as_json(found))
    else:
        print(as_text(found, sheet_width=inputs.settings.sheet_width))
    return int(arguments.limit is not None and found.rms > arguments.limit)


def panel_of(found: Comparison, *, when: str = "As the settings are", good: bool = False) -> Panel:
    """The comparison as a panel of a picture."""
    if not found.marks:
        raise InputError("--picture: there are distances only, so no errors to draw on a sheet")
    return Panel(
        title=f"{when}: {about(found.rms)} mm RMS, worst {about(found.worst)} mm",
        predicted=np.array([mark.predicted for mark in found.marks]),
        errors=np.array([mark.error for mark in found.marks]),
        good=good,
    )


def as_json(found: Comparison) -> dict[str, Any]:
    """The comparison by the names of the interface."""
    return {
        "rms_mm": found.rms,
        "worst_mm": found.worst,
        "shape_rms_mm": found.shape_rms,
        "distance_rms_mm": found.distance_rms,
        "shift": found.shift,
        "rotation": found.rotation,
        "marks": [
            {
                "name": mark.name,
                "target": mark.target,
                "predicted": mark.predicted,
                "measured": mark.measured,
                "error": mark.error,
                "left_chain_residual": mark.left_chain_residual,
                "right_chain_residual": mark.right_chain_residual,
            }
            for mark in found.marks
        ],
        "distances": [
            {
                "between": one.between,
                "predicted": one.predicted,
                "measured": one.measured,
                "error": one.error,
            }
            for one in found.distances
        ],
        "rounds": [
            {
                "name": one.name,
                "date": one.date,
                "count": one.count,
                "rms_mm": one.rms,
                "distance_rms_mm": one.distance_rms,
            }
            for one in found.rounds
        ],
        "benchmark": score_json(found.benchmark),
        "benchmark_left": score_json(found.benchmark_left),
        "warnings": found.warnings,
    }


def score_json(score: Score | None) -> dict[str, Any] | None:
    """A benchmark score by the names of the interface."""
    if score is None:
        return None
    return {
        "long_mm": score.long,
        "small_mm": score.small,
        "long_count": score.long_count,
        "small_count": score.small_count,
    }


def as_text(found: Comparison, *, sheet_width: float) -> str:
    """The comparison for people, its conclusion first."""
    parts = [_conclusion(found, sheet_width)]
    if found.benchmark:
        parts.append(sentences([benchmark_sentence(found)], mark=""))
    if found.warnings:
        parts.append(sentences(found.warnings))
    if found.rounds:
        parts.append(_rounds_table(found))
    if found.marks:
        parts.append(_marks_table(found))
        parts.append(
            "Error: measured - predicted. Chains: how much more of each the measured place needs\n"
            "than was paid out. All in mm; from the middle of the sheet, x right, y up."
        )
    if found.distances:
        rows = [
            [
                " - ".join(one.between),
                millimetres(one.predicted),
                millimetres(one.measured),
                signed(one.error),
            ]
            for one in found.distances
        ]
        parts.append(table(["distance", "predicted", "measured", "error"], rows))
    return "\n\n".join(parts)


def benchmark_sentence(found: Comparison) -> str:
    """The community's score for people."""
    part = "" if found.benchmark.complete else " (of a part of its readings)"
    return (
        f"Calibration Benchmark Score{part}: {found.benchmark} as cut (mean error of the long "
        f"spans and of the 100 mm squares); these settings leave {found.benchmark_left} open."
    )


def _conclusion(found: Comparison, sheet_width: float) -> str:
    if not found.marks:
        worst = max(found.distances, key=lambda one: abs(one.error))
        return (
            f"The distances are {found.rms:.2f} mm RMS from what the settings predict, "
            f"worst {found.worst:.2f} mm ({' - '.join(worst.between)})."
        )
    worst = max(found.marks, key=lambda mark: mark.length)
    lines = [
        f"The marks lie {found.rms:.2f} mm RMS from where the settings predict them, "
        f"worst {found.worst:.2f} mm (mark {worst.name})."
    ]
    if found.shape_rms is not None:
        rise = np.tan(found.rotation) * sheet_width
        lines.append(
            f"{found.shape_rms:.2f} mm RMS of that is shape: it stays when all marks together are "
            "shifted\n"
            f"(x {found.shift[0]:+.2f}, y {found.shift[1]:+.2f} mm) and turned ({rise:+.2f} mm over"
            " the sheet's width)."
        )
    if found.distance_rms is not None:
        lines.append(f"The distances between marks are {found.distance_rms:.2f} mm RMS off.")
    return "\n".join(lines)


def _rounds_table(found: Comparison) -> str:
    rows = [
        [one.name, str(one.count), millimetres(one.rms), millimetres(one.distance_rms), one.date]
        for one in found.rounds
    ]
    return table(["file", "readings", "marks, RMS", "distances, RMS", "date"], rows)


def _marks_table(found: Comparison) -> str:
    rows = [
        [
            mark.name,
            *(millimetres(value, 1) for value in (*mark.target, *mark.measured)),
            *(signed(value) for value in mark.error),
            millimetres(mark.length),
            signed(mark.left_chain_residual),
            signed(mark.right_chain_residual),
        ]
        for mark in found.marks
    ]
    header = ["mark", "target x", "y", "measured x", "y", "error x", "y", "length"]
    return table([*header, "left chain", "right"], rows)
