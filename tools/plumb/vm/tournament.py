"""Many games by the lab's advice, and the rates of what came of them; each is kept when it ends."""

from __future__ import annotations

import json
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import joblib  # type: ignore[import-untyped]  # it brings no types

from plumb.grid.options import Grid
from plumb.text.errors import refusal
from plumb.vm.budget import Budget
from plumb.vm.game import Played, play
from plumb.vm.secret import KINDS, LEVELS, of_kind, of_level

LARGE_GRID = Grid(columns=5, rows=5, repeats=0)
SMALL_GRID = Grid(columns=3, rows=3, repeats=0)
GRIDS = {"25": LARGE_GRID, "9": SMALL_GRID}


@dataclass(frozen=True)
class Task:
    """A game to play: a row of the table, and which game of it."""

    row: str  # "level 3", or "chain_sag 25"
    seed: int

    def play(self, budget: Budget, elf: str | None) -> Played:
        """Play it."""
        what, _, which = self.row.rpartition(" ")
        if what == "level":
            secret, grid = of_level(int(which), self.seed), LARGE_GRID
        else:
            secret, grid = of_kind(what, self.seed), GRIDS[which]
        return play(self.row, secret, seed=self.seed, grid=grid, budget=budget, elf=elf)


def level_tasks(levels: Sequence[int], games: int, seed: int) -> list[Task]:
    """A number of games of each level, in turns."""
    rows = [f"level {level}" for level in levels]
    return [Task(row, seed + game) for game in range(games) for row in rows]


def matrix_tasks(games: int, seed: int) -> list[Task]:
    """A number of games of each cell of the matrix, in turns, so that none is far behind."""
    rows = [f"{kind} {marks}" for marks in GRIDS for kind in KINDS]
    return [Task(row, seed + game) for game in range(games) for row in rows]


def all_levels() -> tuple[int, ...]:
    """The levels there are."""
    return tuple(LEVELS)


def played(
    tasks: Sequence[Task],
    *,
    budget: Budget,
    elf: str | None,
    kept: str | None,
    jobs: int,
) -> Iterator[Played]:
    """The games that the file `kept` has, then those that it lacks; each is added as it ends."""
    done = {(game.row, game.seed): game for game in _kept(kept)}
    waiting = []
    for task in tasks:
        old = done.get((task.row, task.seed))
        if old:
            yield old
        else:
            waiting.append(task)
    for game in _run(waiting, budget, elf, jobs):
        if kept:
            with open(kept, "a", encoding="utf-8") as file:
                file.write(json.dumps(asdict(game)) + "\n")
        yield game


def _run(tasks: Sequence[Task], budget: Budget, elf: str | None, jobs: int) -> Iterator[Played]:
    if jobs == 1:
        yield from (task.play(budget, elf) for task in tasks)
        return
    pool = joblib.Parallel(n_jobs=jobs, return_as="generator_unordered")
    yield from pool(joblib.delayed(Task.play)(task, budget, elf) for task in tasks)


def _kept(path: str | None) -> list[Played]:
    """The games of a file; InputError for a file of something else."""
    if path is None or not Path(path).exists():
        return []
    games = []
    for number, line in enumerate(Path(path).read_text(encoding="utf-8").splitlines(), 1):
        try:
            said = json.loads(line)
            said |= {name: tuple(said[name]) for name in ("claimed", "chosen")}
            games.append(Played(**said))
        except (ValueError, TypeError, KeyError):
            raise refusal(
                path, "is no game", place=f"line {number}", remedy="name another file"
            ) from None
    return games
