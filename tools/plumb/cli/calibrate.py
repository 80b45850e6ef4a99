"""`plumb calibrate`: from marks to new settings in one go, or to what has to be measured first."""

import argparse
from dataclasses import dataclass, replace
from pathlib import Path

from plumb.cli.add import after_writing, written
from plumb.cli.arguments import BOARD, add_shared, add_stated, stated_inputs
from plumb.cli.next import after, first_proposal
from plumb.cli.output import say_failure
from plumb.cli.screen import (
    auto_words,
    bar,
    free_name,
    headline,
    in_text,
    next_step,
    print_json,
    same_inputs,
    usual_client,
    what_follows,
)
from plumb.cli.settings import WrittenFiles, add_client, add_firmware
from plumb.cure.add import Addition, refuse_other_origin
from plumb.cure.decision import decide
from plumb.diagnosis.explanation import FEWEST_NUMBERS
from plumb.diary.file import RECHECK, folder_of, keep, read_diary
from plumb.diary.recheck import MeasuredMark, Recheck, are_apart, fit_of, recheck
from plumb.fit.compare import Comparison, compare
from plumb.fit.inputs import Inputs
from plumb.plan import propose
from plumb.text.answers import Internal, in_json, part
from plumb.words import decision as words
from plumb.words.proposals import NextInWords, ProposalInWords, in_words, to_read
from plumb.words.recheck import RecheckAnswer
from plumb.words.recheck import in_words as checked_in_words
from plumb.words.states import KINDS, STATES
from plumb.words.verdict import DiagnosisInWords
from plumb.words.verdict import in_words as diagnosis_in_words


@dataclass(frozen=True, kw_only=True)
class CalibrateAnswer(WrittenFiles):
    """A round of measuring: what was compared, decided, written, or proposed."""

    comparison: Comparison
    decision: words.DecisionInWords
    advice: Internal[NextInWords | None]  # if something has to be measured first

    expected_mm = part("decision.expected_mm", float | None, "RMS error over the sheet, once done.")
    addition = part("decision.addition", Addition | None)
    # Whether new settings can be written, or those that are there are good.
    done = part("decision.is_settled", bool, "Whether nothing is left that the marks could decide.")

    @in_json
    def diagnosis(self) -> DiagnosisInWords:
        """Verdict on the marks."""
        return diagnosis_in_words(self.decision.diagnosis)

    @in_json
    def next(self) -> tuple[ProposalInWords, ...]:
        """Proposed measurements, the best first."""
        return self.advice.proposals if self.advice else ()

    @in_json
    def sentence(self) -> str:
        """The end of the round in one sentence."""
        return words.round_sentence(self.decision, self.best)

    @property
    def best(self) -> ProposalInWords | None:
        """First measurement; more marks where they are too few or lie too close together."""
        proposals = self.next
        if self.decision.diagnosis.left_open.is_too_much:
            proposals = tuple(each for each in proposals if each.option.is_cut) or proposals
        return proposals[0] if proposals else None


def run(arguments: argparse.Namespace) -> int:
    """Compare, diagnose, add or propose, write, print, and return the exit code."""
    inputs = stated_inputs(arguments)
    refuse_other_origin(inputs)
    checked = checked_by_fit(inputs, arguments.settings)
    if checked and is_all(checked):
        return report(arguments, checked)
    comparison, decision, advice = compare(inputs), decide(inputs), None
    if decision.asks_for_more:
        advice = in_words(propose(decision.diagnosis, inputs, progress=bar("simulating")))
    files = WrittenFiles()
    if decision.is_settled and decision.addition:
        files = _written(arguments, inputs, decision.addition)
    answer = CalibrateAnswer(
        comparison=comparison, decision=words.in_words(decision), advice=advice, **vars(files)
    )
    if arguments.json:
        print_json(answer)
    else:
        say = words.round_in_full if arguments.details else words.round_in_short
        ending = _ending(answer, arguments, inputs)
        print("\n\n".join([*in_text(say(decision, comparison)), *ending]))
    return int(not answer.done)


def _written(arguments: argparse.Namespace, inputs: Inputs, addition: Addition) -> WrittenFiles:
    """Write the machine and what belongs to its client."""
    _, client, *original = usual_client(arguments)
    return written(
        arguments,
        inputs,
        addition,
        output=arguments.output or free_name("machine", ".toml"),
        # Without a client's file there is no telling what sends to the machine.
        client=client if arguments.client or client != "none" else None,
        original=original[-1] if original else None,
    )


def _ending(answer: CalibrateAnswer, arguments: argparse.Namespace, inputs: Inputs) -> list[str]:
    """Return the verdict, and what the owner does now."""
    decision, best = answer.decision, answer.best
    follows = STATES[decision.state]
    # While something can be measured, even an unknown cause is an open question.
    verdict = headline(answer.sentence, "open" if best else follows.kind)
    match decision.state:
        case "better":
            return [verdict, *after_writing(arguments, answer, inputs.unit)]
        case "good" | "impossible":
            return [verdict, what_follows(follows, arguments, ["calibrate"])]
        case "read_again":
            without = [
                word for name in dict.fromkeys(decision.slips) for word in ("--without", name)
            ]
            again = what_follows(follows, arguments, ["calibrate"])
            left = ["calibrate", *same_inputs(arguments), *without]
            return [verdict, f"{again}\n{next_step('If it cannot be read again:', left)}"]
    if best is None:
        return [verdict]
    if not arguments.details:
        steps = to_read(best, list(map(best.unit.reading, best.option.do)), inputs.settings)
        (said,) = in_text([steps])
        return [f"{verdict}\n{said}\n{after(best, arguments, inputs.settings)}"]
    parts = [verdict, *first_proposal(best, arguments, inputs.settings)]
    if decision.chosen:
        parts.append(next_step("Or take the most likely one untested:", auto_words(arguments)))
    return parts


# A check that marks cut with fitted settings lie where the fit promised, or what changed.


def checked_by_fit(inputs: Inputs, path: str) -> RecheckAnswer | None:
    """Hold marks that were cut with fitted settings against the fit in the diary next to them.

    None where there is no such question: other settings cut a mark, the fit has seen it, its diary
    is not here, or the marks are no two places.
    """
    settings, measured = inputs.settings, inputs.measurements
    record, folder = settings.fitted, folder_of(path)
    if record is None or folder is None or measured.distances:
        return None
    for each in measured.rounds:
        in_force = each.cut_with or inputs.cut_with or settings
        if record.board(each.digest) or replace(in_force, fitted=None) != replace(
            settings, fitted=None
        ):
            return None
    if any(mark.chains or mark.sled_weight for mark in measured.marks):
        return None
    marks = [MeasuredMark(mark.name, where, mark.target) for mark, where in measured.readings]
    fit = fit_of(read_diary(folder), settings)
    if fit is None or not are_apart(marks):
        return None
    sigma = inputs.sigma or measured.tape_sigma
    return checked_in_words(recheck(fit, settings, marks, sigma=sigma, unit=inputs.unit))


def is_all(checked: Recheck) -> bool:
    """Return whether this is all that can be said: the machine holds, or a fit needs more marks."""
    return checked.holds or 2 * len({mark.name for mark in checked.marks}) < FEWEST_NUMBERS


def report(arguments: argparse.Namespace, checked: RecheckAnswer) -> int:
    """Keep the answer in the diary, print it, and return the exit code."""
    names = (Path(path).name for path in (*arguments.marks, arguments.settings))
    *forms, machine = names
    entry = checked.entry(" and ".join(forms), machine)
    say_failure(keep(arguments.settings, RECHECK, entry, begin=False))
    if arguments.json:
        print_json(checked)
    else:
        verdict = headline(checked.headline, KINDS[checked.state])
        print("\n\n".join([verdict, *in_text(checked.tables)]))
    return int(KINDS[checked.state] == "bad")


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
