"""Keeps holes as home marks, and restores a lost position by them: `plumb recover`."""

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, field
from datetime import date
from math import dist

import numpy as np

from plumb.cli.arguments import unit_of
from plumb.cli.output import STDOUT, say_failure, write_outputs
from plumb.cli.screen import headline, in_text, next_step, print_json, sentences
from plumb.diary.file import HOME, keep
from plumb.fit.inputs import settings_in
from plumb.job.home import (
    SAME,
    HomeFit,
    HomeMark,
    HomeTouch,
    Point,
    hole_program,
    home_file,
    home_fit,
    new_home_mark,
    place_of,
    read_home_marks,
    refuse_repeated,
    write_home_marks,
)
from plumb.job.slip import repair_program
from plumb.settings.machine import MachineSettings
from plumb.text.answers import Internal, in_json, json_of
from plumb.text.errors import InputError
from plumb.text.locks import alone
from plumb.text.values import Unit
from plumb.words.recover import asked_signs, fit_sentence, home_marks, kept, restored


@dataclass(frozen=True)
class ShownMark:
    """A home mark, and where the machine shows the bit in it today [mm]."""

    name: str
    place: list[float]
    kept_place: Point  # where the machine was when it made the hole
    chains: Point
    date: str


@dataclass
class HomeAnswer:
    """Answer of the command, and the files it writes."""

    settings: Internal[MachineSettings]
    kept: Internal[dict[str, HomeMark]]
    unit: Internal[Unit]
    said: Internal[list[str]] = field(default_factory=list)
    asked: Internal[list[str]] = field(default_factory=list)
    lines: list[str] = field(default_factory=list)
    fits: list[HomeFit] = field(default_factory=list)
    written: list[str] = field(default_factory=list)

    @in_json
    def marks(self) -> list[ShownMark]:
        """All home marks."""
        return [
            ShownMark(
                mark.name,
                place_of(self.settings, mark).tolist(),
                mark.place,
                mark.chains,
                mark.date,
            )
            for mark in self.kept.values()
        ]


def run(arguments: argparse.Namespace) -> int:
    """Keep, restore or list, write, print, and return the exit code."""
    settings = settings_in(arguments.settings)
    if arguments.keep and (arguments.at or arguments.touch):
        raise InputError("--keep goes alone: keep the home mark first, then restore by it")
    answer = HomeAnswer(
        settings, read_home_marks(home_file(arguments.settings)), unit_of(arguments)
    )
    if arguments.keep:
        _keep(arguments, answer)
    if arguments.at:
        _restore(arguments, answer)
    answer.written = _written(arguments, answer)
    print_json(answer) if arguments.json else print(_text(arguments, answer))
    return int(not all(fit.fits for fit in answer.fits))


def _keep(arguments: argparse.Namespace, answer: HomeAnswer) -> None:
    """Keep a hole, with what makes it."""
    name, place = arguments.keep
    mark = new_home_mark(answer.settings, name, place, date=f"{date.today():%Y-%m-%d}")
    answer.kept[name] = mark
    answer.lines = hole_program(mark)
    answer.said = kept(mark, answer.unit)


def _restore(arguments: argparse.Namespace, answer: HomeAnswer) -> None:
    """Say the chains with the bit in a home mark, and how well others fit."""
    mark = home_mark(arguments.settings, arguments.at)
    shown = place_of(answer.settings, mark).tolist()
    where = f"home mark {mark.name}"
    answer.lines = repair_program(np.array(mark.chains), where=where)
    answer.said = restored(mark, shown, answer.lines[-1], answer.unit)
    for touched in touches_of(arguments):
        other = answer.kept.get(touched.name)
        if other is None:
            raise InputError(f"--touch {touched.name}: give the name of a home mark")
        if dist(other.place, mark.place) < SAME:
            raise InputError(
                f"--touch {touched.name}: that is the hole of --at {mark.name}, by which the "
                "chains were set; touch another home mark"
            )
        answer.fits.append(home_fit(answer.settings, other, touched.shown))
        answer.asked += asked_signs([touched])


def _written(arguments: argparse.Namespace, answer: HomeAnswer) -> list[str]:
    """Write the program first: a home mark is kept only if that could be written."""
    written = []
    if arguments.output:
        if not answer.lines:
            raise InputError(f"-o {arguments.output}: there is no program without --keep or --at")
        written += write_program(arguments, answer.lines)
    if arguments.keep:
        name, _ = arguments.keep
        path = home_file(arguments.settings)
        with alone(path.with_name(f".{path.name}.lock")):
            # Another command may have kept another mark since this one began.
            write_home_marks(path, {**read_home_marks(path), name: answer.kept[name]})
        written.append(str(path))
    if arguments.keep or arguments.at:
        entry = {
            "mark": arguments.at or arguments.keep[0],
            "kept": bool(arguments.keep),
            "lines": answer.lines,
            "fits": [json_of(fit) for fit in answer.fits],
        }
        say_failure(keep(arguments.settings, HOME, entry, begin=False))
    return written


def write_program(arguments: argparse.Namespace, lines: Sequence[str]) -> list[str]:
    """Write a program; the names of the files."""
    content = "\n".join([*lines, ""]).encode()
    write_outputs({arguments.output: content}, inputs=[arguments.settings])
    return [] if arguments.output == STDOUT else [arguments.output]


# A command opens the line, which resets the board; and that keeps no place while z is not known.
Z_TOO = "Bring the bit's tip to the sheet's face and send both at once"


def _text(arguments: argparse.Namespace, answer: HomeAnswer) -> str:
    if not answer.said:
        return _listed(arguments, answer)
    parts = [headline(answer.said[0]), sentences(answer.said[1:], mark="")]
    parts += [sentences([fit_sentence(fit, answer.unit)], mark="") for fit in answer.fits]
    parts += [sentences(answer.asked, mark="")] if answer.asked else []
    if arguments.output:
        parts.append(next_step("Send it:", ["send", arguments.output]))
    elif arguments.at and not answer.fits:
        send = ["send", answer.lines[-1]]
        parts.append(next_step("Send it:", send))
        parts.append(next_step(f"Is z lost too? {Z_TOO}:", [*send, "G10 Z0"]))
    return "\n\n".join(parts)


def _listed(arguments: argparse.Namespace, answer: HomeAnswer) -> str:
    """Return all home marks, or how to begin."""
    said = in_text([home_marks([*answer.kept.values()], answer.unit)])
    if not answer.kept:
        keeping = ["recover", arguments.settings, "--keep=left=-900,250", "-o", "left.nc"]
        said.append(next_step("Keep a hole:", keeping))
    return "\n\n".join(said)


def touches_of(arguments: argparse.Namespace) -> tuple[HomeTouch, ...]:
    """Return the touches, numbered, those of home marks by name. Raises InputError for a hole
    twice.
    """
    touches = []
    for number, (hole, shown) in enumerate(arguments.touch, 1):
        if isinstance(hole, str):
            mark = home_mark(arguments.settings, hole)
            touches.append(HomeTouch(hole, mark.place, shown))
        else:
            touches.append(HomeTouch(str(number), hole, shown))
    refuse_repeated(touches)
    return tuple(touches)


def home_mark(settings: str, name: str) -> HomeMark:
    """Return the home mark of that name, kept next to the settings. Raises InputError."""
    path = home_file(settings)
    marks = read_home_marks(path)
    if name not in marks:
        known = f"it has {', '.join(marks)}" if marks else "there is none yet: plumb recover --keep"
        raise InputError(f"{path}: no home mark {name!r}; {known}")
    return marks[name]
