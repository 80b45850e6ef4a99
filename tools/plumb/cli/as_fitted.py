"""A check that marks cut with fitted settings lie where the fit promised, or what changed."""

import argparse
from dataclasses import replace
from pathlib import Path

from plumb.cli.output import say_failure
from plumb.cli.screen import headline, in_text, print_json
from plumb.diagnosis.explanation import FEWEST_NUMBERS
from plumb.diary.file import RECHECK, folder_of, keep, read_diary
from plumb.diary.recheck import MeasuredMark, Recheck, are_apart, fit_of, recheck
from plumb.fit.inputs import Inputs
from plumb.words.recheck import RecheckAnswer, in_words
from plumb.words.states import KINDS


def checked_by_fit(inputs: Inputs, path: str) -> RecheckAnswer | None:
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
    marks = [MeasuredMark(mark.name, where, mark.target) for mark, where in measured.readings]
    fit = fit_of(read_diary(folder), settings)
    if fit is None or not are_apart(marks):
        return None
    sigma = inputs.sigma or measured.tape_sigma
    return in_words(recheck(fit, settings, marks, sigma=sigma, unit=inputs.unit))


def is_all(checked: Recheck) -> bool:
    """Return whether this is all that can be said: the machine holds, or a fit needs more marks."""
    return checked.holds or 2 * len({mark.name for mark in checked.marks}) < FEWEST_NUMBERS


def report(arguments: argparse.Namespace, checked: RecheckAnswer) -> int:
    """Keep the answer in the diary, print it, and return the exit code."""
    names = (Path(path).name for path in (*arguments.marks, arguments.settings))
    *forms, machine = names
    entry = checked.entry(" and ".join(forms), machine)
    say_failure(keep(arguments.settings, RECHECK, entry, begin=False))
    if arguments.json:
        print_json(checked)
    else:
        verdict = headline(checked.headline, KINDS[checked.state])
        print("\n\n".join([verdict, *in_text(checked.tables)]))
    return int(KINDS[checked.state] == "bad")
