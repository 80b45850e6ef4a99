"""Lets the lab's advice calibrate virtual machines, and prints how often it finds what they hide.

Each game is kept when it ends: a run that was stopped goes on where it was. --write writes
tools/research/matrix.md.
"""

from __future__ import annotations

import argparse
import json
import sys
from collections.abc import Iterator, Sequence
from dataclasses import asdict, dataclass
from pathlib import Path

import joblib  # type: ignore[import-untyped]  # it brings no types
from game import Played, play
from game_rates import Row, row_of, rows_of
from kinds import KINDS, of_kind
from matrix_page import page, ratio_words
from plumb.cli.arguments import add_force, count
from plumb.cli.output import INTERRUPTED, ended, refuse_early, results_of, write_outputs
from plumb.cli.screen import Bar, sentences, table
from plumb.grid.options import Grid
from plumb.text.errors import InputError
from plumb.text.values import bare, unit
from plumb.vm.loop import Budget

GRIDS = {
    "25": Grid(columns=5, rows=5, repeats=False),
    "9": Grid(columns=3, rows=3, repeats=False),
}
HEADER = (
    "hidden",
    "games",
    "solved",
    "false",
    "marks",
    "minutes",
    "before",
    "after",
    "best",
    "ratio",
)


@dataclass(frozen=True)
class Task:
    """A game to play: a row of the table, and which game of it."""

    row: str  # "chain_sag 25"
    seed: int

    def play(self, budget: Budget, elf: str | None) -> Played:
        """Play it."""
        kind, _, marks = self.row.rpartition(" ")
        hidden, grid = of_kind(kind, self.seed), GRIDS[marks]
        return play(self.row, hidden, seed=self.seed, grid=grid, budget=budget, elf=elf)


def matrix_tasks(games: int, seed: int) -> list[Task]:
    """Return a number of games of each cell of the matrix, in turns, so that none is far behind."""
    rows = [f"{kind} {marks}" for marks in GRIDS for kind in KINDS]
    return [Task(row, seed + game) for game in range(games) for row in rows]


def played(
    tasks: Sequence[Task],
    *,
    budget: Budget,
    elf: str | None,
    kept: str | None,
    jobs: int,
) -> Iterator[Played]:
    """Yield the games that the file `kept` has, then those that it lacks; each is added as
    it ends.
    """
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
    """Return the games of a file; InputError for a file of something else."""
    if path is None or not Path(path).exists():
        return []
    games = []
    for number, line in enumerate(Path(path).read_text(encoding="utf-8").splitlines(), 1):
        try:
            said = json.loads(line)
            said |= {name: tuple(said[name]) for name in ("claimed", "chosen")}
            games.append(Played(**said))
        except (ValueError, TypeError, KeyError):
            raise InputError(
                path, "is no game", place=f"line {number}", remedy="name another file"
            ) from None
    return games


def parser() -> argparse.ArgumentParser:
    """Return the words that the script understands."""
    words = argparse.ArgumentParser(
        description=__doc__,
        epilog="Exit: 0 done; 2 it cannot run; 130 interrupted, what is done is kept.",
    )
    words.add_argument("--seed", metavar="S", type=int, default=1, help="other machines [1]")
    words.add_argument("--games", metavar="N", type=count, default=4, help="of each row [4]")
    words.add_argument("--jobs", metavar="N", type=count, default=1, help="games at once [1]")
    words.add_argument("--keep", metavar="FILE", help="adds each game; plays only what it lacks")
    words.add_argument("--write", metavar="FILE", help="write the page with the matrix")
    words.add_argument("--mega", metavar="ELF", help="play on a simulated Mega: slow")
    add_force(words)
    return words


def main(arguments: Sequence[str] | None = None) -> int:
    """Play, print the rates, and return the exit code."""
    wanted = parser().parse_args(arguments)
    return ended(lambda: _play(wanted), name="games.py")


def _play(wanted: argparse.Namespace) -> int:
    tasks = matrix_tasks(wanted.games, wanted.seed)
    games, interrupted = list[Played](), False
    with results_of(wanted):
        refuse_early(wanted.write)
        bar = Bar("games", patience=0.0)
        try:
            for game in played(
                tasks, budget=Budget(), elf=wanted.mega, kept=wanted.keep, jobs=wanted.jobs
            ):
                games.append(game)
                bar.show(len(games) / len(tasks), f"{len(games)} of {len(tasks)} games, {game.row}")
        except KeyboardInterrupt:
            interrupted = True
        finally:
            bar.clear()
        if wanted.write:
            write_outputs({wanted.write: page(games).encode()}, inputs=[])
    if games:
        print(as_text(games))
    return INTERRUPTED if interrupted else 0


def as_text(games: Sequence[Played]) -> str:
    """Return the rates of many games for people."""
    rows = [*rows_of(games), *([row_of("all", games)] if len(games) > 1 else [])]
    note = (
        "Solved: just what is hidden was added, or reported as not in the library; interval of "
        "95 %. False: claims of what is not there, in all games. Before, after, best: error of the "
        f"sled all over the sheet without noise, {unit()} RMS; best is a fit of the same marks by "
        "somebody who knows what is hidden. Ratio: after to best."
    )
    return f"{table(HEADER, [cells(row) for row in rows], gap=1)}\n\n{sentences([note], mark='')}"


def cells(row: Row) -> list[str]:
    """Return a row of the table."""
    share, low, high = row.solved
    return [
        row.name,
        str(row.games),
        f"{100 * share:.0f} % ({100 * low:.0f}-{100 * high:.0f})",
        str(row.false),
        f"{row.marks:.0f}",
        f"{row.minutes:.0f}",
        bare(row.before),
        bare(row.after),
        bare(row.known),
        ratio_words(row.sled_ratio),
    ]


if __name__ == "__main__":
    sys.exit(main())
