"""`plumb faults`: what a machine does when something goes wrong."""

from __future__ import annotations

import argparse

from plumb.cli.output import refuse_early, write_outputs
from plumb.cli.screen import Bar, sentences, table
from plumb.text.errors import InputError
from plumb.trials.report import (
    HEADER,
    UNSEEN_HEADER,
    FaultReport,
    faults_named,
    page,
    tried_all,
)


def run(arguments: argparse.Namespace) -> int:
    """Try the faults, print the table, and return the exit code."""
    try:
        faults = faults_named(arguments.only)
    except ValueError as error:
        raise InputError(f"--only: {error}") from None
    refuse_early(arguments.write)
    shown = Bar("faults", patience=0.0)
    report = tried_all(
        faults, tries=arguments.tries, seed=arguments.seed, elf=arguments.mega, progress=shown.show
    )
    if arguments.write:
        write_outputs({arguments.write: page(report).encode()}, inputs=[])
    print(as_text(report))
    return 0 if report.is_well else 1


def as_text(report: FaultReport) -> str:
    """The tables for people, then what all of it came to."""
    parts = []
    if report.rows:
        tried = sentences([report.last_line()], mark="")
        parts.append(f"{table(HEADER, [row.cells() for row in report.rows])}\n\n{tried}")
    if report.unseen:
        cells = [row.unseen_cells() for row in report.unseen]
        parts.append(f"What no encoder sees:\n{table(UNSEEN_HEADER, cells, words=[-1])}")
    return "\n\n".join(parts)
