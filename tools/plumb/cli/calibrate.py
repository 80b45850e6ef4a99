"""`plumb calibrate`: from marks to new settings in one go, or to what has to be measured first."""

from __future__ import annotations

import argparse
from dataclasses import dataclass, replace

from pydantic import computed_field

from plumb.cli import add as add_command
from plumb.cli.addition import COLUMNS, first_notes, parameter_table, quality_table
from plumb.cli.arguments import (
    add_details,
    add_force,
    add_json,
    add_marks,
    add_units,
    add_without,
)
from plumb.cli.as_fitted import checked_by_fit, is_all, report
from plumb.cli.compare import conclusion, outside_sentence, pose_sentence
from plumb.cli.diagnose import explanation_table
from plumb.cli.inputs import add_stated, stated_inputs
from plumb.cli.next import after, first_proposal, to_read
from plumb.cli.screen import (
    BAD,
    GOOD,
    OPEN,
    auto_words,
    bar,
    free_name,
    headline,
    into_machine,
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
from plumb.diagnosis.answer import MOST_NAMED, Diagnosis
from plumb.firmware.client_files import ClientFiles
from plumb.fit.compare import Comparison, compare
from plumb.fit.inputs import Inputs
from plumb.model.plain import plainly
from plumb.plan import Next, Proposal, propose
from plumb.text.answers import Internal, part
from plumb.text.values import bare, in_inches, worded


@dataclass(frozen=True)
class Round:
    """A round of measuring: what was compared, diagnosed, added, and proposed."""

    comparison: Comparison
    result: Internal[AutoAddition]
    advice: Internal[Next | None] = None  # if something has to be measured first

    diagnosis = part("result.diagnosis", Diagnosis)
    expected_mm = part("result.expected_mm", float | None, "RMS error over the sheet, once done.")
    addition = part("result.addition", Addition | None)

    @computed_field
    @property
    def next(self) -> tuple[Proposal, ...]:
        """What to measure, the best first."""
        return self.advice.proposals if self.advice else ()

    @computed_field
    @property
    def done(self) -> bool:
        """Whether nothing is left that the marks could decide: new settings can be written, or
        those that are there are good.
        """
        return self.result.done and not self.result.rivals

    @computed_field
    @property
    def sentence(self) -> str:
        """The end of the round in one sentence."""
        diagnosis, addition = self.result.diagnosis, self.result.addition
        if self.result.is_good:
            return self.result.said[0].replace(": nothing", ". Nothing")
        if self.done and addition:
            added, chosen = addition.effects_added, self.result.chosen
            again = f"with {plainly(chosen)} fitted again" if chosen else "with the frame fitted"
            what = f"with {plainly(added)} added" if added else again
            return (
                f"Done: {what}, the error falls from {bare(addition.raw.rms)} to "
                f"{worded(addition.after.fit_rms)} RMS, {worded(addition.after.left_out_rms)} "
                f"checked on marks not used.{_unexplained(diagnosis)}"
            )
        if diagnosis.outliers:
            names = ", ".join(dict.fromkeys(slip.called for slip in diagnosis.outliers))
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


def _unexplained(diagnosis: Diagnosis) -> str:
    """Return what stays where a cause is named though the machine does something unknown too."""
    if not diagnosis.is_finding:
        return ""
    return f" A pattern of {worded(diagnosis.pattern_mm)} stays that no effect draws."


@dataclass(frozen=True, kw_only=True)
class CalibrateAnswer(Written, Round):
    """A round of measuring, and what was written of it."""


def run(arguments: argparse.Namespace) -> int:
    """Compare, diagnose, add or propose, write, print, and return the exit code."""
    inputs = stated_inputs(arguments)
    refuse_other_origin(inputs)
    checked = checked_by_fit(inputs, arguments.settings)
    if checked and is_all(checked):
        return report(arguments, checked)
    this = round_of(inputs)
    files, client = _written(arguments, inputs, this)
    if arguments.json:
        print_json(CalibrateAnswer(**vars(this), written=tuple(files), client=client))
    else:
        facts = details(this, inputs) if arguments.details else size_now(this)
        ending = _ending(this, arguments, files, client, inputs)
        print("\n\n".join([*facts, *ending]))
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
    _, client, *original = usual_client(arguments)
    asked = {
        **vars(arguments),
        "output": arguments.output or free_name("machine", ".toml"),
        # Without a client's file there is no telling what sends to the machine.
        "client": client if arguments.client or client != "none" else None,
        "original": original[-1] if original else None,
        "picture": None,
    }
    return add_command.written(argparse.Namespace(**asked), inputs, addition)


# The arguments of `plumb calibrate`.

EXAMPLES = (
    "plumb calibrate groundcontrol.ini marks.toml",
    "plumb calibrate groundcontrol.ini marks.toml --client groundcontrol -o machine.toml",
)
EXIT = (
    "Exit: 0 done, the new settings are written, or the machine is as it was fitted; 1 something "
    "changed, or a reading has to be looked at, or something measured, first, and nothing was "
    "written; 2 an input cannot be used, and nothing was written."
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
    add_details(parser, "what the marks say, and what was fitted")
    add_force(parser)
    add_json(parser)


# What `plumb calibrate` says to people: the size of the error, a verdict, and what to do.


def size_now(this: Round) -> list[str]:
    """Return the error before and after, unless the verdict says it; slips in whole sentences."""
    diagnosis = this.result.diagnosis
    if diagnosis.outliers:
        return [sentences([slip.sentence for slip in diagnosis.outliers][:SLIPS])]
    if this.done and this.result.addition:
        notes = first_notes(this.result.addition)
        return [sentences([*notes, _expected(this)])]
    if this.result.is_good:
        return [sentences([_expected(this)], mark="")]
    if this.result.addition is None:
        return [sentences(this.result.said[:1], mark="")]
    best = diagnosis.explanations[0] if diagnosis.explanations else None
    left, effects = (best.rms_after, best.effects) if best else (diagnosis.rms_before, ())
    cause = plainly(effects) if len(effects) <= MOST_NAMED else f"{len(effects)} causes at once"
    said = (
        f"The error is {worded(this.comparison.rms)} RMS as set; {cause} would explain all but "
        f"{worded(left)}."
        if effects
        else f"The error is {worded(this.comparison.rms)} RMS as set, {worded(left)} with the "
        "frame fitted."
    )
    outside = outside_sentence(this.comparison.promised) if this.comparison.promised else ""
    return [sentences([f"{said} {outside}".strip()], mark="")]


def _expected(this: Round) -> str:
    return f"Over the sheet expect errors of {worded(this.expected_mm or 0.0)} RMS."


SLIPS = 2  # sentences of a short answer


def details(this: Round, inputs: Inputs) -> list[str]:
    """Return all that is known after this round."""
    diagnosis, addition = this.result.diagnosis, this.result.addition
    sheet_width, typed = inputs.settings.sheet_width, inputs.measurements.typed
    moved = pose_sentence(this.comparison, sheet_width, typed)
    parts = [sentences([conclusion(this.comparison)] + ([moved] if moved else []), mark="")]
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
    return parts


def _ending(
    this: Round,
    arguments: argparse.Namespace,
    files: list[str],
    client: ClientFiles | None,
    inputs: Inputs,
) -> list[str]:
    """Return the verdict, and what the owner does now."""
    slips, best = this.result.diagnosis.outliers, this.best
    verdict = headline(this.sentence, GOOD if this.done else BAD if slips else OPEN)
    if this.result.is_good:
        return [verdict]
    if this.done:
        now = [_written_text(files, client)]
        if client is None and arguments.firmware == "plumb":
            now.append(into_machine(files[0]))
        return [verdict, *now, second_round(arguments, files)]
    if slips:
        return [verdict, _read_again(this, arguments)]
    if best is None:
        return [verdict]
    if not arguments.details:
        steps = to_read(best, list(map(in_inches, best.option.do)), inputs.settings)
        return [f"{verdict}\n{steps}\n{after(best, arguments, inputs.settings)}"]
    parts = [verdict, *first_proposal(best, arguments, inputs.settings)]
    if this.result.chosen:
        parts.append(next_step("Or take the most likely one untested:", auto_words(arguments)))
    return parts


def _written_text(files: list[str], client: ClientFiles | None) -> str:
    written = sentences([f"Written: {', '.join(files)}"], mark="")
    return f"{written}\n{client_text(client)}" if client else written


def _read_again(this: Round, arguments: argparse.Namespace) -> str:
    """Return what follows from readings that are wrong."""
    same = same_inputs(arguments)
    names = dict.fromkeys(slip.name for slip in this.result.diagnosis.outliers)
    without = [word for name in names for word in ("--without", name)]
    corrected = next_step("When the file is corrected:", ["calibrate", *same])
    left = next_step("If it cannot be read again:", ["calibrate", *same, *without])
    return f"{corrected}\n{left}"
