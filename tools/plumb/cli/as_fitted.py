"""A check that marks cut with fitted settings lie where the fit promised, or what changed."""

import argparse
from dataclasses import replace

from plumb.cli.output import say_failure
from plumb.cli.screen import BAD, GOOD, headline, print_json, table
from plumb.diagnosis.explanation import FEWEST_NUMBERS
from plumb.diary.file import RECHECK, folder_of, keep, read_diary
from plumb.diary.recheck import Recheck, fit_of, recheck
from plumb.fit.inputs import Inputs
from plumb.job.home import HomeTouch, are_apart
from plumb.text.answers import json_of

SHOWN = 4  # changes


def checked_by_fit(inputs: Inputs, path: str) -> Recheck | None:
    """Hold marks that were cut with fitted settings against the fit in the diary next to them.

    None where there is no such question: other settings cut a mark, the fit has seen it, its diary
    is not here, or the marks are no two places.
    """
    settings, measured = inputs.settings, inputs.measurements
    record, folder = settings.fitted, folder_of(path)
    if record is None or folder is None or measured.distances:
        return None
    for each in measured.rounds:
        in_force = each.cut_with or inputs.cut_with or settings
        if record.board(each.digest) or replace(in_force, fitted=None) != replace(
            settings, fitted=None
        ):
            return None
    if any(mark.chains or mark.sled_weight for mark in measured.marks):
        return None
    touches = [HomeTouch(mark.name, where, mark.target) for mark, where in measured.readings]
    fit = fit_of(read_diary(folder), settings)
    if fit is None or not are_apart(touches):
        return None
    sigma = inputs.sigma or measured.tape_sigma
    return recheck(fit, settings, touches, sigma=sigma, unit=inputs.unit)


def is_all(checked: Recheck) -> bool:
    """Return whether this is all that can be said: the machine holds, or a fit needs more marks."""
    return checked.holds or 2 * len({mark.name for mark in checked.marks}) < FEWEST_NUMBERS


def report(arguments: argparse.Namespace, checked: Recheck) -> int:
    """Keep the answer in the diary, print it, and return the exit code."""
    say_failure(keep(arguments.settings, RECHECK, json_of(checked), begin=False))
    print_json(checked) if arguments.json else print(_text(checked))
    return int(not checked.holds)


def _text(checked: Recheck) -> str:
    unit = checked.unit
    rows = [
        [
            mark.name,
            f"{unit.bare(mark.hole[0], 1)}, {unit.bare(mark.hole[1], 1)}",
            ", ".join(map(unit.signed, mark.error)),
            unit.bare(mark.expected_mm),
        ]
        for mark in checked.marks
    ]
    marks = table(["mark", f"at [{unit.name}]", "error", "expected up to"], rows)
    if checked.holds:
        return f"{headline(f'{checked.sentence} Nothing was written.', GOOD)}\n\n{marks}"
    changes = [
        [change.words(unit), "yes" if change.explains else "no"]
        for change in checked.changes[:SHOWN]
    ]
    single = table(["a single change", "explains the marks"], changes)
    return "\n\n".join([headline(checked.sentence, BAD), marks, single])
