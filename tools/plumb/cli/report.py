"""`plumb report`: all that the marks say, as a page to read, print and keep."""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

from pydantic import computed_field

from plumb.cli.arguments import (
    add_force,
    add_json,
    add_marks,
    add_units,
    add_without,
)
from plumb.cli.inputs import add_stated, stated_inputs
from plumb.cli.output import STDOUT, write_outputs
from plumb.cli.screen import bar, command_text, headline, print_json, same_inputs, sentences
from plumb.cure.add import Addition
from plumb.diagnosis.answer import Diagnosis
from plumb.diagnosis.expected_error import ExpectedError
from plumb.diary.file import folder_of, has_diary, read_diary
from plumb.diary.history import DiaryFit, history_of
from plumb.fit.compare import Comparison, LeftMark
from plumb.plan import Proposal
from plumb.report.findings import Command, Findings, asked_for, find
from plumb.report.page import report
from plumb.text.answers import Internal, Number, part
from plumb.text.errors import InputError

ENDINGS = (".html", ".htm")


@dataclass(frozen=True)
class MarkCovariate:
    """What errors may depend on, a number for each mark and chain."""

    name: str
    unit: str
    left: tuple[Number, ...]
    right: tuple[Number, ...]


@dataclass(frozen=True)
class ReportAnswer:
    """What the page says."""

    findings: Internal[Findings]
    written: tuple[str, ...]

    comparison = part("findings.comparison", Comparison)
    diagnosis = part("findings.diagnosis", Diagnosis)
    addition = part(
        "findings.auto.addition", Addition | None, "Null: nothing is fitted to a wrong reading."
    )
    next = part("findings.advice.proposals", tuple[Proposal, ...])
    left_by_frame = part(
        "findings.framed.marks", tuple[LeftMark, ...], "What the frame, fitted alone, leaves."
    )
    left_by_fit = part("findings.left.marks", tuple[LeftMark, ...], "What frame and effects leave.")
    expected = part(
        "findings.expected",
        ExpectedError | None,
        "How far off a job would be with the new settings; null for a slip.",
    )

    @computed_field
    @property
    def covariates(self) -> tuple[MarkCovariate, ...]:
        """What errors may depend on."""
        marks = self.findings.rows.mark_rows
        return tuple(
            MarkCovariate(each.name, each.unit, *map(tuple, each.values[marks].T.tolist()))
            for each in self.findings.by_visit
        )

    @computed_field
    @property
    def usable_share(self) -> float:
        """The share of the sheet that the machine can use."""
        return self.findings.survey.shares["usable"]


def run(arguments: argparse.Namespace) -> int:
    """Compare, diagnose, fit, propose, write the page, and return the exit code."""
    if arguments.output != STDOUT and Path(arguments.output).suffix.lower() not in ENDINGS:
        raise InputError(f"-o {arguments.output}: end the name with {', '.join(ENDINGS)}")
    inputs = stated_inputs(arguments)
    findings = find(inputs, fits=_fits(arguments.settings), progress=bar("simulating"))
    page = report(findings, commands=_asked_for(arguments, findings), again=_again(arguments))
    read = [arguments.settings, *arguments.marks, *filter(None, [arguments.cut_with])]
    write_outputs({arguments.output: page}, inputs=read)
    if arguments.json:
        print_json(ReportAnswer(findings, (arguments.output,)))
    else:
        print(headline(findings.diagnosis.sentence))
        if arguments.output != STDOUT:
            print(f"\n{sentences([f'Written: {arguments.output}'], mark='')}")
    return 0


def _fits(settings: str) -> tuple[DiaryFit, ...]:
    """Return the fits in the diary next to the settings."""
    folder = folder_of(settings)
    return history_of(read_diary(folder)).fits if folder and has_diary(folder) else ()


def _again(arguments: argparse.Namespace) -> str:
    """Return the command that makes the same report."""
    units = ["--units", arguments.units] if arguments.units else []
    words = ["plumb", "report", *same_inputs(arguments), *units, "-o", arguments.output]
    return command_text(words).strip()


def _asked_for(arguments: argparse.Namespace, findings: Findings) -> list[Command]:
    """Return what the verdict asks for."""

    def command(name: str, more: Sequence[str], words: Sequence[str]) -> str:
        return command_text(["plumb", name, *same_inputs(arguments, *more), *words]).strip()

    return asked_for(findings, command)


# The arguments of `plumb report`.

EXAMPLES = (
    "plumb report groundcontrol.ini marks.toml -o report.html",
    "plumb report groundcontrol.ini marks.toml first.toml -o report.html",
)
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb report`."""
    add_marks(parser)
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        required=True,
        help="the page: .html, a single file that needs no network",
    )
    add_without(parser)
    add_stated(parser, sigma="as plumb diagnose takes it")
    add_units(parser)
    add_force(parser)
    add_json(parser)
