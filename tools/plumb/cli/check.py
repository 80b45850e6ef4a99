"""`plumb check`: runs a program dry, and says what to expect of it."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np

from plumb.cli.check_text import as_text
from plumb.cli.files import inputs_of, picture_form
from plumb.cli.output import refuse_twins, write_outputs
from plumb.cli.screen import bar
from plumb.cli.text import print_json
from plumb.fit.read_inputs import settings_in
from plumb.jobs.check import Checked, check_job
from plumb.jobs.expected import Error, PartErrors
from plumb.jobs.outline import outline_of
from plumb.model.predict import USABLE
from plumb.pictures.job import Drawn, draw_job
from plumb.settings.machine import MachineSettings
from plumb.text.files import read_text

NAMED = 30  # parts that get their number in the picture


def run(arguments: argparse.Namespace) -> int:
    """Check, draw, print, and return the exit code."""
    refuse_twins(arguments.picture, arguments.outline)
    form = picture_form(arguments.picture) if arguments.picture else ""
    settings = settings_in(arguments.settings)
    arguments.controller = None
    checked = check_job(
        settings,
        read_text(arguments.job).splitlines(),
        inputs=inputs_of(arguments) if arguments.marks else None,
        numbers=dict(arguments.set),
        start=(*arguments.start, 0.0),
        progress=bar("running the program dry"),
    )
    files = {}
    if arguments.picture:
        files[arguments.picture] = draw_job(_drawn(checked, settings, arguments.job), form=form)
    if arguments.outline:
        over_sheet = checked.done.moves.only(checked.done.moves.over_sheet)
        outline = outline_of(over_sheet, checked.samples, name=Path(arguments.job).name)
        files[arguments.outline] = outline.encode()
    write_outputs(files, inputs=[arguments.job, arguments.settings, *arguments.marks])
    if arguments.json:
        print_json(as_json(checked, written=list(files)))
    else:
        print(as_text(checked, arguments))
    return 0 if checked.is_good else 1


def as_json(checked: Checked, *, written: list[str]) -> dict[str, Any]:
    """The check by the names of the interface."""
    times, hanging = checked.times, checked.hanging
    return {
        "good": checked.is_good,
        "halted_at": checked.done.halted_at,
        "moves": len(checked.done.moves),
        "seconds": times.whole,
        "cutting_seconds": times.cutting,
        "rapid_seconds": times.rapid,
        "asked_seconds": times.asked,
        "findings": [
            {"line": each.line, "kind": each.kind, "says": each.says, "wrong": each.is_wrong}
            for each in checked.findings
        ],
        "slower": [
            {
                "because": each.because,
                "moves": each.moves,
                "line": each.line,
                "asked_mm_min": each.asked,
                "feed_mm_min": each.feed,
            }
            for each in checked.slower
        ],
        "hanging": hanging
        and {
            "tension_n": hanging.tension,
            "give_mm_per_n": hanging.give,
            "give_line": hanging.give_line,
            "bad": [
                {
                    "verdict": each.verdict,
                    "lines": each.lines,
                    "first_line": each.first,
                    "share": each.share,
                }
                for each in hanging.bad
            ],
            "assumed": hanging.assumed,
        },
        "parts": _parts_json(checked),
        "written": written,
    }


def _parts_json(checked: Checked) -> list[dict[str, Any]]:
    errors = checked.errors or (PartErrors(None, None, None),) * len(checked.parts)
    return [
        {
            "first_line": part.lines[0],
            "last_line": part.lines[1],
            "low": part.low,
            "high": part.high,
            "deepest": part.deepest,
            "width_error": _error_json(error.width),
            "height_error": _error_json(error.height),
            "skew": _error_json(error.skew),
        }
        for part, error in zip(checked.parts, errors, strict=True)
    ]


def _error_json(error: Error | None) -> dict[str, float] | None:
    return None if error is None else {"mm": error.mm, "within": error.within}


def _drawn(checked: Checked, settings: MachineSettings, name: str) -> Drawn:
    moves, samples = checked.done.moves, checked.samples
    over_sheet = moves.only(moves.over_sheet)
    ways = np.split(samples.places, np.flatnonzero(np.diff(samples.move)) + 1)
    spoiled = {finding.line for finding in checked.findings if finding.is_wrong}
    bad = np.isin(over_sheet["line"], list(spoiled))
    if checked.hanging is not None:
        # Above the sheet the sled may pass where it could not cut.
        passing = np.unique(samples.move[checked.hanging.verdict != USABLE])
        bad[passing] |= over_sheet.cut[passing]
    kinds = np.where(bad, "bad", np.where(over_sheet.cut, "cut", "rapid"))
    labels = [
        ((part.low[0] + part.high[0]) / 2, (part.low[1] + part.high[1]) / 2, str(number))
        for number, part in enumerate(checked.parts[:NAMED], start=1)
    ]
    verdict = "nothing is wrong" if checked.is_good else "something is wrong"
    return Drawn(
        title=f"{Path(name).name}: {verdict}",
        is_good=checked.is_good,
        sheet=settings.sheet,
        ways={
            kind: [way for way, each in zip(ways, kinds, strict=True) if each == kind]
            for kind in ("cut", "rapid", "bad")
        },
        labels=labels,
    )
