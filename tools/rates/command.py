"""How often the diagnosis is right: boards with hidden effects, diagnosed, cured and counted."""

import argparse
import json
import sys
from collections.abc import Callable, Sequence
from dataclasses import asdict

from kinds import GRIDS, KINDS
from plumb.cli.arguments import count, positive
from plumb.cli.output import INTERRUPTED
from plumb.cli.screen import Bar, sentences, table
from plumb.text.values import MM
from rates import Report, Row, WantedBoards, play

BOARDS = 20  # of each kind
EXIT = "Exit: 0 done, whatever the rates; 2 it cannot run; 130 interrupted, what is done is kept."


def main(words: Sequence[str] | None = None) -> int:
    """Play the boards, print the table, and return the exit code."""
    parser = argparse.ArgumentParser("tools/rates/run", description=__doc__, epilog=EXIT)
    add_arguments(parser)
    arguments = parser.parse_args(words)
    try:
        kinds = chosen_of(arguments.kinds)
    except ValueError as error:
        parser.error(str(error))
    wanted = WantedBoards(
        kinds,
        arguments.boards,
        arguments.marks,
        arguments.seed,
        arguments.noise,
        not arguments.unstated,
    )
    try:
        report = play(wanted, progress=counted(len(kinds) * wanted.boards), jobs=arguments.jobs)
    except KeyboardInterrupt:
        return INTERRUPTED
    print(json.dumps(asdict(report), indent=2) if arguments.json else as_text(report))
    return INTERRUPTED if report.interrupted else 0


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments."""
    parser.add_argument(
        "--kinds",
        metavar="KIND",
        nargs="+",
        action="extend",
        default=[],
        help="only kinds whose names begin like this, with or without known/ or stock/",
    )
    parser.add_argument(
        "--boards", metavar="N", type=count, default=BOARDS, help=f"boards of each kind [{BOARDS}]"
    )
    parser.add_argument(
        "--marks", type=int, choices=GRIDS, default=25, help="marks on each board [25]"
    )
    parser.add_argument(
        "--noise",
        metavar="MM",
        type=positive,
        help="of each coordinate, instead of what the kinds have",
    )
    parser.add_argument(
        "--unstated", action="store_true", help="the files of marks do not state the noise"
    )
    parser.add_argument(
        "--seed",
        metavar="S",
        type=int,
        default=1,
        help="draws the boards; the same seed, the same boards [1]",
    )
    parser.add_argument("--jobs", metavar="N", type=count, default=1, help="processes at once [1]")
    parser.add_argument("--json", action="store_true", help="all figures as JSON")


def chosen_of(beginnings: Sequence[str]) -> tuple[str, ...]:
    """Return the kinds whose names begin so, with or without their world; all if none is given."""
    names = {name: (name, name.partition("/")[2]) for name in KINDS}
    for beginning in beginnings:
        if not any(each.startswith(beginning) for both in names.values() for each in both):
            raise ValueError(f"--kinds {beginning}: no kind begins so; they are {', '.join(KINDS)}")
    chosen = tuple(beginnings) or ("",)
    return tuple(
        name for name, both in names.items() if any(each.startswith(chosen) for each in both)
    )


def counted(total: int) -> Callable[[str], None]:
    """Return a bar that each board moves on."""
    bar, done = Bar("boards", patience=0.0), 0

    def step(kind: str) -> None:
        nonlocal done
        done += 1
        bar.show(done / total, f"{done} of {total} boards, {kind}")

    return step


HEADER = (
    "kind",
    "n",
    "named",
    "exact",
    "truth",
    "extra",
    "new",
    "slips",
    "before",
    "after",
    "fitted",
    "worse",
    "CPU",
)
LEGEND = (
    "Percent of n boards. named: an effect; exact: all that the marks can show of what is there, "
    "and nothing else; truth: the best explanation has all of that; new: it is said that the "
    "machine does what the library does not know; slips: the readings set aside are just those "
    "that are wrong; worse: the sled errs more than before.",
    "extra: effects named a board that are not there. CPU: seconds a board.",
    "before, after, fitted: mean error of the judge's sled over the sheet [mm RMS] by the settings "
    "as they were, by those that plumb add --effect auto leaves, and with what is there fitted.",
)


def as_text(report: Report) -> str:
    """Return the table for people."""
    parts = [
        table(HEADER, [cells(row) for row in report.rows], gap=1),
        sentences(LEGEND, mark=""),
        sentences(
            [f"Boards of {report.marks} marks, seed {report.seed}{_noise_words(report)}."], mark=""
        ),
        _promises_sentence(report),
    ]
    if report.interrupted:
        parts.append("Interrupted: what is done is counted.")
    return "\n\n".join(filter(None, parts))


def _noise_words(report: Report) -> str:
    said = f", noise {MM.worded(report.noise)}" if report.noise else ""
    return said if report.is_stated else f"{said}, not stated"


def _promises_sentence(report: Report) -> str:
    said = report.promises
    if said is None:
        return ""
    return sentences(
        [
            f"Promised over the sheet: {MM.worded(said.promised)}, the mean of {said.boards} "
            f"boards; {MM.worded(said.came_true)} came true."
        ],
        mark="",
    )


def cells(row: Row) -> list[str]:
    """Return the cells of a row."""
    shares = (row.named, row.exact, row.holds, row.unknown, row.readings, row.worse)
    named, exact, holds, unknown, readings, worse = (f"{100 * share:.0f}" for share in shares)
    lengths = [f"{value:.2f}" for value in (row.before, row.after, row.fitted)]
    extra = f"{row.needless:.2f}"
    if KINDS[row.kind].slips:  # no effect is named before the reading is taken again
        named = exact = holds = extra = "-"
    said = [row.kind, f"{row.boards}", named, exact, holds, extra, unknown, readings]
    return [*said, *lengths, worse, f"{row.cpu:.2f}"]


if __name__ == "__main__":
    sys.exit(main())
