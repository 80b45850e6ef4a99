"""`plumb diagnose`: which effects the settings miss, and how likely each is by the marks."""

import argparse
from dataclasses import dataclass
from operator import itemgetter

from plumb.cli.arguments import BOARD, add_shared
from plumb.cli.inputs import add_stated, stated_inputs
from plumb.cli.screen import (
    BAD,
    GOOD,
    OPEN,
    auto_words,
    headline,
    next_step,
    print_json,
    same_inputs,
    sentences,
    table,
)
from plumb.diagnosis import Diagnosis, diagnose
from plumb.diagnosis.answer import ADD, SHOWN, STEPS, Together, odds_words
from plumb.diagnosis.unseen import unseen_by
from plumb.model.catalogue import every_effect
from plumb.model.plain import noun_of, ranked
from plumb.plan import Proposal, propose
from plumb.text.values import Unit

COLUMNS = (
    "Odds: that this is right, against all else. Leaves: the RMS error once it is added. Noise: "
    "what reading errors alone would leave."
)
# Of states; else it is bad news.
KINDS = {
    **dict.fromkeys(("good", "frame_only", "one_cause"), GOOD),
    **dict.fromkeys(("measure_first", "several_causes", "impossible", "cannot_tell"), OPEN),
}
MOST_REASONS = 3
BAD_NEWS = ("slip", "not_in_library")
UNKNOWN_ADVICE = (
    "Does the sled hang on a ring or linkage? On two brackets it leans and errs in another way.",
    "Were the marks cut with these settings? If not, name the others with --cut-with.",
    "Does y run the way the file says? Measure a mark again.",
)


@dataclass(frozen=True, kw_only=True)
class DiagnosisAnswer(Diagnosis):
    """The diagnosis, and what to measure next."""

    next: tuple[Proposal, ...]


def run(arguments: argparse.Namespace) -> int:
    """Diagnose, print, and return the exit code."""
    inputs = stated_inputs(arguments)
    diagnosis = diagnose(inputs)
    if arguments.json:
        proposals = propose(diagnosis, inputs).proposals
        print_json(DiagnosisAnswer(**vars(diagnosis), next=proposals))
    else:
        facts = details(diagnosis) if arguments.details else likeliest(diagnosis)
        verdict = headline(diagnosis.sentence, KINDS.get(diagnosis.state, BAD))
        print("\n\n".join([*facts, verdict, _next(diagnosis, arguments)]))
    return int(diagnosis.verdict in BAD_NEWS)


def _next(diagnosis: Diagnosis, arguments: argparse.Namespace) -> str:
    """Return what follows, with its command."""
    said, command = STEPS[diagnosis.state]
    if diagnosis.state == "good":
        return sentences([said], mark="")
    if command == ADD:
        return next_step(said, auto_words(arguments))
    return next_step(said, [*(command or ["diagnose"]), *same_inputs(arguments)])


FEW, SIZES, NOTES = 3, 4, 2  # accounts, sizes and sentences of a short answer
HEADER = ["cause", "odds", "leaves", "noise"]


def likeliest(diagnosis: Diagnosis) -> list[str]:
    """Return the likeliest accounts in a few rows, the sizes of the first, and what is odd."""
    if diagnosis.is_finding:
        notes = diagnosis.warnings[:NOTES]
        return [falls_table(diagnosis), *([sentences(notes)] if notes else [])]
    parts = []
    if diagnosis.explanations:
        first, *_ = shown = diagnosis.explanations[:FEW]
        rows = [[diagnosis.called(each), *_numbers_of(each, diagnosis.unit)] for each in shown]
        sizes = [size.said for size in first.parameters]
        parts.append(table(HEADER, rows))
        parts += [sentences(sizes, mark="  ")] if 0 < len(sizes) <= SIZES else []
    odd = [slip.sentence for slip in diagnosis.outliers] or list(diagnosis.disagreements)
    if not odd and diagnosis.verdict == "not_in_library":
        odd = list(UNKNOWN_ADVICE)
    else:
        odd = [*odd, *diagnosis.warnings][:NOTES]
    return [*parts, sentences(odd)] if odd else parts


def falls_table(diagnosis: Diagnosis) -> str:
    """Return how the error falls, effect by effect."""
    unit = diagnosis.unit
    rows = [["the frame alone", unit.worded(diagnosis.rms_before)]]
    rows += [[f"+ {noun_of(each.effect)}", unit.worded(each.rms)] for each in diagnosis.falls]
    return table(["wrong at once", "leaves"], rows)


def details(diagnosis: Diagnosis) -> list[str]:
    """Return all that the marks say."""
    parts = [falls_table(diagnosis)] if diagnosis.is_finding else []
    if diagnosis.outliers:
        parts.append(sentences([slip.sentence for slip in diagnosis.outliers]))
    if diagnosis.disagreements:
        parts.append(sentences(diagnosis.disagreements))
    elif diagnosis.verdict == "not_in_library":
        parts.append(sentences(UNKNOWN_ADVICE))
    if diagnosis.explanations:
        parts += [explanation_table(diagnosis), sentences([COLUMNS], mark="")]
        if diagnosis.verdict == "cannot_tell":
            parts.append(_reasons(diagnosis))
        parts.append(_remedies(diagnosis))
    parts.append(sentences([diagnosis.noise.said(diagnosis.unit)], mark=""))
    parts.append(_unseen(diagnosis))
    if diagnosis.warnings:
        parts.append(sentences(diagnosis.warnings))
    return [part for part in parts if part]


def explanation_table(diagnosis: Diagnosis) -> str:
    """Return the accounts of the marks, the likeliest first, with the sizes of their effects."""
    rows: list[list[str]] = []
    for number, explanation in enumerate(diagnosis.explanations[:SHOWN], 1):
        numbers = _numbers_of(explanation, diagnosis.unit)
        if diagnosis.is_finding:
            numbers[0] = "-"  # they are named by what they predict, not by odds
        rows.append([f"{number}. {diagnosis.called(explanation)}", *numbers])
        for name in explanation.effects:
            rows += _size_rows(explanation, name)
    return table(["cause, with its 95 % interval", *HEADER[1:]], rows)


EMPTY = ["", "", ""]


def _numbers_of(explanation: Together, unit: Unit) -> list[str]:
    """Return the odds, what is left of the error, and what noise alone would leave."""
    sizes = (explanation.rms_after, explanation.noise_rms)
    return [odds_words(explanation.share), *map(unit.worded, sizes)]


def _size_rows(explanation: Together, name: str) -> list[list[str]]:
    rows = []
    for size in explanation.sizes[name]:
        rows.append([f"  {size.said}", *EMPTY])
        if not size.possible:
            rows.append(["  impossible: something else looks like it", *EMPTY])
    return rows


def _reasons(diagnosis: Diagnosis) -> str:
    """Return which accounts hardly differ in their arrows."""
    said: list[str] = []
    for (i, j), apart in ranked(diagnosis.differences.items(), itemgetter(1)):
        if j >= SHOWN or len(said) == MOST_REASONS:
            continue
        if apart > diagnosis.explanations[i].noise_rms:
            continue
        how_near = diagnosis.unit.worded(apart)
        said.append(
            f"{i + 1} and {j + 1} look alike: they move these marks alike to {how_near} RMS"
        )
    return sentences(said)


def _remedies(diagnosis: Diagnosis) -> str:
    words = {effect["name"]: effect for effect in every_effect()}
    said = [
        f"{noun_of(name)}: {words[name]['summary']}. To be sure: {words[name]['remedy']}"
        for name in diagnosis.suspects[:SHOWN]
    ]
    return sentences(said)


def _unseen(diagnosis: Diagnosis) -> str:
    """Return how large effects could still be that are no suspects."""
    unseen = unseen_by(diagnosis, SHOWN)
    rows = [
        [cause.noun, diagnosis.unit.worded(cause.mm, 1), cause.taken_up] for cause in unseen.causes
    ]
    parts = [sentences([unseen.words], mark=""), table(unseen.header, rows)] if rows else []
    return "\n".join([*parts, *([sentences([unseen.silent])] if unseen.silent else [])])


# The arguments of `plumb diagnose`.

EXAMPLES = (
    "plumb diagnose groundcontrol.ini marks.toml",
    "plumb diagnose groundcontrol.ini marks.toml --checked sled_weight=98+-2",
)
EXIT = (
    "Exit: 0 done; 1 done, but a mark should be measured again or no effect of the library "
    "explains the marks; 2 an input cannot be used."
)


def add_arguments(parser: argparse.ArgumentParser) -> None:
    """Add the arguments of `plumb diagnose`."""
    add_shared(parser, *BOARD)
    add_stated(parser, sigma="tape_sigma_mm of MARKS and their scatter")
    add_shared(parser, "--units")
    add_shared(
        parser, details="all explanations with their sizes, and what these marks cannot show"
    )
    add_shared(parser, "--json")
