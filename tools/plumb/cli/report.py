"""`plumb report`: all that the marks say, as a page to read, print and keep."""

import argparse
from dataclasses import dataclass
from functools import partial
from pathlib import Path

from plumb.cli.arguments import BOARD, add_shared, add_stated, stated_inputs
from plumb.cli.output import STDOUT, write_outputs
from plumb.cli.screen import bar, headline, print_json, same_inputs, sentences
from plumb.cure.add import Addition
from plumb.cure.decision import Decision, decide
from plumb.diary.file import folder_of, has_diary, read_diary
from plumb.lab.report import report
from plumb.lab.rounds import command
from plumb.plan import propose
from plumb.text.answers import Internal, in_json, part
from plumb.text.errors import InputError
from plumb.words import proposals
from plumb.words.verdict import DiagnosisInWords, in_words, sentence

ENDINGS = (".html", ".htm")


@dataclass(frozen=True)
class ReportAnswer:
    """Contents of the report."""

    decision: Internal[Decision]
    advice: Internal[proposals.NextInWords]
    written: tuple[str, ...]

    addition = part(
        "decision.addition", Addition | None, "Null: nothing is fitted to a wrong reading."
    )
    next = part("advice.proposals", tuple[proposals.ProposalInWords, ...])

    @in_json
    def diagnosis(self) -> DiagnosisInWords:
        """Verdict on the marks."""
        return in_words(self.decision.diagnosis)


def run(arguments: argparse.Namespace) -> int:
    """Compare, diagnose, fit, propose, write the page, and return the exit code."""
    if arguments.output != STDOUT and Path(arguments.output).suffix.lower() not in ENDINGS:
        raise InputError(f"-o {arguments.output}: end the name with {', '.join(ENDINGS)}")
    inputs = stated_inputs(arguments)
    decision = decide(inputs)
    advice = proposals.in_words(propose(decision.diagnosis, inputs, progress=bar("simulating")))
    folder = folder_of(arguments.settings)
    diary = read_diary(folder) if folder and has_diary(folder) else None
    page = report(inputs, decision, advice, diary=diary, command=partial(_command, arguments))
    read = [arguments.settings, *arguments.marks, *filter(None, [arguments.cut_with])]
    write_outputs({arguments.output: page}, inputs=read)
    if arguments.json:
        print_json(ReportAnswer(decision, advice, (arguments.output,)))
    else:
        print(headline(sentence(decision.diagnosis)))
        if arguments.output != STDOUT:
            print(f"\n{sentences([f'Written: {arguments.output}'], mark='')}")
    return 0


def _command(arguments: argparse.Namespace, name: str) -> str:
    """Return another command on the same board, or that which makes the same report."""
    units = ["--units", arguments.units] if arguments.units else []
    output = ["-o", arguments.output] if name == "report" else []
    return command(name, *same_inputs(arguments), *units, *output)


# The arguments of `plumb report`.

EXAMPLES = (
    "plumb report groundcontrol.ini marks.toml -o report.html",
    "plumb report groundcontrol.ini marks.toml first.toml -o report.html",
)
EXIT = "Exit: 0 done; 2 an input cannot be used, and nothing was written."


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb report`."""
    add_shared(parser, *BOARD)
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        required=True,
        help="the page: .html, a single file that needs no network",
    )
    add_shared(parser, "--without")
    add_stated(parser, sigma="as plumb diagnose takes it")
    add_shared(parser, "--units", "--force", "--json")
