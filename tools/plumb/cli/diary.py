"""`plumb diary`: how the errors and the numbers of a machine went over time."""

from __future__ import annotations

import argparse
from dataclasses import dataclass

from plumb.cli.arguments import add_force, add_json, add_picture, add_units
from plumb.cli.inputs import picture_form
from plumb.cli.output import write_outputs
from plumb.cli.screen import headline, print_json, sentences, table
from plumb.diary.file import Diary, Entry, has_diary, noted, read_diary
from plumb.diary.history import Course, DiaryFit, History, history_of
from plumb.model.plain import noun_of, plain_change, plain_name, plain_size
from plumb.pictures.reach import Run, draw_diary
from plumb.text.errors import InputError
from plumb.text.values import bare, unit, worded

LAST = 10  # other entries


@dataclass(frozen=True)
class DiaryAnswer:
    """What a diary holds, and the picture that was drawn of it."""

    fits: tuple[DiaryFit, ...]  # the oldest first; errors are RMS
    numbers: tuple[Course, ...]
    entries: tuple[Entry, ...]
    spoilt_lines: tuple[int, ...]
    written: list[str]


def run(arguments: argparse.Namespace) -> int:
    """Read, draw, print, and return the exit code."""
    diary = read_diary(arguments.folder)
    if not has_diary(arguments.folder):
        remedy = "plumb add -o machine.toml begins it in the folder of that file"
        raise InputError(diary.path, "there is no diary", remedy=remedy)
    history, written = history_of(diary), []
    if arguments.picture:
        form = picture_form(arguments.picture)
        write_outputs({arguments.picture: _picture(history, form)}, inputs=[str(diary.path)])
        written = [arguments.picture]
    if arguments.json:
        print_json(DiaryAnswer(history.fits, history.courses, diary.entries, diary.spoilt, written))
    else:
        print(_text(diary, history))
    return 0


def _picture(history: History, form: str) -> bytes:
    errors = [
        Run("before", "mm RMS", [(fit.at, fit.before, None) for fit in history.fits]),
        Run("fitted", "mm RMS", [(fit.at, fit.rms, None) for fit in history.fits]),
        Run("at marks left out", "mm RMS", [(fit.at, fit.left_out, None) for fit in history.fits]),
    ]
    numbers = [
        Run(
            plain_name(course.name),
            course.unit,
            [(point.at, point.value, (point.low, point.high)) for point in course.points],
        )
        for course in history.courses
    ]
    return draw_diary(errors, numbers, form=form)


def _text(diary: Diary, history: History) -> str:
    parts = [headline(_sentence(history))]
    if history.fits:
        parts += [_fits(history), _numbers(history)]
    others = [entry for entry in diary.entries if entry.kind != "fit"][-LAST:]
    if others:
        rows = [[_date(each), noted(each)] for each in others]
        parts.append(table(["date", "what else"], rows, words=[1]))
    if diary.spoilt:
        lines = ", ".join(map(str, diary.spoilt))
        parts.append(sentences([f"{diary.path}: line {lines} is cut or was changed; passed over"]))
    return "\n\n".join(parts)


def _sentence(history: History) -> str:
    if not history.fits:
        return "The diary has no fit yet."
    count, newest = len(history.fits), history.fits[-1]
    fits = f"{count} fit{'s' if count > 1 else ''}"
    moved = dict.fromkeys(_noun(course.name) for course in history.courses if course.has_moved)
    said = f"{fits}; the newest leaves {worded(newest.left_out)} at marks left out of it"
    return f"{said}. Moved since the fit before: {', '.join(moved)}." if moved else f"{said}."


def _noun(name: str) -> str:
    """Return a number of the frame, or the effect that a number belongs to, in a maker's words."""
    effect, dot, _ = name.partition(".")
    return noun_of(effect) if dot else plain_name(name)


def _fits(history: History) -> str:
    rows = [
        [
            f"{fit.at:%Y-%m-%d %H:%M}",
            str(fit.count),
            bare(fit.before),
            bare(fit.rms),
            bare(fit.left_out),
            ", ".join(map(noun_of, fit.effects)) or "nothing",
        ]
        for fit in history.fits
    ]
    heads = ["date", "readings", f"before [{unit()} RMS]", "fitted", "left out", "added"]
    return table(heads, rows, words=[-1])


def _numbers(history: History) -> str:
    rows = [[_now(course), _change(course), _moved(course)] for course in history.courses]
    return table(["number, with its 95 % interval", "change", ""], rows)


def _now(course: Course) -> str:
    point = course.points[-1]
    return plain_size(course.name, point.value, point.low, point.high)


def _change(course: Course) -> str:
    if course.change is None:
        return ""
    before, now = course.points[-2:]
    said = plain_change(course.name, before.value, now.value, now.low, now.high)
    return f"{said.shift} {said.unit}"


def _moved(course: Course) -> str:
    return "moved" if course.has_moved else ""


def _date(entry: Entry) -> str:
    return f"{entry.at:%Y-%m-%d %H:%M}"


# The arguments of `plumb diary`.

EXAMPLES = (
    "plumb diary my-maslow",
    "plumb diary my-maslow --picture diary.png",
)
EXIT = "Exit: 0 done; 2 there is no diary, or a file cannot be written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb diary`."""
    parser.add_argument(
        "folder",
        metavar="FOLDER",
        nargs="?",
        default=".",
        help="the machine's folder [this folder]",
    )
    add_picture(parser, "draw errors and numbers over time")
    add_force(parser)
    add_units(parser)
    add_json(parser)
