"""Measures how well the diagnosis weighs evidence: boards of each kind, real sets, proposals.

With --save the records go to a file, next to what it has of the same seed; with --table two such
files become a table before and after. Rates are counted from records: no board is diagnosed again.
"""

from __future__ import annotations

import argparse
import json
import os
import sys
from collections.abc import Callable, Iterable, Iterator, Sequence
from dataclasses import dataclass, field
from multiprocessing import get_context
from pathlib import Path
from typing import Any

from gate_kinds import KINDS
from gate_more_tables import real_tables, round_tables
from gate_records import Record, record_of
from gate_rounds import ASKED, Round, real_answers, rounds_of
from gate_tables import tables
from plumb.cli.arguments import count
from plumb.text.errors import InputError

Task = tuple[Callable[..., Any], tuple[Any, ...]]
AT_ONCE = 5  # boards of a kind that a process takes
THREADS = ("OPENBLAS_NUM_THREADS", "OMP_NUM_THREADS", "MKL_NUM_THREADS")


@dataclass
class Saved:
    """What was measured with a seed."""

    seed: int
    records: list[dict[str, Any]] = field(default_factory=list)
    real: list[dict[str, Any]] = field(default_factory=list)
    proposals: list[dict[str, Any]] = field(default_factory=list)

    @staticmethod
    def read(path: Path) -> Saved:
        """Return what a file has."""
        return Saved(**json.loads(path.read_text()))

    def with_records(self, records: Iterable[dict[str, Any]]) -> None:
        """Take records in; a board that is there already is replaced."""
        several = {(each["kind"], each["index"]): each for each in (*self.records, *records)}
        places = {name: place for place, name in enumerate(KINDS)}
        self.records = sorted(
            several.values(), key=lambda each: (places[each["kind"]], each["index"])
        )


def main(arguments: Sequence[str] | None = None) -> int:
    """Measure or print, and return the exit code: 0 done, 2 it cannot run, 130 interrupted."""
    words = argparse.ArgumentParser(description=__doc__)
    words.add_argument("--boards", metavar="N", type=count, default=0, help="of each kind")
    words.add_argument("--first", metavar="I", type=int, default=0, help="number of the first [0]")
    words.add_argument("--seed", metavar="S", type=int, default=1, help="other boards [1]")
    words.add_argument("--jobs", metavar="N", type=count, default=1, help="processes at once [1]")
    words.add_argument("--kinds", metavar="KIND", nargs="+", default=[""], help="or beginnings")
    words.add_argument("--save", metavar="FILE", type=Path, help="the records, as JSON")
    words.add_argument("--next", metavar="N", type=count, default=0, help="proposals carried out")
    words.add_argument("--real", action="store_true", help="the sets of examples/ too")
    words.add_argument("--table", metavar="FILE", nargs="+", type=Path, help="before, and after")
    words.add_argument("--list", action="store_true", help="print the kinds")
    wanted = words.parse_args(arguments)
    try:
        return _run(wanted)
    except InputError as error:
        print(f"evidence_gates.py: {error}", file=sys.stderr)
        return 2
    except KeyboardInterrupt:
        return 130


def _run(wanted: argparse.Namespace) -> int:
    kinds = _chosen(wanted.kinds)
    if wanted.list:
        print("\n".join(f"{name}: {KINDS[name].what}" for name in kinds))
        return 0
    if wanted.table:
        print(tables_of([Saved.read(path) for path in wanted.table[:2]]))
        return 0
    if not wanted.save:
        raise InputError("name a file with --save")
    saved = _so_far(wanted.save, wanted.seed)
    indices = range(wanted.first, wanted.first + wanted.boards)
    boards: list[Task] = [
        (_records, (kind, tuple(indices[start : start + AT_ONCE]), wanted.seed))
        for start in range(0, len(indices), AT_ONCE)
        for kind in kinds
    ]
    try:
        for records in _done(boards, wanted.jobs):
            saved.with_records(records)
        if wanted.next:
            saved.proposals = _rounds(wanted)
        if wanted.real:
            saved.real = real_answers()
    finally:
        wanted.save.write_text(json.dumps(vars(saved), default=float))
    return 0


def tables_of(sides: Sequence[Saved]) -> str:
    """Return all tables of what was saved; boards that only a side has are left out."""
    if len({side.seed for side in sides}) > 1:
        raise InputError("both files must have the boards of the same seed")
    boards = [{(each["kind"], each["index"]): each for each in side.records} for side in sides]
    both = [key for key in boards[0] if all(key in side for side in boards)]
    parts = [tables([[Record.of(side[key]) for key in both] for side in boards])]
    if any(side.proposals for side in sides):
        parts.append(round_tables([side.proposals for side in sides]))
    if any(side.real for side in sides):
        parts.append(real_tables([side.real for side in sides]))
    return "\n\n".join(parts)


def _chosen(beginnings: Sequence[str]) -> tuple[str, ...]:
    """Return the kinds whose names begin so, with or without their world."""
    chosen = tuple(
        name
        for name in KINDS
        if any(each.startswith(tuple(beginnings)) for each in (name, name.partition("/")[2]))
    )
    if not chosen:
        raise InputError(f"no kind begins with {' or '.join(beginnings)}; --list prints them")
    return chosen


def _so_far(path: Path, seed: int) -> Saved:
    """Return what a file has of this seed."""
    if not path.exists():
        return Saved(seed)
    saved = Saved.read(path)
    if saved.seed != seed:
        raise InputError(path, f"has the boards of seed {saved.seed}", remedy="take another file")
    return saved


def _records(kind: str, indices: Sequence[int], seed: int) -> list[dict[str, Any]]:
    return [record_of(kind, index, seed=seed) for index in indices]


def _done(tasks: Sequence[Task], jobs: int) -> Iterator[Any]:
    """Yield what comes of each task, in their order; each process has a single thread."""
    if not tasks:
        return
    os.environ.update(dict.fromkeys(THREADS, "1"))
    with get_context("spawn").Pool(jobs) as pool:
        for number, result in enumerate(pool.imap(_call, tasks), 1):
            print(f"\r{number} of {len(tasks)}", end="", file=sys.stderr)
            yield result
        print(file=sys.stderr)


def _rounds(wanted: argparse.Namespace) -> list[dict[str, Any]]:
    """Return rounds until as many had a promise as are wanted."""
    several: list[dict[str, Any]] = []
    tasks: list[Task] = [
        (rounds_of, (kind, index, wanted.seed)) for index in range(wanted.next) for kind in ASKED
    ]
    for rounds in _done(tasks, wanted.jobs):
        several += rounds
        if sum(Round(**each).is_promised for each in several) >= wanted.next:
            break
    return several


def _call(task: Task) -> Any:
    do, given = task
    return do(*given)


if __name__ == "__main__":
    sys.exit(main())
