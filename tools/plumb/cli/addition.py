"""What `plumb add` says to people: few facts or all, and its verdict."""

from __future__ import annotations

from collections.abc import Sequence

from plumb.cli.screen import BAD, GOOD, OPEN, headline, sentences, table
from plumb.cure.add import Addition
from plumb.cure.auto import AutoAddition
from plumb.cure.machine_file import PATCH_WARNING, turn_sentences
from plumb.diagnosis.answer import MOST_NAMED, odds_words
from plumb.fit.covariates import PATCH
from plumb.model.plain import noun_of, plain_before, plain_size, plainly
from plumb.text.values import bare, unit, worded

NUMBERS = 7  # rows of a short answer


def verdict_of(result: Addition) -> str:
    """Return whether the effects that were named pay, in at most forty words."""
    added = [
        noun_of(step.effect) if step.effect != PATCH else "the patch" for step in result.by_effect
    ]
    if not added:
        return headline(f"Only the frame is fitted. {_fall(result)}", GOOD)
    many = " and ".join(added) if len(added) <= MOST_NAMED else f"{len(added)} effects"
    if result.pays:
        return headline(f"It pays to add {many}. {_fall(result)}", GOOD)
    if result.stops:
        return headline(f"Do not set the machine by {many}. {_fall(result)}", BAD)
    return headline(f"NOT better with {many}. {_fall(result)}", BAD)


def auto_verdict(result: AutoAddition) -> str:
    """Return what was added and how likely it is right, in at most forty words."""
    addition, diagnosis = result.addition, result.diagnosis
    if result.is_good:
        return headline(result.said[0], GOOD)
    if addition is None:
        return headline(diagnosis.sentence, BAD if diagnosis.outliers else OPEN)
    fall = _fall(addition)
    if diagnosis.is_finding and result.chosen:
        return headline(diagnosis.sentence, GOOD)
    if diagnosis.verdict == "not_in_library":
        return headline(f"No cause explains all that the marks show. {fall}", BAD)
    named = result.named if len(result.named) <= MOST_NAMED else ()
    what = plainly(named) if named or not result.named else f"{len(result.named)} causes at once"
    if result.rivals:
        share = odds_words(diagnosis.explanations[0].share)
        return headline(f"Added untested: {what}, right with odds of {share}. {fall}", OPEN)
    return headline(f"Fitted: {what}. {fall}", GOOD)


def _fall(result: Addition) -> str:
    """Return the error before and after."""
    return (
        f"The error goes from {bare(result.raw.rms)} to {worded(result.after.fit_rms)} RMS; marks "
        f"not used are {worded(result.after.left_out_rms)} off."
    )


def short_auto_text(result: AutoAddition) -> str:
    """Return the new numbers, or why there are none."""
    if result.addition:
        apart = [result.apart.sentence] if result.apart else []
        return numbers_text(result.addition, apart)
    if result.diagnosis.outliers:
        return sentences([slip.sentence for slip in result.diagnosis.outliers])
    return sentences(result.said, mark="")


def numbers_text(result: Addition, before: Sequence[str] = ()) -> str:
    """Return the new numbers in a few rows; behind what is said before, what speaks against them,
    what a hand must do before they hold, and the first thing else to know.
    """
    parts = [parameter_table(result, most=NUMBERS)]
    notes = [*before, *first_notes(result)]
    return "\n\n".join([*parts, sentences(notes)] if notes else parts)


def first_notes(result: Addition) -> list[str]:
    """Return what speaks against the numbers, what a hand must do before they hold, and the first
    thing else to know.
    """
    light = [each for each in result.warnings if each not in result.stops]
    more = [f"{len(light) - 1} more to know: see --details"] if len(light) > 1 else []
    return [*result.stops, *turn_sentences(result), *result.cures, *light[:1], *more]


def auto_text(result: AutoAddition) -> str:
    """Return the diagnosis and the choice for people, then the addition."""
    said = [sentences([result.diagnosis.sentence], mark="")]
    if result.diagnosis.outliers:
        said.append(sentences([slip.sentence for slip in result.diagnosis.outliers]))
    said += [sentences([each], mark="") for each in result.said]
    if result.settled_by:
        said.append("To be sure which it is:\n" + sentences(result.settled_by))
    if result.offer:
        added = result.addition is not None and PATCH in result.addition.effects_added
        said.append(sentences([_offer_sentence(*result.offer, added=added)], mark=""))
    if result.addition:
        said.append(as_text(result.addition))
    return "\n\n".join(said)


def _offer_sentence(without: float, with_patch: float, *, added: bool) -> str:
    """Return what a residual patch would buy, or has bought."""
    if with_patch >= without:
        return f"A residual patch would buy nothing ({worded(without)} on marks not used)."
    bought = f"{bare(without)} to {worded(with_patch)} on marks not used"
    if added:
        return f"The residual patch bought {bought}."
    return f"A residual patch (--patch) would buy {bought}. {PATCH_WARNING}"


# What the columns of the tables of errors mean, one family of words for all commands.
COLUMNS = (
    "Noise: what reading errors alone would leave of that RMS. Checked: on marks not used, each "
    "predicted by a fit without it."
)


def as_text(result: Addition, *, asked_patch: bool = False) -> str:
    """Return all of the addition for people but its verdict."""
    parts = [quality_table(result), parameter_table(result)]
    if result.benchmark_after:
        parts.insert(0, _benchmark_sentence(result))
    parts.append(sentences([f"{COLUMNS} {result.intervals_said}"], mark=""))
    said = [*result.stops, *turn_sentences(result), *result.cures]
    said += [each for each in result.warnings if each not in result.stops]
    if PATCH in result.effects_added:
        said.append(PATCH_WARNING)
    elif asked_patch:
        said.append("a residual patch would predict marks not used no better, so none was added")
    parts += [sentences(said)] if said else []
    return "\n\n".join(parts)


def _benchmark_sentence(result: Addition) -> str:
    """Return the community's score before, and what to expect of the next cut."""
    said = (
        f"Calibration Benchmark Score: {result.raw.benchmark} as cut; {result.benchmark_after} to "
        "expect when it is cut again with the new settings, if nothing else changes."
    )
    return sentences([said], mark="")


def quality_table(result: Addition) -> str:
    raw = result.raw
    start = (raw.rms, None, None, raw.worst, raw.shape_rms)
    rows = [["raw: the settings as they are", *map(bare, start)]]
    named = [("fitted: the frame", result.before)]
    named += [(f"fitted: + {noun_of(step.effect)}", step) for step in result.by_effect]
    for name, q in named:
        errors = (q.fit_rms, q.noise_rms, q.left_out_rms, q.worst, q.shape_rms)
        rows.append([name, *map(bare, errors)])
    return table([f"error in {unit()}", "RMS", "noise", "checked", "worst", "shape"], rows)


def parameter_table(result: Addition, *, most: int | None = None) -> str:
    """Return the fitted numbers, `most` of them at most."""
    shown = [each for each in result.parameters if not each.of_patch]
    rows = [
        [
            plain_size(each.name, each.value, each.low, each.high),
            plain_before(each.name, each.before, each.low, each.high),
            "" if each.possible else "impossible",
        ]
        for each in shown[:most]
    ]
    if len(rows) < len(shown):
        rows.append([f"and {len(shown) - len(rows)} more", "", ""])
    return table(["fitted, with its 95 % interval", "before", ""], rows, words=[-1])
