"""`plumb calibrate`: from marks to new settings in one go, or to what has to be measured first."""

import argparse
from dataclasses import dataclass, replace

from plumb.cli.add import WantedFiles, written
from plumb.cli.addition import KINDS, details_text, short_text
from plumb.cli.arguments import BOARD, add_shared
from plumb.cli.as_fitted import checked_by_fit, is_all, report
from plumb.cli.inputs import add_stated, stated_inputs
from plumb.cli.next import after, first_proposal
from plumb.cli.screen import (
    BAD,
    OPEN,
    auto_words,
    bar,
    free_name,
    headline,
    in_text,
    into_machine,
    next_step,
    print_json,
    same_inputs,
    second_round,
    sentences,
    usual_client,
)
from plumb.cli.settings import WrittenFiles, add_client, add_firmware, client_text
from plumb.cure.add import Addition
from plumb.cure.decision import Decision, decide
from plumb.cure.live_board import refuse_other_origin
from plumb.diagnosis.answer import MOST_NAMED, Diagnosis
from plumb.firmware.client_files import ClientFiles
from plumb.fit.compare import Comparison, compare
from plumb.fit.inputs import Inputs
from plumb.model.plain import plainly
from plumb.plan import Next, Proposal, propose
from plumb.text.answers import Internal, in_json, part
from plumb.words.comparison import conclusion, outside_sentence, pose_sentence
from plumb.words.proposals import to_read


@dataclass(frozen=True)
class CalibrationRound:
    """A round of measuring: what was compared, decided, and proposed."""

    comparison: Comparison
    decision: Decision
    advice: Internal[Next | None] = None  # if something has to be measured first

    diagnosis = part("decision.diagnosis", Diagnosis)
    expected_mm = part("decision.expected_mm", float | None, "RMS error over the sheet, once done.")
    addition = part("decision.addition", Addition | None)

    @in_json
    def next(self) -> tuple[Proposal, ...]:
        """Proposed measurements, the best first."""
        return self.advice.proposals if self.advice else ()

    @in_json
    def done(self) -> bool:
        """Whether nothing is left that the marks could decide: new settings can be written, or
        those that are there are good.
        """
        return self.decision.state in ("better", "good")

    @in_json
    def sentence(self) -> str:
        """The end of the round in one sentence."""
        if self.decision.state not in TO_MEASURE:
            return self.decision.headline
        best = self.best
        if best is None:
            return "Not yet: nothing that can be proposed would tell more."
        return (
            f"Not yet: first measure {best.option.title}, about {best.option.minutes:.0f} minutes; "
            "nothing was written."
        )

    @property
    def best(self) -> Proposal | None:
        """First measurement; more marks where they are too few or lie too close together."""
        proposals = self.next
        if self.decision.diagnosis.left_open.is_too_much:
            proposals = tuple(each for each in proposals if each.option.is_cut) or proposals
        return proposals[0] if proposals else None


TO_MEASURE = ("measure_first", "unknown_cause")  # decisions that ask for more


@dataclass(frozen=True, kw_only=True)
class CalibrateAnswer(WrittenFiles, CalibrationRound):
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


def round_of(inputs: Inputs) -> CalibrationRound:
    """Return what the marks say, what was added by it, and what to measure first if it is open."""
    this = CalibrationRound(compare(inputs), decide(inputs))
    if this.decision.state not in TO_MEASURE:
        return this
    advice = propose(this.decision.diagnosis, inputs, progress=bar("simulating"))
    return replace(this, advice=advice)


def _written(
    arguments: argparse.Namespace, inputs: Inputs, this: CalibrationRound
) -> tuple[list[str], ClientFiles | None]:
    """Write the machine and what belongs to its client, if the question is settled."""
    addition = this.decision.addition
    if not this.done or addition is None:
        return [], None
    _, client, *original = usual_client(arguments)
    wanted = WantedFiles.by(
        arguments,
        output=arguments.output or free_name("machine", ".toml"),
        # Without a client's file there is no telling what sends to the machine.
        client=client if arguments.client or client != "none" else None,
        original=original[-1] if original else None,
    )
    return written(wanted, inputs, addition)


# The arguments of `plumb calibrate`.

EXAMPLES = (
    "plumb calibrate groundcontrol.ini marks.toml",
    "plumb calibrate groundcontrol.ini marks.toml --client groundcontrol -o machine.toml",
)
EXIT = (
    "Exit: 0 the new settings are written, or the machine is good as it is; 1 something changed, "
    "or you should measure something first, and nothing was written; 2 an input cannot be used, "
    "and nothing was written."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb calibrate`."""
    add_shared(parser, *BOARD, "--without")
    add_shared(
        parser,
        output="the new machine.toml [machine.toml, or machine-2.toml and so on if that exists]",
    )
    add_client(parser)
    add_firmware(parser)
    add_stated(parser, sigma="as plumb diagnose takes it")
    add_shared(parser, "--units")
    add_shared(parser, details="what the marks say, and what was fitted")
    add_shared(parser, "--force", "--json")


# What `plumb calibrate` says to people: the size of the error, a verdict, and what to do.


def size_now(this: CalibrationRound) -> list[str]:
    """Return what is to be known of the new numbers; where something is to be measured first, the
    error as it is.
    """
    decision, diagnosis = this.decision, this.decision.diagnosis
    if decision.state not in TO_MEASURE or decision.addition is None:
        return short_text(decision, with_numbers=False)
    best = diagnosis.explanations[0] if diagnosis.explanations else None
    left, effects = (best.rms_after, best.effects) if best else (diagnosis.rms_before, ())
    cause = plainly(effects) if len(effects) <= MOST_NAMED else f"{len(effects)} causes at once"
    unit = decision.inputs.unit
    as_set = f"The error is {unit.worded(this.comparison.rms)} RMS as set"
    said = (
        f"{as_set}; {cause} would explain all but {unit.worded(left)}."
        if effects
        else f"{as_set}, {unit.worded(left)} with the frame fitted."
    )
    outside = outside_sentence(this.comparison.promised, unit) if this.comparison.promised else ""
    return [sentences([f"{said} {outside}".strip()], mark="")]


def details(this: CalibrationRound, inputs: Inputs) -> list[str]:
    """Return all that is known after this round."""
    comparison, unit = this.comparison, inputs.unit
    moved = pose_sentence(comparison, inputs)
    parts = [sentences([conclusion(comparison, unit)] + ([moved] if moved else []), mark="")]
    outside = outside_sentence(comparison.promised, unit) if comparison.promised else ""
    if outside:
        parts.append(sentences([f"{outside} The diagnosis asks for that again."], mark=""))
    return [*parts, *details_text(this.decision, is_taken=this.done)]


def _ending(
    this: CalibrationRound,
    arguments: argparse.Namespace,
    files: list[str],
    client: ClientFiles | None,
    inputs: Inputs,
) -> list[str]:
    """Return the verdict, and what the owner does now."""
    decision, best = this.decision, this.best
    # While something can be measured, even an unknown cause is an open question.
    verdict = headline(this.sentence, OPEN if best else KINDS.get(decision.state, BAD))
    match decision.state:
        case "good":
            return [verdict]
        case "better":
            now = [sentences([f"Written: {', '.join(files)}"], mark="")]
            now = [f"{now[0]}\n{client_text(client)}"] if client else now
            if client is None and arguments.firmware == "plumb":
                now.append(into_machine(files[0]))
            return [verdict, *now, second_round(arguments, files, inputs.unit)]
        case "read_again":
            return [verdict, _read_again(this, arguments)]
        case "impossible":
            return [verdict, next_step("What to measure:", ["next", *same_inputs(arguments)])]
    if best is None:
        return [verdict]
    if not arguments.details:
        do = list(map(best.unit.reading, best.option.do))
        (steps,) = in_text([to_read(best, do, inputs.settings)])
        return [f"{verdict}\n{steps}\n{after(best, arguments, inputs.settings)}"]
    parts = [verdict, *first_proposal(best, arguments, inputs.settings)]
    if decision.chosen:
        parts.append(next_step("Or take the most likely one untested:", auto_words(arguments)))
    return parts


def _read_again(this: CalibrationRound, arguments: argparse.Namespace) -> str:
    """Return what follows from readings that are wrong."""
    same = same_inputs(arguments)
    names = dict.fromkeys(slip.name for slip in this.decision.diagnosis.outliers)
    without = [word for name in names for word in ("--without", name)]
    corrected = next_step("When the file is corrected:", ["calibrate", *same])
    left = next_step("If it cannot be read again:", ["calibrate", *same, *without])
    return f"{corrected}\n{left}"
