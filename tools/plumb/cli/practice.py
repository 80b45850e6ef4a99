"""`plumb practice`: find what is hidden in a virtual machine."""

from __future__ import annotations

import argparse
import re
import secrets
from collections.abc import Callable
from pathlib import Path
from typing import Any

from plumb.cli.arguments import add_force, add_json, add_units
from plumb.cli.practice_text import left_sentence, score_json, score_text
from plumb.cli.screen import print_json, sentences
from plumb.cli.steps import next_step
from plumb.marks.read import read_plan
from plumb.model.predict import known_effects
from plumb.settings.files import read_settings
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError, refusal
from plumb.text.files import write_all, write_whole
from plumb.vm import practice
from plumb.vm.practice import Practice
from plumb.vm.practice_file import NAME, game_in
from plumb.vm.practice_folder import (
    MARKS,
    SETTINGS,
    Step,
    begun,
    cut,
    game_bytes,
    grid_marks,
    read_again,
    solve,
)
from plumb.vm.secret import LEVELS

GRID = re.compile(r"(\d+)x(\d+)")
SEEDS = 1_000_000


def run(arguments: argparse.Namespace) -> int:
    """Take a step of a game, and return the exit code."""
    if not arguments.step or not arguments.folder:
        raise InputError(f"name a step ({', '.join(STEPS)}) and a folder")
    steps: dict[str, Callable[[argparse.Namespace], int]] = {
        "start": _start,
        "measure": _measure,
        "read": _read,
        "check": _check,
        "hint": _hint,
        "solve": _solve,
    }
    return steps[arguments.step](arguments)


def _start(arguments: argparse.Namespace) -> int:
    """Make the folder with what the owner believes."""
    folder, level = Path(arguments.folder), arguments.level or 1
    if Path(folder, NAME).exists() and not arguments.force:
        raise refusal(folder, "holds a game already", remedy="name a new folder, or --force")
    game = Practice(level, secrets.randbelow(SEEDS) if arguments.seed is None else arguments.seed)
    try:
        folder.mkdir(parents=True, exist_ok=True)
    except OSError as error:
        raise refusal(folder, f"cannot be made ({error.strerror})") from None
    Path(folder, MARKS).unlink(missing_ok=True)
    _write(folder, begun(game))
    said = [
        f"A machine with a secret: {LEVELS[level].words}. Its frame and its sheet are off by a few "
        "millimetres, its sled rubs, and its gears have play, as on every machine. A tape reads "
        "its marks to 0.4 mm.",
        left_sentence(game),
    ]
    step = next_step("Cut a first grid and read it:", ["practice", "measure", str(folder), "5x5"])
    return _done(arguments, game, [*said], step)


def _measure(arguments: argparse.Namespace) -> int:
    """Cut marks, read them, and add them to the marks of the folder."""
    game, settings = game_in(arguments.folder), _believed(arguments)
    wanted = _single(arguments, "a form, or a grid like 5x5")
    match = GRID.fullmatch(wanted)
    plan = (
        grid_marks(int(match[1]), int(match[2]), settings)
        if match
        else read_plan(wanted, sheet=settings.sheet)
    )
    step = cut(Path(arguments.folder), game, settings, plan)
    _write(Path(arguments.folder), step)
    game, marks = step.game, str(Path(arguments.folder, MARKS))
    said = [f"{step.marks} marks were cut and read: {marks} has them.", left_sentence(game)]
    inputs = [str(Path(arguments.folder, SETTINGS)), marks]
    return _done(arguments, game, said, next_step("What do they show?", ["diagnose", *inputs]))


def _write(folder: Path, step: Step) -> None:
    """Write what a step changed."""
    write_all({str(folder / name): content for name, content in step.files.items()})


def _read(arguments: argparse.Namespace) -> int:
    """Read marks of the sheet once more."""
    game, settings = game_in(arguments.folder), _believed(arguments)
    if not arguments.what:
        raise InputError("practice read: name the marks to be read again")
    path = Path(arguments.folder, MARKS)
    step = read_again(Path(arguments.folder), game, settings, arguments.what)
    _write(Path(arguments.folder), step)
    game = step.game
    said = [
        f"Read again: {', '.join(arguments.what)}. {path} has the new readings at its end, and "
        "the old ones where they were: take a wrong one away.",
        left_sentence(game),
    ]
    return _done(arguments, game, said, "")


def _check(arguments: argparse.Namespace) -> int:
    """Measure something directly."""
    name = _single(arguments, "what to measure directly, like motor_gap")
    game, checks, known = practice.check(game_in(arguments.folder), name)
    write_whole(str(Path(arguments.folder, NAME)), game_bytes(game))
    inputs = [str(Path(arguments.folder, each)) for each in (SETTINGS, MARKS)]
    words = [
        w for each in checks for w in ("--checked", f"{each.name}={each.value:.6g}+-{each.sigma:g}")
    ]
    said = [f"Measured: {known.direct.title}.", left_sentence(game)]
    step = next_step("Tell the lab:", ["diagnose", *inputs, *words])
    return _done(arguments, game, said, step, checked={each.name: each.value for each in checks})


def _hint(arguments: argparse.Namespace) -> int:
    """Give the next hint."""
    game, said = practice.hint(game_in(arguments.folder))
    write_whole(str(Path(arguments.folder, NAME)), game_bytes(game))
    return _done(arguments, game, [said, left_sentence(game)], "", hint=said)


def _solve(arguments: argparse.Namespace) -> int:
    """Cut a second sheet with new settings, and tell the secret."""
    game, believed = game_in(arguments.folder), _believed(arguments)
    machine = read_settings(_single(arguments, "the new machine.toml"), known=known_effects())
    score = solve(Path(arguments.folder), game, believed, machine)
    if arguments.json:
        print_json(score_json(score))
    else:
        print(score_text(score))
    return int(bool(score.false or score.missed))


def _believed(arguments: argparse.Namespace) -> MachineSettings:
    """What the owner believes, as the folder has it."""
    return read_settings(Path(arguments.folder, SETTINGS), known=known_effects())


def _single(arguments: argparse.Namespace, words: str) -> str:
    """The single thing that a step is about."""
    if len(arguments.what) != 1:
        raise InputError(f"practice {arguments.step}: after the folder, name {words}")
    return str(arguments.what[0])


def _done(
    arguments: argparse.Namespace, game: Practice, said: list[str], step: str, **more: Any
) -> int:
    """Say what was done and what is left."""
    if arguments.json:
        left = {"marks": game.left.marks, "minutes": game.left.minutes}
        kept = {"level": game.level, "seed": game.seed, "hints": game.hints}
        print_json({**kept, "left": left, "hint": None, "checked": {}, **more})
        return 0
    print(sentences(said, mark=""))
    if step:
        print(f"\n{step}")
    return 0


# The arguments of `plumb practice`.

STEPS = ("start", "measure", "read", "check", "hint", "solve")
EXAMPLES = (
    "plumb practice start game",
    "plumb practice hint game",
)
EXIT = (
    "Exit: 0 done; 1 solved, but something was missed or claimed that is not there; 2 it cannot be "
    "done."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """The arguments of `plumb practice`."""
    parser.add_argument("step", metavar="STEP", nargs="?", choices=STEPS, help=", ".join(STEPS))
    parser.add_argument("folder", metavar="FOLDER", nargs="?", help="where the game is")
    parser.add_argument(
        "what",
        metavar="WHAT",
        nargs="*",
        help="measure: a form of plumb grid or plumb next, or a grid like 5x5; read: names of "
        "marks; check: what to measure directly, like motor_gap; solve: the new machine.toml",
    )
    parser.add_argument(
        "--level",
        metavar="N",
        type=int,
        choices=tuple(LEVELS),
        help="1 one large effect, 2 one with look-alikes, 3 two, 4 not in the library, 5 with a "
        "wrong reading [1]",
    )
    parser.add_argument("--seed", metavar="S", type=int, help="another machine [drawn]")
    add_units(parser)
    add_force(parser)
    add_json(parser)
