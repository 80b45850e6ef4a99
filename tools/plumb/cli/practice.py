"""`plumb practice`: find what is hidden in a virtual machine, or count how often the lab does."""

from __future__ import annotations

import argparse
import re
import secrets
from collections.abc import Callable
from pathlib import Path
from typing import Any

from plumb.cli.arguments.practice import STEPS
from plumb.cli.practice_auto import run_auto
from plumb.cli.practice_text import left_sentence, score_json, score_text
from plumb.cli.screen import sentences
from plumb.cli.steps import next_step
from plumb.cli.text import print_json
from plumb.fit.inputs import Inputs
from plumb.grid.cut_with import cut_with_lines
from plumb.grid.options import Grid, GridError
from plumb.grid.touches import touches_of
from plumb.marks.read import Mark, Measurements, read_marks, read_plan
from plumb.model.predict import known_effects
from plumb.settings.files import machine_toml, read_settings
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError, refusal
from plumb.text.files import read_text, write_all, write_whole
from plumb.text.ours import PRACTICE_MARKS
from plumb.vm import practice
from plumb.vm.owner import plain_machine
from plumb.vm.practice import Practice
from plumb.vm.practice_file import NAME, game_in, game_text
from plumb.vm.secret import LEVELS

SETTINGS, MARKS = "machine.toml", "marks.toml"
GRID = re.compile(r"(\d+)x(\d+)")
SEEDS = 1_000_000


def run(arguments: argparse.Namespace) -> int:
    """Take a step of a game, or let the lab play, and return the exit code."""
    if arguments.auto or arguments.matrix:
        if arguments.step:
            raise InputError(f"--auto plays whole games: leave out {arguments.step}")
        return run_auto(arguments)
    if not arguments.step or not arguments.folder:
        raise InputError(f"name a step ({', '.join(STEPS)}) and a folder, or give --auto")
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
    believed = game.owner().settings
    settings = machine_toml(believed, comment="What the owner of the virtual machine believes.")
    Path(folder, MARKS).unlink(missing_ok=True)
    write_all({str(folder / SETTINGS): settings.encode(), str(folder / NAME): _bytes(game)})
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
    plan = _grid(match, settings) if match else read_plan(wanted, sheet=settings.sheet)
    game, form = practice.cut(game, settings, practice.visits_of(plan, settings))
    count = _append(arguments, game, form)
    marks = str(Path(arguments.folder, MARKS))
    said = [f"{count} marks were cut and read: {marks} has them.", left_sentence(game)]
    inputs = [str(Path(arguments.folder, SETTINGS)), marks]
    return _done(arguments, game, said, next_step("What do they show?", ["diagnose", *inputs]))


def _grid(match: re.Match[str], settings: MachineSettings) -> Measurements:
    """The marks of a grid over the sheet."""
    grid = Grid(columns=int(match[1]), rows=int(match[2]), repeats=0)
    try:
        touches = touches_of(grid, plain_machine(settings))
    except GridError as error:
        raise InputError(f"{match[0]}: {error}") from None
    side = float(grid.approach[0]), float(grid.approach[1])
    places = [(touch.name, (touch.x, touch.y)) for touch in touches]
    return Measurements(tuple(Mark(name, at, at, approach=side) for name, at in places))


def _append(arguments: argparse.Namespace, game: Practice, form: str) -> int:
    """Add the marks of a filled form to the folder's, and keep the game; how many they are."""
    path = Path(arguments.folder, MARKS)
    _, separator, tables = form.partition("[[mark]]")
    old = read_text(path).rstrip() + "\n\n" if path.exists() else _head(arguments, str(path))
    text = f"{old}{separator}{tables}"
    write_all({str(path): text.encode(), str(Path(arguments.folder, NAME)): _bytes(game)})
    return tables.count("measured = ")


def _head(arguments: argparse.Namespace, path: str) -> str:
    """How the file of the marks begins: from which corner, and which settings were in force."""
    named = cut_with_lines(str(Path(arguments.folder, SETTINGS)), path)
    said = 'frame = "sheet-top-left"\ncontroller = "plumb"\ntape_sigma_mm = 0.4'
    return f"{PRACTICE_MARKS.decode()}{said}{named}\n\n"


def _read(arguments: argparse.Namespace) -> int:
    """Read marks of the sheet once more."""
    game, settings = game_in(arguments.folder), _believed(arguments)
    if not arguments.what:
        raise InputError("practice read: name the marks to be read again")
    path = Path(arguments.folder, MARKS)
    game, readings = practice.read_again(game, arguments.what)
    first = {mark.name: mark for mark in read_marks(path, sheet=settings.sheet).marks[::-1]}
    lines = [_again(first.get(name), name, (x, y), settings) for name, x, y in readings]
    text = read_text(path).rstrip() + "\n" + "".join(lines)
    write_all({str(path): text.encode(), str(Path(arguments.folder, NAME)): _bytes(game)})
    said = [
        f"Read again: {', '.join(arguments.what)}. {path} has the new readings at its end, and "
        "the old ones where they were: take a wrong one away.",
        left_sentence(game),
    ]
    return _done(arguments, game, said, "")


def _again(
    mark: Mark | None, name: str, reading: tuple[float, float], settings: MachineSettings
) -> str:
    """A second reading of a mark, cut as it was."""
    if mark is None:
        raise InputError(f"practice read: {name} is no longer in the file of the marks")
    width, height = settings.sheet
    side = mark.approach or (0.0, 0.0)
    return (
        f'\n[[mark]]\nname = "{name}"\n'
        f"target = [{mark.target[0] + width / 2:.3f}, {height / 2 - mark.target[1]:.3f}]\n"
        f"sled_weight_n = {mark.sled_weight or settings.sled_weight:.1f}\n"
        f"approach = [{side[0] + 0.0:.3f}, {0.0 - side[1]:.3f}]\n"
        f"measured = [{reading[0] + width / 2:.1f}, {height / 2 - reading[1]:.1f}]  # read again\n"
    )


def _check(arguments: argparse.Namespace) -> int:
    """Measure something directly."""
    name = _single(arguments, "what to measure directly, like motor_gap")
    game, checks, known = practice.check(game_in(arguments.folder), name)
    write_whole(str(Path(arguments.folder, NAME)), _bytes(game))
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
    write_whole(str(Path(arguments.folder, NAME)), _bytes(game))
    return _done(arguments, game, [said, left_sentence(game)], "", hint=said)


def _solve(arguments: argparse.Namespace) -> int:
    """Cut a second sheet with new settings, and tell the secret."""
    game, believed = game_in(arguments.folder), _believed(arguments)
    machine = read_settings(_single(arguments, "the new machine.toml"), known=known_effects())
    marks = read_marks(Path(arguments.folder, MARKS), sheet=believed.sheet, known=known_effects())
    score = practice.solve(game, Inputs(believed, marks), machine)
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


def _bytes(game: Practice) -> bytes:
    return game_text(game).encode()


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
