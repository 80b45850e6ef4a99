"""The decision for people: few facts or all, and the headline in its colour."""

from collections.abc import Sequence

from plumb.cli.diagnose import explanation_table
from plumb.cli.screen import BAD, GOOD, OPEN, headline, sentences, table
from plumb.cure.add import Addition, Note
from plumb.cure.decision import Decision, fall_sentence
from plumb.cure.machine_file import PATCH_WARNING
from plumb.diagnosis.answer import MOST_NAMED
from plumb.fit.covariates import PATCH
from plumb.model.plain import noun_of, plain_before, plain_size
from plumb.text.values import Unit

KINDS = {"good": GOOD, "better": GOOD, "measure_first": OPEN}  # of decisions; else it is bad news
NUMBERS = 7  # rows of a short answer
SLIPS = 2  # sentences of a short answer


def verdict_of(result: Addition) -> str:
    """Return whether the effects that were named pay, in at most forty words."""
    added = [
        noun_of(step.effect) if step.effect != PATCH else "the patch" for step in result.by_effect
    ]
    fall = fall_sentence(result)
    if not added:
        return headline(f"Only the frame is fitted. {fall}", GOOD)
    many = " and ".join(added) if len(added) <= MOST_NAMED else f"{len(added)} effects"
    if result.pays:
        return headline(f"It pays to add {many}. {fall}", GOOD)
    if result.stops:
        return headline(f"Do not set the machine by {many}. {fall}", BAD)
    return headline(f"NOT better with {many}. {fall}", BAD)


def decision_verdict(decision: Decision) -> str:
    """Return the decision in its colour."""
    return headline(decision.headline, KINDS.get(decision.state, BAD))


def short_text(decision: Decision, *, with_numbers: bool) -> list[str]:
    """Return the new numbers, if wanted, and what is to be known of them; or why there are none."""
    if decision.state == "read_again":
        return [sentences([note.text for note in decision.notes][:SLIPS])]
    if decision.addition and with_numbers:
        return [numbers_text(decision.addition, decision.notes)]
    if decision.notes:
        return [sentences(first_of(decision.notes))]
    return [sentences(decision.said[:1], mark="")]


def numbers_text(result: Addition, notes: Sequence[Note]) -> str:
    """Return the new numbers in a few rows, and what is to be known of them first."""
    parts = [parameter_table(result, most=NUMBERS)]
    return "\n\n".join([*parts, sentences(first_of(notes))] if notes else parts)


def first_of(notes: Sequence[Note]) -> list[str]:
    """Return the warnings; hints by their number."""
    hints = sum(note.weight == "hint" for note in notes)
    more = [f"{hints} more to know: see --details"] if hints else []
    return [*(note.text for note in notes if note.weight != "hint"), *more]


def details_text(decision: Decision, *, is_taken: bool) -> list[str]:
    """Return the diagnosis and the choice, then the new numbers, or what they would follow from if
    they are not taken.
    """
    diagnosis, addition = decision.diagnosis, decision.addition
    said = [sentences([diagnosis.sentence], mark="")]
    if diagnosis.outliers:
        return [*said, sentences([slip.sentence for slip in diagnosis.outliers])]
    said += [sentences([each], mark="") for each in decision.said]
    if decision.settled_by:
        said.append("To be sure which it is:\n" + sentences(decision.settled_by))
    if decision.offer:
        added = addition is not None and PATCH in addition.effects_added
        said.append(
            sentences(
                [_offer_sentence(*decision.offer, decision.inputs.unit, added=added)], mark=""
            )
        )
    if addition and is_taken:
        said += addition_text(addition, decision.notes)
    elif diagnosis.explanations:
        said.append(explanation_table(diagnosis))
    return said


def _offer_sentence(without: float, with_patch: float, unit: Unit, *, added: bool) -> str:
    """Return what a residual patch would buy, or has bought."""
    if with_patch >= without:
        return f"A residual patch would buy nothing ({unit.worded(without)} on marks not used)."
    bought = f"{unit.bare(without)} to {unit.worded(with_patch)} on marks not used"
    if added:
        return f"The residual patch bought {bought}."
    return f"A residual patch (--patch) would buy {bought}. {PATCH_WARNING}"


# What the columns of the tables of errors mean, one family of words for all commands.
COLUMNS = (
    "Noise: what reading errors alone would leave of that RMS. Checked: on marks not used, each "
    "predicted by a fit without it."
)


def addition_text(
    result: Addition, notes: Sequence[Note], *, asked_patch: bool = False
) -> list[str]:
    """Return all of the addition but its verdict."""
    parts = [quality_table(result), parameter_table(result)]
    parts.append(sentences([f"{COLUMNS} {result.intervals_said}"], mark=""))
    said = [note.text for note in notes]
    if PATCH in result.effects_added:
        said.append(PATCH_WARNING)
    elif asked_patch:
        said.append("a residual patch would predict marks not used no better, so none was added")
    return [*parts, sentences(said)] if said else parts


def quality_table(result: Addition) -> str:
    raw, unit = result.raw, result.unit
    start = (raw.rms, None, None, raw.worst, raw.shape_rms)
    rows = [["raw: the settings as they are", *map(unit.bare, start)]]
    named = [("fitted: the frame", result.before)]
    named += [(f"fitted: + {noun_of(step.effect)}", step) for step in result.by_effect]
    for name, q in named:
        errors = (q.fit_rms, q.noise_rms, q.left_out_rms, q.worst, q.shape_rms)
        rows.append([name, *map(unit.bare, errors)])
    return table([f"error in {unit.name}", "RMS", "noise", "checked", "worst", "shape"], rows)


def parameter_table(result: Addition, *, most: int | None = None) -> str:
    """Return the fitted numbers, `most` of them at most."""
    shown = [each for each in result.parameters if not each.of_patch]
    rows = [
        [
            plain_size(each.name, each.value, each.low, each.high, unit=result.unit),
            plain_before(each.name, each.before, each.low, each.high, unit=result.unit),
            "" if each.possible else "impossible",
        ]
        for each in shown[:most]
    ]
    if len(rows) < len(shown):
        rows.append([f"and {len(shown) - len(rows)} more", "", ""])
    return table(["fitted, with its 95 % interval", "before", ""], rows, words=[-1])
