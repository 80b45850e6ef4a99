"""`plumb recheck`: whether marks still lie where the fit promised, or what changed by how much."""

from __future__ import annotations

import argparse
from pathlib import Path
from typing import Any

import numpy as np

from plumb.cli.arguments import (
    add_controller,
    add_json,
    add_prior,
    add_settings,
    add_sigma,
    add_units,
    file,
)
from plumb.cli.check import held_against_marks, report
from plumb.cli.checked import add_checked
from plumb.cli.screen import headline, sentences, table
from plumb.cli.touches import add_touch, asked_signs, touches_of
from plumb.diary.file import read_diary
from plumb.diary.recheck import LEFT, RIGHT, SHEET_X, SHEET_Y, Change, Recheck, recheck
from plumb.fit.inputs import settings_in
from plumb.job.home import FAR, are_apart
from plumb.model.plain import plain_name, words_of
from plumb.text.errors import InputError
from plumb.text.values import bare, signed, unit, worded

FEWEST = 2
SHOWN = 4  # changes


def run(arguments: argparse.Namespace) -> int:
    """Hold the marks against the fit, print, and return the exit code."""
    if arguments.check:
        return held_against_marks(arguments)
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
    return report(arguments, _json(checked), _text(checked))


def sentence(checked: Recheck) -> str:
    """Return the verdict in a sentence."""
    worst = worded(float(np.hypot(*checked.errors.T).max()))
    of_date = f"the fit of {checked.fit.at:%Y-%m-%d}"
    if checked.holds:
        return f"The machine is still within its interval: errors up to {worst} fit {of_date}."
    best = checked.changes[0]
    if not best.explains:
        return (
            f"Errors up to {worst} are more than {of_date} allows; no single change explains them."
        )
    return f"Something changed since {of_date}. The likeliest: {_change(best)}."


def _text(checked: Recheck) -> str:
    rows = [
        [
            touch.name,
            f"{bare(touch.hole[0], 1)}, {bare(touch.hole[1], 1)}",
            f"{signed(error[0])}, {signed(error[1])}",
            bare(expected),
        ]
        for touch, error, expected in zip(
            checked.touches, checked.errors.tolist(), checked.expected.tolist(), strict=True
        )
    ]
    parts = [headline(sentence(checked))]
    parts.append(table(["mark", f"at [{unit()}]", "error", "expected up to"], rows))
    if not checked.holds:
        changes = [
            [_change(change), "yes" if change.explains else "no"]
            for change in checked.changes[:SHOWN]
        ]
        parts.append(table(["a single change", "explains the marks"], changes))
    asked = asked_signs(checked.touches)
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
    if words["unit"] == "mm":
        return f"{plain_name(change.name)} by {_size(change)}"
    return f"{plain_name(change.name)} by {change.size:+.2g} +- {change.sigma:.1g}"


def _size(change: Change) -> str:
    return f"{signed(change.size)} +- {worded(change.sigma)}"


def _json(checked: Recheck) -> dict[str, Any]:
    return {
        "holds": checked.holds,
        "sentence": sentence(checked),
        "fit": checked.fit.at.isoformat(),
        "chi_square": checked.chi_square,
        "limit": checked.limit,
        "sheet_turned_rad": checked.turn,
        "marks": [
            {"name": touch.name, "hole": touch.hole, "error": error, "expected_mm": expected}
            for touch, error, expected in zip(
                checked.touches, checked.errors.tolist(), checked.expected.tolist(), strict=True
            )
        ],
        "changes": [
            {
                "name": change.name,
                "size": change.size,
                "sigma": change.sigma,
                "explains": change.explains,
            }
            for change in checked.changes
        ],
    }


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
    add_prior(parser)
    add_checked(parser)
    add_sigma(parser, usual="0.5; with --check what MARKS say")
    add_units(parser)
    add_json(parser)
