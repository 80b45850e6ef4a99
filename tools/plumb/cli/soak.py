"""`plumb soak`: a long time of work on a virtual machine."""

from __future__ import annotations

import argparse

from plumb.cli.screen import Bar, sentences, table
from plumb.trials.soak import Soak, soak


def run(arguments: argparse.Namespace) -> int:
    """Let it work, print what became of it, and return the exit code."""
    shown = Bar("the machine works", patience=0.0)
    worked = soak(arguments.minutes, seed=arguments.seed, elf=arguments.mega, progress=shown.show)
    print(as_text(worked))
    return 0 if worked.is_well else 1


def as_text(worked: Soak) -> str:
    """A line for each figure, then what all of it came to."""
    rows = [
        ["time of the machine", f"{60 * worked.hours:.1f} min"],
        ["lines, rests", f"{worked.lines}, {worked.rests}"],
        ["holds, changes of the feed", f"{worked.holds}, {worked.feeds}"],
        ["farthest from where it says it is", f"{worked.astray:.3f} mm"],
        ["drift from the first quarter to the last", f"{worked.drift:+z.3f} mm"],
        ["longest silence", f"{worked.silence:.2f} s"],
        ["waits for a move in the middle of another", str(worked.late)],
    ]
    rows.append(["slips of a chain that were suspected", str(worked.suspected)])
    if worked.longest_tick:
        rows.append(["longest control tick", f"{worked.longest_tick} us"])
    if worked.most_writes:
        rows.append(
            [
                "most writes of a byte of the EEPROM",
                f"{worked.most_writes}, due {worked.due_writes}",
            ]
        )
        rows.append(["until it is worn, 300 days of 8 hours a year", f"{worked.years:.0f} years"])
    said = list(worked.complaints) or [
        "Nothing drifted, nothing was late." if worked.is_well else "missed: see the figures"
    ]
    return f"{table(['what', 'measured'], rows)}\n\n{sentences(said, mark='')}"
