"""`plumb recheck --check`: marks that no fit has seen, held against the fit of the others."""

from __future__ import annotations

import argparse
from typing import Any

from plumb.cli.checked import with_stated
from plumb.cli.files import inputs_of
from plumb.cli.output import say_failure
from plumb.cli.screen import headline, table
from plumb.cli.text import print_json
from plumb.diagnosis.check_marks import Check, check_marks
from plumb.diagnosis.check_sentence import check_sentence
from plumb.diary.entries import RECHECK
from plumb.diary.keeping import keep
from plumb.fit.read_inputs import refuse_the_same_twice
from plumb.marks.read import read_marks
from plumb.model.predict import known_effects
from plumb.text.errors import InputError
from plumb.text.shown import bare, signed, unit


def held_against_marks(arguments: argparse.Namespace) -> int:
    """Judge the check marks, print, and return the exit code."""
    if arguments.touch:
        raise InputError("--touch and --check are two ways: give --check alone, or --touch twice")
    if not arguments.marks:
        raise InputError(
            f"--check {arguments.check}: give the marks to which {arguments.settings} was fitted"
        )
    refuse_the_same_twice([*arguments.marks, arguments.check])
    inputs = with_stated(inputs_of(arguments), arguments)
    if inputs.settings.fitted is None:
        raise InputError(f"{arguments.settings} was fitted to no marks: give what plumb add wrote")
    marks = read_marks(arguments.check, sheet=inputs.settings.sheet, known=known_effects())
    checked = check_marks(inputs, marks)
    return report(arguments, _json(checked), _text(checked))


def report(arguments: argparse.Namespace, answer: dict[str, Any], text: str) -> int:
    """Keep a recheck's answer in the diary, print it, and return the exit code."""
    say_failure(keep(arguments.settings, RECHECK, answer, begin=False))
    if arguments.json:
        print_json(answer)
    else:
        print(text)
    return int(not answer["holds"])


def _text(checked: Check) -> str:
    rows = [
        [
            mark.name,
            f"{bare(mark.measured[0], 1)}, {bare(mark.measured[1], 1)}",
            ", ".join(map(signed, mark.miss)),
            bare(mark.promised),
        ]
        for mark in checked.marks
    ]
    parts = [headline(check_sentence(checked))]
    parts.append(table(["mark", f"at [{unit()}]", "error", "expected up to"], rows))
    return "\n\n".join(parts)


def _json(checked: Check) -> dict[str, Any]:
    return {
        "holds": checked.holds,
        "sentence": check_sentence(checked),
        "fit": None,
        "chi_square": checked.chi_square,
        "limit": checked.limit,
        "sheet_turned_rad": None,
        "marks": [
            {
                "name": mark.name,
                "hole": mark.measured,
                "error": mark.miss,
                "expected_mm": mark.promised,
            }
            for mark in checked.marks
        ],
        "changes": [],
    }
