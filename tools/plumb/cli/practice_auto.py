"""`plumb practice --auto`: the lab's advice plays many games, and the rates are printed."""

from __future__ import annotations

import argparse

from plumb.cli.ending import INTERRUPTED
from plumb.cli.output import refuse_early, write_outputs
from plumb.cli.practice_text import as_json, as_text
from plumb.cli.screen import Bar
from plumb.cli.text import print_json
from plumb.vm.budget import Budget
from plumb.vm.game import Played
from plumb.vm.page import page
from plumb.vm.tournament import all_levels, level_tasks, matrix_tasks, played


def run_auto(arguments: argparse.Namespace) -> int:
    """Play, print the rates, and return the exit code."""
    refuse_early(arguments.write)
    seed = 1 if arguments.seed is None else arguments.seed
    levels = [arguments.level] if arguments.level else all_levels()
    tasks = (
        matrix_tasks(arguments.games, seed)
        if arguments.matrix
        else level_tasks(levels, arguments.games, seed)
    )
    bar, games = Bar("games", patience=0.0), list[Played]()
    interrupted = False
    try:
        for game in played(
            tasks,
            budget=Budget(),
            elf=arguments.mega,
            kept=arguments.keep,
            jobs=arguments.jobs,
        ):
            games.append(game)
            bar.show(len(games) / len(tasks), f"{len(games)} of {len(tasks)} games, {game.row}")
    except KeyboardInterrupt:
        interrupted = True
    finally:
        bar.clear()
    if arguments.write:
        write_outputs({arguments.write: page(games).encode()}, inputs=[])
    if arguments.json:
        print_json(as_json(games, interrupted=interrupted))
    elif games:
        print(as_text(games))
    return INTERRUPTED if interrupted else 0
