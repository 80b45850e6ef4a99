"""`plumb calibrate`: from marks to new settings in one go, or to what has to be measured first."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace

from pydantic import computed_field

from plumb.cli import add as add_command
from plumb.cli.add import COLUMNS, parameter_table, quality_table
from plumb.cli.arguments import (
    add_force,
    add_json,
    add_marks,
    add_units,
    add_without,
)
from plumb.cli.compare import conclusion, outside_sentence
from plumb.cli.diagnose import explanation_table
from plumb.cli.inputs import add_stated, stated_inputs
from plumb.cli.next import after, first_proposal
from plumb.cli.screen import (
    auto_words,
    bar,
    free_name,
    headline,
    next_step,
    print_json,
    same_inputs,
    second_round,
    sentences,
    usual_client,
)
from plumb.cli.settings import Written, add_client, add_firmware, client_text
from plumb.cure.add import Addition
from plumb.cure.auto import AutoAddition, add_auto
from plumb.cure.live_board import refuse_other_origin
from plumb.cure.machine_file import turn_sentences
from plumb.diagnosis.answer import Diagnosis
from plumb.firmware.client_files import ClientFiles
from plumb.fit.compare import Comparison, compare
from plumb.fit.inputs import Inputs
from plumb.model.plain import plainly
from plumb.plan import Next, Proposal, propose
from plumb.text.answers import Internal, part
from plumb.text.values import bare, worded


@dataclass(frozen=True)
class Round:
    """A round of measuring: what was compared, diagnosed, added, and proposed."""

    comparison: Comparison
    result: Internal[AutoAddition]
    advice: Internal[Next | None] = None  # if something has to be measured first

    diagnosis = part("result.diagnosis", Diagnosis)
    addition = part("result.addition", Addition | None)

    @computed_field
    @property
    def next(self) -> tuple[Proposal, ...]:
        """What to measure, the best first."""
        return self.advice.proposals if self.advice else ()

    @computed_field
    @property
    def done(self) -> bool:
        """Whether new settings can be written: nothing is left that the marks could decide."""
        return self.result.addition is not None and self.result.done and not self.result.rivals

    @computed_field
    @property
    def sentence(self) -> str:
        """The end of the round in one sentence."""
        diagnosis, addition = self.result.diagnosis, self.result.addition
        if self.done and addition:
            chosen = self.result.chosen
            what = f"with {plainly(chosen)} added" if chosen else "with the frame fitted"
            return (
                f"Done: {what}, the error falls from {bare(addition.raw.rms)} to "
                f"{worded(addition.after.fit_rms)} RMS, {worded(addition.after.left_out_rms)} "
                "checked on marks not used."
            )
        if diagnosis.outliers:
            names = ", ".join(dict.fromkeys(slip.name for slip in diagnosis.outliers))
            return f"Not yet: read {names} again, and correct the file."
        best = self.best
        if best is None:
            return "Not yet: nothing that can be proposed would tell more."
        return (
            f"Not yet: first measure {best.option.title}, about {best.option.minutes:.0f} minutes; "
            "nothing was written."
        )

    @property
    def best(self) -> Proposal | None:
        """What to measure first; more marks where they are too few, or lie too close together."""
        proposals = self.next
        if self.result.diagnosis.left_open.is_too_much:
            proposals = tuple(each for each in proposals if each.option.is_cut) or proposals
        return proposals[0] if proposals else None


@dataclass(frozen=True, kw_only=True)
class CalibrateAnswer(Written, Round):
    """A round of measuring, and what was written of it."""


def run(arguments: argparse.Namespace) -> int:
    """Compare, diagnose, add or propose, write, print, and return the exit code."""
    inputs = stated_inputs(arguments)
    refuse_other_origin(inputs)
    this = round_of(inputs)
    files, client = _written(arguments, inputs, this)
    if arguments.json:
        print_json(CalibrateAnswer(**vars(this), written=tuple(files), client=client))
    else:
        print(as_text(this, arguments, files, client, inputs))
    return int(not this.done)


def round_of(inputs: Inputs) -> Round:
    """Return what the marks say, what was added by it, and what to measure first if it is open."""
    this = Round(compare(inputs), add_auto(inputs))
    if this.done:
        return this
    advice = propose(this.result.diagnosis, inputs, progress=bar("simulating"))
    return replace(this, advice=advice)


def _written(
    arguments: argparse.Namespace, inputs: Inputs, this: Round
) -> tuple[list[str], ClientFiles | None]:
    """Write the machine and what belongs to its client, if the question is settled."""
    addition = this.result.addition
    if not this.done or addition is None:
        return [], None
    client = usual_client(arguments)[1]
    asked = {
        **vars(arguments),
        "output": arguments.output or free_name("machine", ".toml"),
        # Without a client's file there is no telling what sends to the machine.
        "client": client if arguments.client or client != "none" else None,
        "picture": None,
    }
    return add_command.written(argparse.Namespace(**asked), inputs, addition)


# The arguments of `plumb calibrate`.

EXAMPLES = (
    "plumb calibrate groundcontrol.ini marks.toml",
    "plumb calibrate groundcontrol.ini marks.toml --client groundcontrol -o machine.toml",
)
EXIT = (
    "Exit: 0 done, the new settings are written; 1 a reading has to be looked at, or something "
    "measured, first, and nothing was written; 2 an input cannot be used, and nothing was written."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb calibrate`."""
    add_marks(parser)
    add_without(parser)
    parser.add_argument(
        "-o",
        "--output",
        metavar="FILE",
        help="the new machine.toml [machine.toml, or machine-2.toml and so on if that exists]",
    )
    add_client(parser)
    add_firmware(parser)
    add_stated(parser, sigma="as plumb diagnose takes it")
    add_units(parser)
    add_force(parser)
    add_json(parser)


# What `plumb calibrate` says to people: what the marks show, a sentence, and the next command.


def as_text(
    this: Round,
    arguments: argparse.Namespace,
    files: list[str],
    client: ClientFiles | None,
    inputs: Inputs,
) -> str:
    """Return the whole round for people: what is, what is missing, what was done, what
    comes next.
    """
    diagnosis, addition = this.result.diagnosis, this.result.addition
    parts = [conclusion(this.comparison, inputs.settings.sheet_width, inputs.measurements.typed)]
    outside = outside_sentence(this.comparison.promised) if this.comparison.promised else ""
    if outside:
        parts.append(sentences([f"{outside} The diagnosis asks for that again."], mark=""))
    parts.append(sentences([diagnosis.sentence], mark=""))
    if diagnosis.outliers:
        parts.append(sentences([slip.sentence for slip in diagnosis.outliers]))
    elif this.done and addition:
        parts += [sentences([each], mark="") for each in this.result.said]
        parts += [quality_table(addition), parameter_table(addition)]
        parts.append(sentences([COLUMNS], mark=""))
        said = [*turn_sentences(addition), *addition.cures, *addition.warnings]
        parts += [sentences(said)] if said else []
    elif diagnosis.explanations:
        parts.append(explanation_table(diagnosis))
        if this.result.rivals:
            # What the rivals are, and what tells them apart, is said above and below.
            parts.append(sentences(this.result.said[1:], mark=""))
    if addition is None and not diagnosis.outliers:
        parts.append(sentences(this.result.said, mark=""))
    parts.append(headline(this.sentence))
    if this.done:
        parts.append(_written_text(files, client))
        parts.append(second_round(arguments, files))
    else:
        parts += _first_measure(this, arguments)
    return "\n\n".join(parts)


def _written_text(files: list[str], client: ClientFiles | None) -> str:
    written = sentences([f"Written: {', '.join(files)}"], mark="")
    return f"{written}\n{client_text(client)}" if client else written


def _first_measure(this: Round, arguments: argparse.Namespace) -> list[str]:
    """Return what has to be done before anything is written."""
    same = same_inputs(arguments)
    if this.result.diagnosis.outliers:
        names = dict.fromkeys(slip.name for slip in this.result.diagnosis.outliers)
        without = [word for name in names for word in ("--without", name)]
        corrected = next_step("When the file is corrected:", ["calibrate", *same])
        left = next_step("If it cannot be read again:", ["calibrate", *same, *without])
        return [f"{corrected}\n{left}"]
    best = this.best
    if best is None:
        return []
    parts = [first_proposal(best), after(best, arguments)]
    if this.result.chosen:
        parts.append(next_step("Or take the most likely one untested:", auto_words(arguments)))
    return parts
