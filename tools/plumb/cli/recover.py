"""`plumb recover`: keeps home marks, brings a lost place back, and repairs a slipped chain."""

import argparse
import re
from collections.abc import Sequence
from datetime import date
from math import dist

import numpy as np

from plumb.cli.arguments import add_shared, place, unit_of
from plumb.cli.output import STDOUT, say_failure, write_outputs
from plumb.cli.screen import headline, in_text, next_step, print_json, sentences
from plumb.diary.file import HOME, SLIP, keep
from plumb.fit.inputs import settings_in
from plumb.job.home import (
    SAME,
    HomeMark,
    HomeTouch,
    Point,
    hole_program,
    home_file,
    home_fit,
    new_home_mark,
    read_home_marks,
    refuse_repeated,
    write_home_marks,
)
from plumb.job.slip import CANNOT_TELL, find_slip, next_hole, repair_program
from plumb.settings.machine import MachineSettings
from plumb.text.answers import json_of
from plumb.text.errors import InputError
from plumb.text.locks import alone
from plumb.words.recover import (
    KINDS,
    HomeAnswer,
    SlipAnswer,
    asked_signs,
    fit_sentence,
    home_marks,
    repair_lines,
)

# A command opens the line, which resets the board; and that keeps no place while z is not known.
Z_TOO = "Is z lost too? Bring the bit's tip to the sheet's face and send both at once:"


def run(arguments: argparse.Namespace) -> int:
    """Keep, restore or list home marks, or weigh what touched holes say; return the exit code."""
    is_home = arguments.keep or arguments.at or not arguments.touch
    for option in ("fixed", "sigma"):
        if is_home and getattr(arguments, option):
            raise InputError(f"--{option} is for touched holes: give --touch, and no home mark")
    settings = settings_in(arguments.settings)
    return _home(arguments, settings) if is_home else _slip(arguments, settings)


def _slip(arguments: argparse.Namespace, settings: MachineSettings) -> int:
    """Weigh what may have happened to the chains, write, print, and return the exit code."""
    touches = _touches(arguments)
    finding = find_slip(settings, touches, sigma=arguments.sigma, fixed=arguments.fixed)
    lines = repair_lines(finding) if arguments.output else []
    answer = SlipAnswer(
        finding=finding,
        written=_write(arguments, lines) if lines else [],
        touch_next=next_hole(settings, finding) if finding.verdict == CANNOT_TELL else None,
        unit=unit_of(arguments),
    )
    say_failure(keep(arguments.settings, SLIP, json_of(answer), begin=False))
    if arguments.json:
        print_json(answer)
    else:
        parts = [headline(answer.sentence, KINDS[answer.verdict]), *in_text(answer.tables)]
        parts += [sentences([answer.to_do], mark="")] if answer.to_do else []
        if answer.lines:
            parts.append(next_step("Send it:", ["send", arguments.output or answer.lines[-1]]))
        asked = asked_signs(finding.touches)
        print("\n\n".join([*parts, sentences(asked, mark="")] if asked else parts))
    return int(KINDS[finding.verdict] != "good")


def _home(arguments: argparse.Namespace, settings: MachineSettings) -> int:
    """Keep, restore or list home marks, write, print, and return the exit code."""
    if arguments.keep and (arguments.at or arguments.touch):
        raise InputError("--keep goes alone: keep the home mark first, then restore by it")
    kept = read_home_marks(home_file(arguments.settings))
    answer = HomeAnswer(settings, kept, unit_of(arguments))
    if arguments.keep:
        name, where = arguments.keep
        mark = new_home_mark(settings, name, where, date=f"{date.today():%Y-%m-%d}")
        kept[name] = answer.new = mark
        answer.lines = hole_program(mark)
    if arguments.at:
        _restore(arguments, answer)
    answer.written = _written(arguments, answer)
    print_json(answer) if arguments.json else print("\n\n".join(_home_text(arguments, answer)))
    return int(not all(fit.fits for fit in answer.fits))


def _restore(arguments: argparse.Namespace, answer: HomeAnswer) -> None:
    """Say the chains with the bit in a home mark, and how well others fit."""
    answer.used = mark = _home_mark(arguments.settings, arguments.at)
    answer.lines = repair_program(np.array(mark.chains), where=f"home mark {mark.name}")
    for touched in _touches(arguments):
        other = answer.kept.get(touched.name)
        if other is None:
            raise InputError(f"--touch {touched.name}: give the name of a home mark")
        if dist(other.place, mark.place) < SAME:
            raise InputError(
                f"--touch {touched.name}: that is the hole of --at {mark.name}, by which the "
                "chains were set; touch another home mark"
            )
        answer.fits.append(home_fit(answer.settings, other, touched.shown))


def _written(arguments: argparse.Namespace, answer: HomeAnswer) -> list[str]:
    """Write the program first: a home mark is kept only if that could be written."""
    written = []
    if arguments.output:
        if not answer.lines:
            raise InputError(f"-o {arguments.output}: there is no program without --keep or --at")
        written += _write(arguments, answer.lines)
    if answer.new:
        path = home_file(arguments.settings)
        with alone(path.with_name(f".{path.name}.lock")):
            # Another command may have kept another mark since this one began.
            write_home_marks(path, {**read_home_marks(path), answer.new.name: answer.new})
        written.append(str(path))
    if mark := answer.new or answer.used:
        entry = {
            "mark": mark.name,
            "kept": answer.new is not None,
            "lines": answer.lines,
            "fits": [json_of(fit) for fit in answer.fits],
        }
        say_failure(keep(arguments.settings, HOME, entry, begin=False))
    return written


def _home_text(arguments: argparse.Namespace, answer: HomeAnswer) -> list[str]:
    """Return what was done with a home mark; else all home marks, or how to begin."""
    if not answer.said:
        parts = in_text([home_marks([*answer.kept.values()], answer.unit)])
        if not answer.kept:
            keeping = ["recover", arguments.settings, "--keep=left=-900,250", "-o", "left.nc"]
            parts.append(next_step("Keep a hole:", keeping))
        return parts
    parts = [headline(answer.said[0]), sentences(answer.said[1:], mark="")]
    parts += [sentences([fit_sentence(fit, answer.unit)], mark="") for fit in answer.fits]
    if arguments.at and (asked := asked_signs(_touches(arguments))):
        parts.append(sentences(asked, mark=""))
    if arguments.output:
        parts.append(next_step("Send it:", ["send", arguments.output]))
    elif arguments.at and not answer.fits:
        send = ["send", answer.lines[-1]]
        parts += [next_step("Send it:", send), next_step(Z_TOO, [*send, "G10 Z0"])]
    return parts


def _write(arguments: argparse.Namespace, lines: Sequence[str]) -> list[str]:
    """Write a program; the names of the files."""
    content = "\n".join([*lines, ""]).encode()
    write_outputs({arguments.output: content}, inputs=[arguments.settings])
    return [] if arguments.output == STDOUT else [arguments.output]


def _touches(arguments: argparse.Namespace) -> tuple[HomeTouch, ...]:
    """Return the touches, numbered, those of home marks by name. Raises InputError for a hole
    twice.
    """
    touches = []
    for number, (hole, shown) in enumerate(arguments.touch, 1):
        if isinstance(hole, str):
            mark = _home_mark(arguments.settings, hole)
            touches.append(HomeTouch(hole, mark.place, shown))
        else:
            touches.append(HomeTouch(str(number), hole, shown))
    refuse_repeated(touches)
    return tuple(touches)


def _home_mark(settings: str, name: str) -> HomeMark:
    """Return the home mark of that name, kept next to the settings. Raises InputError."""
    path = home_file(settings)
    marks = read_home_marks(path)
    if name not in marks:
        known = f"it has {', '.join(marks)}" if marks else "there is none yet: plumb recover --keep"
        raise InputError(f"{path}: no home mark {name!r}; {known}")
    return marks[name]


# The arguments of `plumb recover`.

EXAMPLES = (
    "plumb recover machine.toml --keep left=-900,250 -o hole.nc",
    "plumb recover machine.toml --touch=-900,250:-895.4,253.7 --touch=900,-250:897.9,-246.5",
)
EXIT = (
    "Exit: 0 done, or no chain slipped; 1 a chain slipped, the touches cannot tell, no slip "
    "explains them, or a second home mark does not fit the first; 2 an input cannot be used, and "
    "nothing was written."
)
WORD = re.compile(r"[A-Za-z0-9_-]+")


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb recover`."""
    add_shared(parser, "settings")
    parser.add_argument(
        "--keep",
        metavar="NAME=X,Y",
        type=named_place,
        help="keep a home mark at this place [mm, from the middle of the sheet, y up]; -o writes "
        "the program that makes the hole",
    )
    parser.add_argument(
        "--at",
        metavar="NAME",
        help="print how long the chains are with the bit in this home mark; -o writes the program "
        "that sets them",
    )
    parser.add_argument(
        "--touch",
        metavar="HOLE:SHOWN",
        action="append",
        type=touch,
        default=[],
        help="a hole with the bit in it, like --touch=-900,250:-896.2,253.1 (x,y of the hole, or "
        "the name of a home mark; then what the machine shows): with two or more say whether a "
        "chain slipped; with --at, how well another home mark fits",
    )
    parser.add_argument(
        "--fixed",
        action="store_true",
        help="the holes are in the frame or its board, not in a sheet that can move",
    )
    add_shared(parser, sigma="0.5")
    add_shared(parser, output="write the program to this file")
    add_shared(parser, "--force", "--units", "--json")


def named_place(text: str) -> tuple[str, Point]:
    """Read NAME=X,Y."""
    name, _, where = text.partition("=")
    if not WORD.fullmatch(name):
        raise argparse.ArgumentTypeError(f"'{text}' is not NAME=X,Y, like left=-900,250")
    return name, place(where)


def touch(text: str) -> tuple[str | Point, Point]:
    """Read HOLE:SHOWN; a hole is a place or a name."""
    hole, separator, shown = text.rpartition(":")
    if not (separator and hole):
        raise argparse.ArgumentTypeError(f"'{text}' is not HOLE:SHOWN, like -900,250:-896.2,253.1")
    return (place(hole) if "," in hole else hole), place(shown)
