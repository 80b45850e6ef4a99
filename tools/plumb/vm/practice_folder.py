"""The folder of a game: what an owner has. Settings that he believes, marks, and the game's state.

Each step hands back the files that it changes, for whoever writes them.
"""

from __future__ import annotations

from collections.abc import Callable, Sequence
from dataclasses import dataclass
from pathlib import Path

from plumb.fit.inputs import Inputs
from plumb.grid.cut_with import cut_with_lines
from plumb.grid.options import Grid, GridError
from plumb.grid.pattern import touches_of
from plumb.marks.read import Mark, Measurements, read_marks
from plumb.model.predict import known_effects
from plumb.settings.files import machine_toml
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError
from plumb.text.files import PRACTICE_MARKS, read_text
from plumb.vm import practice
from plumb.vm.owner import plain_machine
from plumb.vm.practice import Practice, Score
from plumb.vm.practice_file import NAME, game_text

SETTINGS, MARKS = "machine.toml", "marks.toml"


@dataclass(frozen=True)
class Step:
    """A game after a step, and the files that it changed, by name."""

    game: Practice
    files: dict[str, bytes]
    marks: int = 0  # that were read


def begun(game: Practice) -> Step:
    """The folder at the beginning; marks of an earlier game do not belong to it."""
    believed = game.believed
    settings = machine_toml(believed, comment="What the owner of the virtual machine believes.")
    return Step(game, {SETTINGS: settings.encode(), NAME: game_bytes(game)})


def grid_marks(columns: int, rows: int, settings: MachineSettings) -> Measurements:
    """The marks of a grid over the sheet. Raises InputError if it does not fit."""
    grid = Grid(columns=columns, rows=rows, repeats=0)
    try:
        touches = touches_of(grid, plain_machine(settings))
    except GridError as error:
        raise InputError(f"{columns}x{rows}: {error}") from None
    side = float(grid.approach[0]), float(grid.approach[1])
    places = [(touch.name, (touch.x, touch.y)) for touch in touches]
    return Measurements(tuple(Mark(name, at, at, approach=side) for name, at in places))


def cut(
    folder: Path,
    game: Practice,
    settings: MachineSettings,
    plan: Measurements,
    done: Callable[[int], None] | None = None,
) -> Step:
    """Cut marks, read them, and add them to the marks of the folder; `done` counts the marks."""
    visits = practice.visits_of(plan, settings)
    after, form = practice.cut(game, settings, visits, done)
    path = folder / MARKS
    _, separator, tables = form.partition("[[mark]]")
    old = read_text(path).rstrip() + "\n\n" if path.exists() else _head(folder)
    text = f"{old}{separator}{tables}"
    files = {MARKS: text.encode(), NAME: game_bytes(after)}
    return Step(after, files, tables.count("measured = "))


def read_again(
    folder: Path, game: Practice, settings: MachineSettings, names: Sequence[str]
) -> Step:
    """Read marks of the sheet once more; the readings go to the end of the folder's marks."""
    path = folder / MARKS
    after, readings = practice.read_again(game, names)
    first = {mark.name: mark for mark in read_marks(path, sheet=settings.sheet).marks[::-1]}
    lines = [_again(first.get(name), name, (x, y), settings) for name, x, y in readings]
    text = read_text(path).rstrip() + "\n" + "".join(lines)
    return Step(after, {MARKS: text.encode(), NAME: game_bytes(after)}, len(readings))


def solve(
    folder: Path,
    game: Practice,
    believed: MachineSettings,
    machine: MachineSettings,
    done: Callable[[int], None] | None = None,
) -> Score:
    """Send a machine's numbers, cut a second sheet, and look at the truth; `done` counts marks."""
    marks = read_marks(folder / MARKS, sheet=believed.sheet, known=known_effects())
    return practice.solve(game, Inputs(believed, marks), machine, done)


def game_bytes(game: Practice) -> bytes:
    """The file that keeps the game."""
    return game_text(game).encode()


def _head(folder: Path) -> str:
    """How the file of the marks begins: from which corner, and which settings were in force."""
    named = cut_with_lines(str(folder / SETTINGS), str(folder / MARKS))
    said = 'frame = "sheet-top-left"\ncontroller = "plumb"\ntape_sigma_mm = 0.4'
    return f"{PRACTICE_MARKS.decode()}{said}{named}\n\n"


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
