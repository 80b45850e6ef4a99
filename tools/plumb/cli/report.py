"""`plumb report`: all that the marks say, as a page to read, print and keep."""

from __future__ import annotations

import argparse
from dataclasses import replace
from pathlib import Path
from typing import Any

from plumb.cli.add import as_json as addition_json
from plumb.cli.arguments import (
    add_force,
    add_json,
    add_marks,
    add_prior,
    add_sigma,
    add_units,
    add_without,
)
from plumb.cli.checked import add_checked, with_stated
from plumb.cli.diagnose import as_json as diagnosis_json
from plumb.cli.diagnose import proposal_json
from plumb.cli.files import inputs_of
from plumb.cli.output import STDOUT, write_outputs
from plumb.cli.screen import bar, headline, print_json, sentences
from plumb.cli.steps import command_text, same_inputs
from plumb.cure.auto import without_marks
from plumb.diagnosis.answer import verdict_sentence
from plumb.diary.file import folder_of, has_diary, read_diary
from plumb.diary.history import DiaryFit, history_of
from plumb.fit.compare import ChainView
from plumb.fit.inputs import Inputs
from plumb.report.findings import Command, Findings, find
from plumb.report.page import report
from plumb.text.answers import json_of
from plumb.text.errors import InputError

ENDINGS = (".html", ".htm")


def run(arguments: argparse.Namespace) -> int:
    """Compare, diagnose, fit, propose, write the page, and return the exit code."""
    if arguments.output != STDOUT and Path(arguments.output).suffix.lower() not in ENDINGS:
        raise InputError(f"-o {arguments.output}: end the name with {', '.join(ENDINGS)}")
    inputs = _inputs(arguments)
    findings = find(inputs, fits=_fits(arguments.settings), progress=bar("simulating"))
    page = report(findings, commands=_commands(arguments, findings), again=_again(arguments))
    read = [arguments.settings, *arguments.marks, *filter(None, [arguments.cut_with])]
    write_outputs({arguments.output: page}, inputs=read)
    if arguments.json:
        print_json({**as_json(findings), "written": [arguments.output]})
    else:
        print(headline(verdict_sentence(findings.diagnosis)))
        if arguments.output != STDOUT:
            print(f"\n{sentences([f'Written: {arguments.output}'], mark='')}")
    return 0


def _fits(settings: str) -> tuple[DiaryFit, ...]:
    """Return the fits in the diary next to the settings."""
    folder = folder_of(settings)
    return history_of(read_diary(folder)).fits if folder and has_diary(folder) else ()


def _inputs(arguments: argparse.Namespace) -> Inputs:
    inputs = inputs_of(arguments)
    if arguments.without:
        marks = without_marks(inputs.measurements, arguments.without)
        inputs = replace(inputs, measurements=marks)
    return with_stated(inputs, arguments)


def _again(arguments: argparse.Namespace) -> str:
    """Return the command that makes the same report."""
    units = ["--units", arguments.units] if arguments.units else []
    words = ["plumb", "report", *same_inputs(arguments), *units, "-o", arguments.output]
    return _unindented(words)


def _commands(arguments: argparse.Namespace, findings: Findings) -> list[Command]:
    """Return what the verdict asks for."""
    same = same_inputs(arguments)
    calibrate = _unindented(["plumb", "calibrate", *same])
    verdict = findings.diagnosis.verdict
    if verdict == "slip":
        return [Command("When the file is corrected:", calibrate)]
    if verdict in ("one_suspect", "nothing_provable") and findings.auto.addition:
        return [Command("Write the new settings:", calibrate)]
    best = findings.advice.proposals[0] if findings.advice.proposals else None
    checks = best.option.checks if best else ()
    if checks:
        said = [
            word
            for check in checks
            for word in ("--checked", f"{check.name}=VALUE+-{check.sigma:g}")
        ]
        return [
            Command("When that is measured:", _unindented(["plumb", "calibrate", *same, *said]))
        ]
    more = ["plumb", "next", *same, "--marks", "more.toml"]
    again = ["plumb", "calibrate", *same_inputs(arguments, "more.toml")]
    return [
        Command("A form for the new marks:", _unindented(more)),
        Command("When they are measured:", _unindented(again)),
    ]


def _unindented(words: list[str]) -> str:
    return command_text(words).strip()


def as_json(findings: Findings) -> dict[str, Any]:
    """Return what the page says, by the names of the interface."""
    addition, expected = findings.auto.addition, findings.expected
    return {
        "comparison": json_of(findings.comparison),
        "diagnosis": diagnosis_json(findings.diagnosis),
        "addition": addition_json(addition) if addition else None,
        "next": [proposal_json(proposal) for proposal in findings.advice.proposals],
        "left_by_frame": _view_json(findings.framed),
        "left_by_fit": _view_json(findings.left),
        "covariates": [
            {
                "name": each.name,
                "unit": each.unit,
                "left": each.values[findings.rows.mark_rows, 0],
                "right": each.values[findings.rows.mark_rows, 1],
            }
            for each in findings.by_visit
        ],
        "expected": {"rms_mm": expected.rms, "worst_mm": expected.worst} if expected else None,
        "usable_share": findings.survey.shares["usable"],
    }


def _view_json(view: ChainView) -> list[dict[str, Any]]:
    """Return each mark with its error and that of its chains [mm]."""
    return [
        {"name": name, "error": error, "left_chain": chains[0], "right_chain": chains[1]}
        for name, error, chains in zip(view.names, view.errors, view.chains, strict=True)
    ]


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
    add_prior(parser)
    add_sigma(parser, usual="as plumb diagnose takes it")
    add_checked(parser)
    add_units(parser)
    add_force(parser)
    add_json(parser)
