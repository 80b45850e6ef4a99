"""`plumb recheck`: whether marks still lie where the fit promised, or what changed by how much."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from plumb.cli.arguments import (
    add_controller,
    add_json,
    add_settings,
    add_units,
    file,
)
from plumb.cli.home import add_touch, asked_signs, touches_of
from plumb.cli.inputs import add_stated, stated_inputs
from plumb.cli.output import say_failure
from plumb.cli.screen import BAD, GOOD, headline, print_json, sentences, table
from plumb.cure.check_marks import check_marks, check_sentence
from plumb.diary.file import RECHECK, keep, read_diary
from plumb.diary.recheck import LEFT, RIGHT, SHEET_X, SHEET_Y, Change, Recheck, recheck
from plumb.fit.inputs import refuse_the_same_twice, settings_in
from plumb.job.home import FAR, Point, are_apart
from plumb.marks.read import read_marks
from plumb.model.plain import in_feet, plain_change, plain_name, words_of
from plumb.model.predict import known_effects
from plumb.text.answers import Moment, json_of
from plumb.text.errors import InputError
from plumb.text.values import bare, signed, unit, worded

FEWEST = 2
SHOWN = 4  # changes


@dataclass(frozen=True)
class RecheckedMark:
    """A mark against what the fit promised [mm]."""

    name: str
    hole: Point
    error: Point
    expected_mm: float  # an unchanged machine rarely errs by more


@dataclass(frozen=True)
class RecheckAnswer:
    """Whether marks still lie where the fit promised."""

    holds: bool
    sentence: str
    chi_square: float
    limit: float  # of chi-square
    marks: list[RecheckedMark]
    fit: Moment | None = None  # of the diary; None with --check, which fits MARKS
    sheet_turned_rad: float | None = None
    changes: tuple[Change, ...] = ()  # single changes that may explain the errors, the best first


def run(arguments: argparse.Namespace) -> int:
    """Hold the marks against the fit, print, and return the exit code."""
    if arguments.check:
        return _held_against_marks(arguments)
    for name in ("marks", "prior", "checked", "cut_with", "controller"):
        if getattr(arguments, name):
            raise InputError(f"{name.replace('_', '-')} is for --check: leave it out")
    if len(arguments.touch) < FEWEST:
        raise InputError("two marks are needed: give --touch twice, for places far apart")
    touches = touches_of(arguments)
    if not are_apart(touches):
        raise InputError(
            f"the marks are less than {worded(FAR, 0)} apart: they are a single place; touch "
            "another far from it"
        )
    folder = Path(arguments.settings).parent
    settings = settings_in(arguments.settings)
    checked = recheck(read_diary(folder), settings, touches, sigma=arguments.sigma)
    marks = [
        RecheckedMark(touch.name, touch.hole, (x, y), expected)
        for touch, (x, y), expected in zip(
            checked.touches, checked.errors.tolist(), checked.expected.tolist(), strict=True
        )
    ]
    answer = RecheckAnswer(
        checked.holds,
        sentence(checked),
        checked.chi_square,
        checked.limit,
        marks,
        fit=checked.fit.at,
        sheet_turned_rad=checked.turn,
        changes=checked.changes,
    )
    return _report(arguments, answer, asked_signs(touches))


def _held_against_marks(arguments: argparse.Namespace) -> int:
    """Hold marks that no fit has seen against the fit of the others, print, and return the exit
    code."""
    if arguments.touch:
        raise InputError("--touch and --check are two ways: give --check alone, or --touch twice")
    if not arguments.marks:
        raise InputError(
            f"--check {arguments.check}: give the marks to which {arguments.settings} was fitted"
        )
    refuse_the_same_twice([*arguments.marks, arguments.check])
    inputs = stated_inputs(arguments)
    if inputs.settings.fitted is None:
        raise InputError(f"{arguments.settings} was fitted to no marks: give what plumb add wrote")
    read = read_marks(arguments.check, sheet=inputs.settings.sheet, known=known_effects())
    checked = check_marks(inputs, read)
    marks = [
        RecheckedMark(mark.name, mark.measured, mark.miss, mark.promised) for mark in checked.marks
    ]
    said = check_sentence(checked)
    answer = RecheckAnswer(checked.holds, said, checked.chi_square, checked.limit, marks)
    return _report(arguments, answer, [])


def _report(arguments: argparse.Namespace, answer: RecheckAnswer, asked: list[str]) -> int:
    """Keep the answer in the diary, print it, and return the exit code."""
    say_failure(keep(arguments.settings, RECHECK, json_of(answer), begin=False))
    if arguments.json:
        print_json(answer)
    else:
        print(_text(answer, asked))
    return int(not answer.holds)


def sentence(checked: Recheck) -> str:
    """Return the verdict in a sentence."""
    worst = worded(float(np.hypot(*checked.errors.T).max()))
    of_date = f"the fit of {checked.fit.at:%Y-%m-%d}"
    if checked.holds:
        return (
            f"The machine is as {of_date} left it: errors up to {worst} are within what it allows."
        )
    best = checked.changes[0]
    if not best.explains:
        return (
            f"Errors up to {worst} are more than {of_date} allows; no single change explains them."
        )
    return f"Something changed since {of_date}. The likeliest: {_change(best)}."


def _text(answer: RecheckAnswer, asked: list[str]) -> str:
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
    if asked:
        parts.append(sentences(asked, mark=""))
    return "\n\n".join(parts)


def _change(change: Change) -> str:
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


def _size(change: Change) -> str:
    return f"{signed(change.size)} +- {worded(change.sigma)}"


# The arguments of `plumb recheck`.

EXAMPLES = (
    "plumb recheck machine.toml --touch=-900,250:-899.5,250.2 --touch=900,-250:900,-250",
    "plumb recheck machine.toml marks.toml --check check.toml",
)
EXIT = "Exit: 0 the marks lie within the interval; 1 something changed; 2 an input cannot be used."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb recheck`."""
    add_settings(parser)
    add_touch(parser, meaning="a mark: where it is, then where the machine was or is in it")
    parser.add_argument(
        "--check",
        metavar="FORM",
        type=file,
        help="marks that a tape has read and no fit has seen: hold them against a fit of MARKS",
    )
    parser.add_argument(
        "marks",
        metavar="MARKS",
        type=file,
        nargs="*",
        help="with --check: the marks to which SETTINGS were fitted",
    )
    parser.add_argument(
        "--cut-with",
        metavar="SETTINGS",
        type=file,
        help="the settings in force when MARKS were cut, if neither they nor SETTINGS say so",
    )
    add_controller(parser)
    add_stated(parser, sigma="0.5; with --check what MARKS say")
    add_units(parser)
    add_json(parser)
