"""Lets faults strike a virtual machine; tools/research/faults.md says what it did with each."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Sequence
from dataclasses import dataclass

from fault_stories import FAULTS, UNSEEN, Fault
from plumb.cli.arguments import add_force, count
from plumb.cli.output import ended, refuse_early, results_of, write_outputs
from plumb.cli.screen import Bar, sentences, table
from plumb.text.errors import InputError
from tables import markdown_table
from trial import BELIEVED, Outcome, tried

HEADER = (
    "fault",
    "tried",
    "noticed",
    "stopped within, mm",
    "off its way, mm",
    "sure and astray, mm",
    "false beliefs",
)
UNSEEN_HEADER = ("fault", "tried", "noticed", "sure and astray, mm", "who catches it")


@dataclass(frozen=True)
class FaultRow:
    """All that came of a fault."""

    fault: Fault
    outcomes: tuple[Outcome, ...]

    @property
    def noticed(self) -> int:
        """How often the machine said so."""
        return sum(outcome.noticed for outcome in self.outcomes)

    @property
    def false_beliefs(self) -> int:
        """How often the machine was sure of a place where it was not."""
        return sum(outcome.is_false for outcome in self.outcomes)

    @property
    def settings_lost(self) -> int:
        """How often a setting had changed by itself."""
        return sum(not outcome.settings_kept for outcome in self.outcomes)

    def most(self, name: str) -> float:
        """Return the largest figure of that name; of ways after the fault, only where the job
        stopped.
        """
        stopped = [each for each in self.outcomes if each.stopped or name != "went_on"]
        return max((getattr(outcome, name) for outcome in stopped), default=0.0)

    def cells(self) -> list[str]:
        """Return the row of the table."""
        stops = any(outcome.stopped for outcome in self.outcomes)
        return [
            self.fault.name,
            str(len(self.outcomes)),
            str(self.noticed),
            f"{self.most('went_on'):.1f}" if stops else "goes on",
            f"{self.most('off'):.1f}",
            f"{self.most('astray'):.2f}",
            str(self.false_beliefs),
        ]

    def unseen_cells(self) -> list[str]:
        """Return the row of a fault that no encoder sees."""
        return [*self.cells()[:3], self.cells()[5], self.fault.caught_by]


@dataclass(frozen=True)
class FaultReport:
    """The rows of all faults that were tried."""

    rows: tuple[FaultRow, ...]
    unseen: tuple[FaultRow, ...]
    seed: int
    flashed: bool

    @property
    def is_well(self) -> bool:
        """Whether no machine was sure of a wrong place, and none lost a setting."""
        return not any(row.false_beliefs or row.settings_lost for row in self.rows)

    def last_line(self) -> str:
        """Return what all of it came to."""
        tries = sum(len(row.outcomes) for row in self.rows)
        false = sum(row.false_beliefs for row in self.rows)
        lost = sum(row.settings_lost for row in self.rows)
        machine = "the flashed program" if self.flashed else "the firmware built for the host"
        return (
            f"{tries} tries with {machine}, seeds from {self.seed}: {false} false beliefs, "
            f"{lost} times a setting was lost."
        )


def faults_named(beginnings: Sequence[str]) -> tuple[Fault, ...]:
    """Return the faults whose names begin so; all if there are none. ValueError for an unknown
    name.
    """
    for beginning in beginnings:
        if not any(fault.name.startswith(beginning) for fault in FAULTS + UNSEEN):
            names = ", ".join(fault.name for fault in FAULTS + UNSEEN)
            raise ValueError(f"no fault is called {beginning!r}; known are {names}")
    return tuple(
        fault
        for fault in FAULTS + UNSEEN
        if not beginnings or any(fault.name.startswith(beginning) for beginning in beginnings)
    )


def tried_all(
    faults: Sequence[Fault],
    *,
    tries: int,
    seed: int,
    elf: str | None = None,
    progress: Callable[[float, str], None] = lambda share, what: None,
) -> FaultReport:
    """Try each fault on a number of machines; `progress` hears the share that is done."""
    outcomes: dict[str, list[Outcome]] = {fault.name: [] for fault in faults}
    # Seed by seed, as all faults of a seed share the way without a fault.
    for number in range(tries):
        for place, fault in enumerate(faults):
            done = number * len(faults) + place
            progress(done / (tries * len(faults)), fault.name)
            for each in range(number * fault.times, (number + 1) * fault.times):
                outcomes[fault.name].append(tried(fault, seed + each, elf=elf))
    progress(1.0, "")
    rows = [FaultRow(fault, tuple(outcomes[fault.name])) for fault in faults]
    return FaultReport(
        tuple(row for row in rows if not row.fault.caught_by),
        tuple(row for row in rows if row.fault.caught_by),
        seed,
        flashed=elf is not None,
    )


INTRODUCTION = f"""# What a machine does when something goes wrong

Written by `tools/research/faults.py --tries {{tries}} --write tools/research/faults.md`;
`--seed` tries others.

Each try is a virtual machine ([tools/vm](../vm/README.md)) in the middle of a job of random
lines, arcs, curves, drillings and rests. Its motors are drawn by chance, its frame is as its
settings say. The fault strikes at any moment. Then somebody puts the wires right, presses Stop, and
switches the power off and on. Each time the machine is asked where it is.

- *Noticed*: the machine said so, or said that it does not know its place.
- *Stopped within*: the longest way of the bit from the fault until it stood, where the job stopped.
  A line that is refused stops the client; the moves before it are carried out.
- *Off its way*: how far the bit went at most from the way of the same job without the fault. A
  chain that runs by a millimetre moves the bit by up to two.
- *Sure and astray*: the largest error of a place of which the machine said that it knows it, z
  included. Beyond {BELIEVED:g} mm it is a *false belief*.
- Not noticed is what does no harm: a fault between two moves, or a sag that slows nothing.
- A spoilt character can make another line, which the machine obeys: a line has no check sum. The
  machine knows its place all the same.
"""
UNSEEN_INTRODUCTION = """
## What no encoder sees

These move the bit while all encoders count as they should. No firmware can be sure of them; the
marks can. A chain that climbs a tooth while it moves often shows in its motor's duty: the machine
says nothing, but [B30](../../docs/telemetry.md#a-chain-that-may-have-slipped) counts a suspicion.
"""


def page(report: FaultReport) -> str:
    """Return the page tools/research/faults.md."""
    tries = min(len(row.outcomes) for row in (*report.rows, *report.unseen))
    parts = [INTRODUCTION.format(tries=tries)]
    parts += [markdown_table(HEADER, [row.cells() for row in report.rows]), ""]
    parts.append(f"{report.last_line()}\n")
    if report.unseen:
        parts.append(UNSEEN_INTRODUCTION)
        parts += [markdown_table(UNSEEN_HEADER, [row.unseen_cells() for row in report.unseen]), ""]
    return "\n".join(parts).replace("\n\n\n", "\n\n")


def parser() -> argparse.ArgumentParser:
    """Return the words that the script understands."""
    words = argparse.ArgumentParser(
        description=__doc__,
        epilog="Exit: 0 no machine was sure of a wrong place and no setting was lost; 1 otherwise; "
        "2 it cannot run.",
    )
    words.add_argument(
        "--only", metavar="NAME", nargs="+", default=[], help="faults whose names begin so"
    )
    words.add_argument(
        "--tries", metavar="N", type=count, default=10, help="machines for each [%(default)s]"
    )
    words.add_argument("--seed", metavar="S", type=int, default=1, help="other machines [1]")
    words.add_argument("--mega", metavar="ELF", help="run this program on a simulated Mega")
    words.add_argument("--write", metavar="FILE", help="write the page with the table")
    add_force(words)
    return words


def main(arguments: Sequence[str] | None = None) -> int:
    """Try the faults, print the table, and return the exit code."""
    wanted = parser().parse_args(arguments)
    return ended(lambda: _run(wanted), name="faults.py", as_json=False)


def _run(wanted: argparse.Namespace) -> int:
    try:
        faults = faults_named(wanted.only)
    except ValueError as error:
        raise InputError(f"--only: {error}") from None
    with results_of(wanted):
        refuse_early(wanted.write)
        shown = Bar("faults", patience=0.0)
        report = tried_all(
            faults, tries=wanted.tries, seed=wanted.seed, elf=wanted.mega, progress=shown.show
        )
        if wanted.write:
            write_outputs({wanted.write: page(report).encode()}, inputs=[])
    print(as_text(report))
    return 0 if report.is_well else 1


def as_text(report: FaultReport) -> str:
    """Return the tables for people, then what all of it came to."""
    parts = []
    if report.rows:
        parts.append(table(HEADER, [row.cells() for row in report.rows]))
        parts.append(sentences([report.last_line()], mark=""))
    if report.unseen:
        cells = [row.unseen_cells() for row in report.unseen]
        parts.append(f"What no encoder sees:\n{table(UNSEEN_HEADER, cells, words=[-1])}")
    return "\n\n".join(parts)


if __name__ == "__main__":
    sys.exit(main())
