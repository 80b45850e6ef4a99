"""A check that marks cut with fitted settings lie where the fit promised, or what changed."""

import argparse
from dataclasses import dataclass, replace

import numpy as np

from plumb.cli.output import say_failure
from plumb.cli.screen import BAD, GOOD, headline, print_json, table
from plumb.diagnosis.explanation import FEWEST_NUMBERS
from plumb.diary.file import RECHECK, folder_of, keep, read_diary
from plumb.diary.recheck import (
    LEFT,
    RIGHT,
    SHEET_X,
    SHEET_Y,
    LikelyChange,
    Recheck,
    fit_of,
    recheck,
)
from plumb.fit.inputs import Inputs
from plumb.job.home import HomeTouch, Point, are_apart
from plumb.model.plain import in_feet, plain_change, plain_name, words_of
from plumb.text.answers import Moment, in_json, json_of, part
from plumb.text.values import bare, signed, unit, worded

SHOWN = 4  # changes


@dataclass(frozen=True)
class RecheckedMark:
    """A mark against what the fit promised [mm]."""

    name: str
    hole: Point
    error: Point
    expected_mm: float  # an unchanged machine rarely errs by more


@dataclass(frozen=True)
class RecheckAnswer(Recheck):
    """Whether marks still lie where the fit promised."""

    at = part("fit.at", Moment, "Of the diary.", name="fit")

    @in_json
    def sentence(self) -> str:
        """The verdict in a sentence."""
        return sentence(self)

    @in_json
    def marks(self) -> list[RecheckedMark]:
        """The marks, in the order in which they were read."""
        both = zip(self.touches, self.errors.tolist(), self.expected.tolist(), strict=True)
        return [RecheckedMark(touch.name, touch.hole, (x, y), most) for touch, (x, y), most in both]


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
    if any(mark.chains or mark.chains_swapped or mark.sled_weight for mark in measured.marks):
        return None
    touches = [HomeTouch(mark.name, where, mark.target) for mark, where in measured.readings]
    diary = read_diary(folder)
    if not are_apart(touches) or fit_of(diary, settings) is None:
        return None
    return recheck(diary, settings, touches, sigma=inputs.sigma or measured.tape_sigma)


def is_all(checked: Recheck) -> bool:
    """Return whether this is all that can be said: the machine holds, or a fit needs more marks."""
    return checked.holds or 2 * len({each.name for each in checked.touches}) < FEWEST_NUMBERS


def report(arguments: argparse.Namespace, checked: Recheck) -> int:
    """Keep the answer in the diary, print it, and return the exit code."""
    answer = RecheckAnswer(**vars(checked))
    say_failure(keep(arguments.settings, RECHECK, json_of(answer), begin=False))
    print_json(answer) if arguments.json else print(_text(answer))
    return int(not answer.holds)


def sentence(checked: Recheck) -> str:
    """Return the verdict in a sentence."""
    worst = worded(float(np.hypot(*checked.errors.T).max()))
    of_date = f"the fit of {checked.fit.at:%Y-%m-%d}"
    if checked.holds:
        return (
            f"The machine is as it was fitted: by {of_date}, errors up to {worst} are to be "
            "expected. Nothing was written."
        )
    best = checked.changes[0]
    if not best.explains:
        return (
            f"Errors up to {worst} are more than {of_date} allows; no single change explains them."
        )
    return f"Something changed since {of_date}. The likeliest: {_change(best)}."


def _text(answer: RecheckAnswer) -> str:
    rows = [
        [
            mark.name,
            f"{bare(mark.hole[0], 1)}, {bare(mark.hole[1], 1)}",
            ", ".join(map(signed, mark.error)),
            bare(mark.expected_mm),
        ]
        for mark in answer.marks
    ]
    parts = [headline(answer.sentence, GOOD if answer.holds else BAD)]
    parts.append(table(["mark", f"at [{unit()}]", "error", "expected up to"], rows))
    if answer.changes and not answer.holds:
        changes = [
            [_change(change), "yes" if change.explains else "no"]
            for change in answer.changes[:SHOWN]
        ]
        parts.append(table(["a single change", "explains the marks"], changes))
    return "\n\n".join(parts)


def _change(change: LikelyChange) -> str:
    """Return a change with its size."""
    if change.name in (LEFT, RIGHT):
        return f"the {change.name} is {_size(change)} longer than the machine believes"
    if change.name in (SHEET_X, SHEET_Y):
        return f"the sheet has moved by {_size(change)} along {change.name[-1]}"
    words = words_of(change.name)
    if "." not in change.name and words["unit"] == "mm":
        return f"{plain_name(change.name)} by {_size(change)}"
    now = change.before + change.size
    ends = now - change.sigma, now + change.sigma
    said = plain_change(change.name, change.before, now, *ends)
    by = f"by {said.shift} +- {said.margin} {said.unit}"
    return in_feet(words["more"]).replace("by #", "#").replace("#", by)


def _size(change: LikelyChange) -> str:
    return f"{signed(change.size)} +- {worded(change.sigma)}"
