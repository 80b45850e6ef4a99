"""`plumb bench`: how often the diagnosis is right on boards with hidden effects."""

from __future__ import annotations

import argparse
from collections.abc import Callable, Sequence

from plumb.bench.report import (
    CURE_HEADER,
    HEADER,
    LOOP_HEADER,
    Report,
    cells,
    cure_cells,
    line_words,
    loop_cells,
    value_words,
)
from plumb.bench.report import run as run_bench
from plumb.bench.scenarios import CURE, LOOP, NAMES, SCENARIOS, Scenario
from plumb.cli.arguments import add_json, count
from plumb.cli.output import INTERRUPTED
from plumb.cli.screen import Bar, print_json, sentences, table
from plumb.text.errors import InputError


def run(arguments: argparse.Namespace) -> int:
    """Run the bench, print its table, and return the exit code."""
    chosen = chosen_of(arguments.scenario)
    boards = arguments.boards or (FAST if arguments.fast else BOARDS)
    report = run_bench(
        chosen,
        boards=boards,
        seed=arguments.seed,
        progress=counted(len(chosen) * boards),
        jobs=arguments.jobs,
    )
    if arguments.json:
        print_json(report)
    else:
        print(as_text(report))
    return INTERRUPTED if report.interrupted else 0


def chosen_of(names: Sequence[str]) -> tuple[Scenario, ...]:
    """Return the scenarios of these names or beginnings of names; all if there are none."""
    for name in names:
        if not any(known.startswith(name) for known in NAMES):
            raise InputError(
                f"--scenario {name}: there is no scenario of that name; known are "
                f"{', '.join(NAMES)}"
            )
    return tuple(
        scenario
        for scenario in SCENARIOS
        if not names or any(scenario.name.startswith(known) for known in names)
    )


def counted(total: int) -> Callable[[str, int], None]:
    """Return a bar that is moved on by a number of boards of a scenario."""
    bar, done = Bar("boards", patience=0.0), 0

    def step(name: str, boards: int) -> None:
        nonlocal done
        done += boards
        bar.show(done / total, f"{done} of {total} boards, {name}")

    return step


def as_text(report: Report) -> str:
    """Return the tables for people, what is missed last."""
    parts = [_rates_of(name, report) for name in dict.fromkeys(row[0] for row in cells(report))]
    if report.cures:
        parts.append(table(CURE_HEADER, cure_cells(report.cures)))
        parts.append(
            sentences(
                [
                    "Error of the judge's sled over the whole sheet, RMS of its shape: by the "
                    "settings as they were, with the frame refitted, with what was named added, "
                    f"and with the truth added. Line for the ratio: {line_words(CURE)}, "
                    f"{report.cure_judged}."
                ],
                mark="",
            )
        )
    if report.loops:
        parts.append(table(LOOP_HEADER, loop_cells(report.loops)))
        said = f"Line for the ratio: {line_words(LOOP)}, {report.loop_judged}."
        parts.append(
            sentences([f"The same after two rounds of what plumb next proposes. {said}"], mark="")
        )
    missed = [
        f"missed: {row.scenario}, {row.name} {value_words(row)}, line {line_words(row.line)}"
        for row in report.missed
    ]
    reached = f"{report.boards} boards of each scenario, seed {report.seed}: no line is missed"
    parts.append(sentences(missed or [reached], mark=""))
    if report.interrupted:
        parts.append(f"Interrupted: {report.counted} boards are counted.")
    return "\n\n".join(parts)


def _rates_of(name: str, report: Report) -> str:
    """Return the rates of a scenario, below what it hides."""
    rows = [row for row in cells(report) if row[0] == name]
    _, hidden, marks, noise, *_ = rows[0]
    said = f"{name}: {hidden}, {marks} marks, noise {noise}"
    return f"{said}\n{table(HEADER[4:], [row[4:] for row in rows], words=[-2, -1])}"


# The arguments of `plumb bench`.

BOARDS, FAST = 200, 10  # of each scenario
EXAMPLES = (
    "plumb bench --fast",
    "plumb bench --scenario one-9 --boards 100",
)
EXIT = "Exit: 0 done, whatever the rates; 2 it cannot run; 130 interrupted, what is done is kept."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb bench`."""
    parser.add_argument(
        "--scenario",
        metavar="NAME",
        nargs="+",
        action="extend",
        default=[],
        help="only scenarios whose names begin like this (docs/bench.md lists them)",
    )
    parser.add_argument(
        "--boards", metavar="N", type=count, help=f"boards of each scenario [{BOARDS}]"
    )
    parser.add_argument("--fast", action="store_true", help=f"{FAST} boards of each scenario")
    parser.add_argument(
        "--seed",
        metavar="S",
        type=int,
        default=1,
        help="draws the boards; the same seed, the same boards [1]",
    )
    parser.add_argument("--jobs", metavar="N", type=count, default=1, help="processes at once [1]")
    add_json(parser)
