"""`plumb diagnose`: which effects the settings miss, and how likely each is by the marks."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from operator import itemgetter

from plumb.cli.arguments import add_json, add_marks, add_units
from plumb.cli.inputs import add_stated, stated_inputs
from plumb.cli.screen import (
    auto_words,
    next_step,
    print_json,
    same_inputs,
    sentences,
    table,
)
from plumb.diagnosis import Diagnosis, diagnose
from plumb.diagnosis.answer import SHOWN, Together, odds_words
from plumb.model.catalogue import every_effect, label
from plumb.model.plain import named, noun_of, nouns_of, plain_size, plainly, ranked
from plumb.plan import Proposal, propose
from plumb.text.values import worded

HIDING = (
    "An effect may act although these marks do not show it. Up to: how far it may move the marks, "
    "RMS. In the frame: how much of that a fitted frame takes up, so that no mark shows it."
)
COLUMNS = (
    "Odds: against all others together. Leaves: the RMS error of the marks once it is added. "
    "Noise: what reading errors alone would leave of that."
)
MOST_REASONS = 3
BAD_NEWS = ("slip", "not_in_library")
UNKNOWN_ADVICE = (
    "is it such a machine? The library is that of a sled on a ring or linkage; on two brackets "
    "(quadrilateral) it leans and draws another pattern",
    "were these settings in force when the marks were cut? If not, name those by --cut-with, or as "
    "cut_with in the marks.toml",
    "does y run the way the file says, and are all numbers of the same kind? Measure a mark again",
    "if all that is so, look where the errors are: plumb compare ... --picture errors.png",
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
        print(f"{as_text(diagnosis)}\n\n{_next(diagnosis, arguments)}")
    return int(diagnosis.verdict in BAD_NEWS)


def _next(diagnosis: Diagnosis, arguments: argparse.Namespace) -> str:
    """Return the command that follows from the verdict."""
    if diagnosis.verdict == "slip":
        corrected = ["diagnose", *same_inputs(arguments)]
        return next_step("When the file is corrected:", corrected)
    if diagnosis.left_open.is_too_much:
        return next_step("What to measure next:", ["next", *same_inputs(arguments)])
    if diagnosis.verdict == "nothing_provable":
        return next_step("Fit the frame:", auto_words(arguments))
    first = diagnosis.explanations[0] if diagnosis.explanations else None
    if diagnosis.verdict == "one_suspect" and first and first.possible:
        return next_step("Add it:", auto_words(arguments))
    return next_step("What to measure next:", ["next", *same_inputs(arguments)])


def as_text(diagnosis: Diagnosis) -> str:
    """Return the diagnosis for people, its verdict first."""
    parts = [sentences([diagnosis.sentence], mark="")]
    if diagnosis.outliers:
        parts.append(sentences([slip.sentence for slip in diagnosis.outliers]))
    if diagnosis.disagreements:
        parts.append(sentences(diagnosis.disagreements))
    elif diagnosis.verdict == "not_in_library":
        parts.append(sentences(UNKNOWN_ADVICE))
    if diagnosis.explanations:
        if diagnosis.verdict == "not_in_library":
            parts.append(sentences(["These may act as well:"], mark=""))
        parts += [explanation_table(diagnosis), sentences([COLUMNS], mark="")]
        if diagnosis.verdict == "cannot_tell":
            parts.append(_reasons(diagnosis))
        parts.append(_remedies(diagnosis))
    parts.append(sentences([diagnosis.noise.sentence], mark=""))
    parts.append(_hiding(diagnosis))
    if diagnosis.warnings:
        parts.append(sentences(diagnosis.warnings))
    return "\n\n".join(parts)


def explanation_table(diagnosis: Diagnosis) -> str:
    """Return the accounts of the marks, the likeliest first, with the sizes of their effects."""
    rows: list[list[str]] = []
    for explanation in diagnosis.explanations[:SHOWN]:
        rows += [["or", *EMPTY]] if rows else []
        numbers = _numbers_of(explanation)
        if not explanation.effects:
            rows.append([plainly(()), *numbers])
        for name in explanation.effects:
            is_first = name == explanation.effects[0]
            rows.append(
                [f"{'' if is_first else '+ '}{named(name)}", *(numbers if is_first else EMPTY)]
            )
            rows += _size_rows(explanation, name)
    header = ["suspect, with its 95 % interval", "odds", "leaves", "noise"]
    return table(header, rows)


EMPTY = ["", "", ""]


def _numbers_of(explanation: Together) -> list[str]:
    """Return the odds, what is left of the error, and what noise alone would leave."""
    sizes = (explanation.rms_after, explanation.noise_rms)
    return [odds_words(explanation.share), *map(worded, sizes)]


def _size_rows(explanation: Together, name: str) -> list[list[str]]:
    rows = []
    for size in explanation.sizes[name]:
        said = plain_size(f"{name}.{size.name}", size.value, size.low, size.high)
        rows.append([f"  {said}", *EMPTY])
        if not size.possible:
            rows.append(["  impossible: something else looks like it", *EMPTY])
    return rows


def _reasons(diagnosis: Diagnosis) -> str:
    """Return which suspects cannot be distinguished, for their arrows hardly differ."""
    said: list[str] = []
    for (i, j), apart in ranked(diagnosis.differences.items(), itemgetter(1)):
        first, second = (diagnosis.explanations[k] for k in (i, j))
        if j >= SHOWN or len(said) == MOST_REASONS or apart > first.noise_rms:
            continue
        said.append(
            f"{plainly(first.effects)}, or {plainly(second.effects)}: their arrows on these marks "
            f"differ by only {worded(apart)} RMS"
        )
    return sentences(said)


def _remedies(diagnosis: Diagnosis) -> str:
    words = {effect["name"]: effect for effect in every_effect()}
    said = [
        f"{label(name)}: {words[name]['summary']}. To be sure: {words[name]['remedy']}"
        for name in diagnosis.suspects[:SHOWN]
    ]
    return sentences(said)


def _hiding(diagnosis: Diagnosis) -> str:
    """Return how large effects could still be that are no suspects."""
    others = [hidden for hidden in diagnosis.could_hide if hidden.effect not in diagnosis.suspects]
    hiding = ranked(others, lambda hidden: -(hidden.mm or 0.0))
    shares = {ranked.effect: ranked.hidden_share for ranked in diagnosis.ranking}
    rows = [
        [
            noun_of(hidden.effect),
            worded(hidden.mm, 1),
            percent_of(shares[hidden.effect]),
        ]
        for hidden in hiding[:SHOWN]
        if hidden.mm
    ]
    blind = [hidden.effect for hidden in others if hidden.mm is None]
    parts = []
    if rows:
        parts.append(sentences([HIDING], mark=""))
        parts.append(table(["could still hide", "up to", "in the frame"], rows))
    if blind:
        parts.append(sentences([f"these marks say nothing of {nouns_of(blind)}"]))
    return "\n".join(parts)


def percent_of(share: float | None) -> str:
    """Return a share for people; a dash where there is none."""
    return "-" if share is None else f"{100 * share:.0f} %"


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
    add_marks(parser)
    add_stated(parser, sigma="tape_sigma_mm of MARKS and their scatter")
    add_units(parser)
    add_json(parser)
