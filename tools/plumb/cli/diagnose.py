"""`plumb diagnose`: which effect the settings miss, as far as the marks can prove it."""

from __future__ import annotations

import argparse
from dataclasses import dataclass
from operator import itemgetter

from plumb.cli.arguments import add_json, add_marks, add_units
from plumb.cli.inputs import add_stated, stated_inputs
from plumb.cli.screen import (
    add_named,
    auto_words,
    next_step,
    print_json,
    same_inputs,
    sentences,
    table,
)
from plumb.diagnosis import Diagnosis, diagnose
from plumb.diagnosis.answer import SHOWN, Together
from plumb.model.catalogue import every_effect, label
from plumb.model.plain import named, noun_of, nouns_of, plain_size, plainly, ranked
from plumb.plan import Proposal, propose
from plumb.text.values import worded

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
        return next_step("Add it:", add_named(arguments, first.effects))
    return next_step("What to measure next:", ["next", *same_inputs(arguments)])


def as_text(diagnosis: Diagnosis) -> str:
    """Return the diagnosis for people, its verdict first."""
    parts = [sentences([diagnosis.sentence], mark="")]
    if diagnosis.outliers:
        parts.append(sentences([slip.sentence for slip in diagnosis.outliers]))
    if diagnosis.disagreements:
        parts.append(sentences(diagnosis.disagreements))
    elif diagnosis.verdict == "not_in_library":
        parts.append(sentences(_unknown_advice(diagnosis)))
    if diagnosis.explanations:
        parts.append(explanation_table(diagnosis))
        if diagnosis.verdict == "cannot_tell":
            parts.append(_reasons(diagnosis))
        parts.append(_remedies(diagnosis))
    parts.append(sentences([diagnosis.noise.sentence], mark=""))
    parts.append(_hiding(diagnosis))
    if diagnosis.warnings:
        parts.append(sentences(diagnosis.warnings))
    return "\n\n".join(parts)


def _unknown_advice(diagnosis: Diagnosis) -> list[str]:
    """Return what to look at when nothing in the library fits."""
    if diagnosis.noise.source != "default":
        return list(UNKNOWN_ADVICE)
    doubt = (
        f"are the readings good to {worded(diagnosis.noise.sigma, 1)}? Nothing says so; holes that "
        "wander and a coarse tape look just like this. Read some marks again, or state what you "
        "trust them to by --sigma"
    )
    return [doubt, *UNKNOWN_ADVICE]


def explanation_table(diagnosis: Diagnosis) -> str:
    rows: list[list[str]] = []
    for explanation in diagnosis.explanations[:SHOWN]:
        rows += [["or", "", ""]] if rows else []
        if not explanation.effects:
            rows.append([plainly(()), worded(explanation.rms_after), ""])
        for name in explanation.effects:
            rows += _size_rows(explanation, name)
    return table(["suspect, with its 95 % interval", "error falls to", ""], rows, words=[-1])


def _size_rows(explanation: Together, name: str) -> list[list[str]]:
    first = name == explanation.effects[0]
    falls_to = worded(explanation.rms_after) if first else ""
    rows = [[f"{'' if first else '+ '}{named(name)}", falls_to, ""]]
    for size in explanation.sizes[name]:
        said = plain_size(f"{name}.{size.name}", size.value, size.low, size.high)
        impossible = "" if size.plausible else "impossible: something else looks like it"
        rows.append([f"  {said}", "", impossible])
    return rows


def _reasons(diagnosis: Diagnosis) -> str:
    """Why suspects cannot be distinguished: how little their arrows differ."""
    said: list[str] = []
    for (i, j), apart in ranked(diagnosis.differences.items(), itemgetter(1)):
        if j >= SHOWN or len(said) == 3:
            continue
        nouns = [nouns_of(diagnosis.explanations[k].effects) for k in (i, j)]
        said.append(
            f"{nouns[0]} and {nouns[1]} draw nearly the same arrows on these marks: they differ by "
            f"{worded(apart)} RMS, the noise is {worded(diagnosis.noise.sigma)}"
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
    """Return how large effects that are not proved could still be."""
    unproved = [
        hidden for hidden in diagnosis.could_hide if hidden.effect not in diagnosis.suspects
    ]
    hiding = ranked(unproved, lambda hidden: -(hidden.mm or 0.0))
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
    blind = [hidden.effect for hidden in unproved if hidden.mm is None]
    parts = []
    if rows:
        header = ["could still hide", "up to", "in the frame"]
        parts.append(table(header, rows))
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
    add_stated(parser, sigma="tape_sigma_mm of MARKS and repeats, else 0.5")
    add_units(parser)
    add_json(parser)
