"""What to write? The decision in at most forty words, the new numbers, and what speaks for them."""

from collections.abc import Sequence
from dataclasses import dataclass

from plumb.cure.add import Addition, FitStep, Note
from plumb.cure.decision import PATCH_WARNING, Decision, has_setting
from plumb.diagnosis.evidence import ORIGINS
from plumb.fit.compare import PATCH, Comparison
from plumb.model.plain import noun_of, plain_before, plain_size, plainly
from plumb.plan import Proposal
from plumb.text.answers import in_json
from plumb.text.errors import in_both, to_do
from plumb.text.values import Unit
from plumb.words import Heading, Kind, Link, Part, Rows, Sentences, filled, paragraph
from plumb.words import verdict as of_marks
from plumb.words.comparison import about, conclusion, outside_sentence, pose_sentence
from plumb.words.states import STATES
from plumb.words.verdict import MOST_NAMED, named, odds_words


@dataclass(frozen=True)
class DecisionInWords(Decision):
    """The decision, its headline, and its reasons."""

    @in_json
    def headline(self) -> str:
        """The decision for people, in at most forty words."""
        return headline(self)

    @in_json
    def reason(self) -> str:
        """One sentence."""
        return reason(self)

    @in_json
    def settled_by(self) -> tuple[str, ...]:
        """How to tell the chosen from their rivals."""
        return settled_by(self)


def in_words(decision: Decision) -> DecisionInWords:
    """Return a decision with its headline and its reasons."""
    return DecisionInWords(**vars(decision))


GOOD = "your machine is as good as these marks can show"


def headline(decision: Decision) -> str:
    """Return the decision in a sentence or two."""
    diagnosis, addition = decision.diagnosis, decision.addition
    if decision.state == "good":
        return f"{GOOD[0].upper()}{GOOD[1:]}."
    if addition is None or (diagnosis.is_finding and decision.state == "better"):
        return of_marks.sentence(diagnosis)
    fall, added = fall_sentence(addition), addition.effects_added
    if decision.state == "impossible":
        return f"Do not set the machine by these numbers. {fall}"
    if decision.state == "unknown_cause":
        return f"No cause explains all that the marks show. {fall}"
    if decision.rivals:
        share = odds_words(diagnosis.explanations[0].share)
        return f"Untested: {named(added)}, right with odds of {share}. {fall}"
    again = f"{plainly(decision.chosen)} fitted again" if decision.chosen else "the frame fitted"
    return f"With {f'{named(added)} added' if added else again}, {fall[0].lower()}{fall[1:]}"


def fall_sentence(addition: Addition) -> str:
    """Return the error before and after."""
    unit, after = addition.unit, addition.after
    return (
        f"The error falls from {unit.bare(addition.raw.rms)} to {unit.worded(after.fit_rms)} RMS, "
        f"{unit.worded(after.left_out_rms)} checked on marks not used."
    )


def of_named(addition: Addition) -> tuple[str, Kind]:
    """Return whether the effects that were named pay, in at most forty words, and its kind."""
    added, fall = [_noun(step) for step in addition.by_effect], fall_sentence(addition)
    if not added:
        return f"Only the frame is fitted. {fall}", "good"
    many = " and ".join(added) if len(added) <= MOST_NAMED else f"{len(added)} effects"
    if addition.pays:
        return f"It pays to add {many}. {fall}", "good"
    if addition.stops:
        return f"Do not set the machine by {many}. {fall}", "bad"
    return f"NOT better with {many}. {fall}", "bad"


def picture_heading(addition: Addition) -> str:
    """Return the heading of a picture of how the error falls."""
    added = " and ".join(noun_of(step.effect) for step in addition.by_effect)
    done = f"Added: {added}" if added else "Frame fitted, nothing added"
    before, after = about(addition.raw.rms), about(addition.after.fit_rms)
    return f"{done}. From {before} to {after} mm RMS"


def _noun(step: FitStep) -> str:
    return "the patch" if step.effect == PATCH else noun_of(step.effect)


# Why it was added, and whether the choice matters.


def said(decision: Decision) -> list[str]:
    """Return the reason, and how much the choice matters, in sentences."""
    why = in_both(reason(decision), lambda each: f"{each[0].upper()}{each[1:]}.")
    if decision.apart:
        return [why, decision.apart.sentence]
    if decision.rivals:
        return [why, "For cutting it hardly matters: they differ by less than a reading's noise."]
    return [why]


def reason(decision: Decision) -> str:
    """Return why this was added or nothing, without the full stop."""
    diagnosis, chosen = decision.diagnosis, decision.chosen
    if decision.state == "good":
        return GOOD
    if diagnosis.outliers:
        names = ", ".join(dict.fromkeys(decision.slips))
        return f"nothing was added: look at the reading of {names} again first, and correct it " + (
            to_do(
                "in the file, or leave the mark out with --without NAME",
                page="under Readings, or clear it there",
            )
        )
    if decision.addition is None and decision.refused:
        return "nothing was added: " + decision.refused
    if decision.addition is None:
        return f"nothing was added. {diagnosis.left_open.sentence}"
    likely, is_silent = diagnosis.likely, diagnosis.verdict == "nothing_provable"
    added = [name for name in chosen if name in likely]
    asked = "; see " + to_do("plumb next", page="Verdict") + " for what to measure"
    if decision.rivals:
        why = ", the likeliest of several" + asked + " to tell them apart"
    elif not decision.is_explained:
        why = (", as far as it goes" if added else "") + "; read the worst marks again" + asked
    elif diagnosis.is_finding:
        most = ". That takes most of the error away"
        why = most if diagnosis.takes_most else ", likely whatever else acts"
    elif is_silent:
        why = ", more likely than not" if added else ": the marks show none"
    else:
        why = ", as the marks ask for it"
    what = f"added: {plainly(added)}" if added else "no cause was added"
    return what + why + _usual_sentence([name for name in chosen if name not in likely])


def _usual_sentence(effects: Sequence[str]) -> str:
    """Return why effects were added that no mark asks for; it goes after another sentence."""
    if not effects:
        return ""
    it, its, size = ("it", "its", "size") if len(effects) == 1 else ("them", "their", "sizes")
    return (
        f". Every machine has {plainly(effects)}, and these settings leave {it} out. So the fit "
        f"has {it} too, near {its} usual {size} unless the marks say otherwise"
    )


def settled_by(decision: Decision) -> tuple[str, ...]:
    """Return how to look directly at each effect that is in some explanations only."""
    explanations = [each.effects for each in decision.diagnosis.explanations]
    names = dict.fromkeys(name for explanation in explanations for name in explanation)
    if decision.addition is None:
        return ()
    abouts = [
        of_marks.about(name)
        for name in names
        if not all(name in explanation for explanation in explanations)
    ]
    return tuple(f"{noun}: {how}" for noun, _, how in abouts)


# Above the headline: the new numbers, and what is to be known of them.

NUMBERS = 7  # rows of a short answer
SLIPS = 2  # sentences of a short answer
# What the columns of the tables of errors mean, one family of words for all commands.
COLUMNS = (
    "Noise: what reading errors alone would leave of that RMS. Checked: on marks not used, each "
    "predicted by a fit without it."
)


def short(decision: Decision) -> list[Part]:
    """Return the new numbers in a few rows, and what is to be known of them; or why there are
    none.
    """
    if decision.addition:
        return numbers(decision.addition, decision.notes)
    return without_numbers(decision)


def without_numbers(decision: Decision) -> list[Part]:
    """Return what is to be known of a decision before all."""
    if decision.state == "read_again":
        return [Sentences([note.text for note in decision.notes][:SLIPS])]
    notes = _first_of(decision.notes)
    return [Sentences(notes) if notes else paragraph(said(decision)[0])]


def numbers(addition: Addition, notes: Sequence[Note]) -> list[Part]:
    """Return the new numbers in a few rows, and what is to be known of them first."""
    return filled(_parameters(addition, most=NUMBERS), Sentences(_first_of(notes)))


def _first_of(notes: Sequence[Note]) -> list[str]:
    """Return the warnings; hints by their number."""
    hints = sum(note.weight == "hint" for note in notes)
    more = [f"{hints} more to know" + to_do(": see --details", page="")] if hints else []
    return [*(note.text for note in notes if note.weight != "hint"), *more]


def full(decision: Decision, *, is_taken: bool = True) -> list[Part]:
    """Return the diagnosis and the choice, then the new numbers, or what they would follow from if
    they are not taken.
    """
    diagnosis, addition = decision.diagnosis, decision.addition
    parts: list[Part] = [paragraph(of_marks.sentence(diagnosis))]
    if diagnosis.outliers:
        return [*parts, Sentences([slip.sentence for slip in diagnosis.outliers])]
    sure = settled_by(decision)
    parts += filled(
        *map(paragraph, said(decision)),
        paragraph("To be sure which it is:" if sure else ""),
        Sentences(sure),
        paragraph(_offer_sentence(decision)),
    )
    if addition and is_taken:
        return parts + everything(addition, decision.notes)
    return parts + filled(of_marks.accounts(diagnosis))


def _offer_sentence(decision: Decision) -> str:
    """Return what a residual patch would gain, or has gained."""
    if not decision.offer:
        return ""
    without, with_patch = decision.offer
    unit, addition = decision.inputs.unit, decision.addition
    error = "the error at marks not used"
    if with_patch >= without:
        return f"A residual patch would not lower {error} ({unit.worded(without)})."
    fall = f"{error} from {unit.bare(without)} to {unit.worded(with_patch)}"
    if addition and PATCH in addition.effects_added:
        return f"The residual patch lowers {fall}."
    option = to_do(" (--patch)", page="")
    return "A residual patch" + option + f" would lower {fall}. {PATCH_WARNING}"


def everything(
    addition: Addition, notes: Sequence[Note], *, asked_patch: bool = False
) -> list[Part]:
    """Return all of the addition but its verdict."""
    listed = [note.text for note in notes]
    if PATCH in addition.effects_added:
        listed.append(PATCH_WARNING)
    elif asked_patch:
        listed.append("a residual patch would predict marks not used no better, so none was added")
    return filled(
        _qualities(addition),
        _parameters(addition),
        paragraph(f"{COLUMNS} {intervals(addition)}"),
        Sentences(listed),
    )


def intervals(addition: Addition) -> str:
    """Return for which noise the intervals hold: a diagnosis may take another."""
    return of_marks.noise_sentence(addition.after_fit.sigma, addition.sigma_from, addition.unit)


def _qualities(addition: Addition) -> Rows:
    """Return how the error falls with each effect."""
    raw, unit = addition.raw, addition.unit
    as_set = (raw.rms, None, None, raw.worst, raw.shape_rms)
    rows = [["raw: the settings as they are", *map(unit.bare, as_set)]]
    fitted = [("the frame", addition.before)]
    fitted += [(f"+ {noun_of(step.effect)}", step) for step in addition.by_effect]
    for name, q in fitted:
        errors = (q.fit_rms, q.noise_rms, q.left_out_rms, q.worst, q.shape_rms)
        rows.append([f"fitted: {name}", *map(unit.bare, errors)])
    return Rows([f"error in {unit.name}", "RMS", "noise", "checked", "worst", "shape"], rows)


def _parameters(addition: Addition, *, most: int | None = None) -> Rows:
    """Return the fitted numbers, `most` of them at most."""
    shown = [each for each in addition.parameters if not each.of_patch]
    rows = [
        [
            plain_size(each.name, each.value, each.low, each.high, unit=addition.unit),
            plain_before(each.name, each.before, each.low, each.high, unit=addition.unit),
            "" if each.possible else "impossible",
        ]
        for each in shown[:most]
    ]
    if len(rows) < len(shown):
        rows.append([f"and {len(shown) - len(rows)} more", "", ""])
    return Rows(["fitted, with its 95 % interval", "before", ""], rows, words=[-1])


def sureness(decision: Decision) -> list[tuple[str, str]]:
    """Return how well marks that took no part are predicted, and the noise of a reading."""
    if decision.addition is None:
        return []
    fitted, noise = decision.addition.after_fit, decision.diagnosis.noise
    sizes = {
        "Marks left out are predicted to": fitted.left_out_rms,
        f"Noise of a reading ({ORIGINS[noise.source]})": noise.sigma,
        "The same, as these marks show it": fitted.corrected_rms / 2**0.5,
    }
    return [(what, decision.inputs.unit.worded(size)) for what, size in sizes.items()]


def step(decision: Decision) -> Link:
    """Return where a page goes on."""
    follows, addition = STATES[decision.state], decision.addition
    count = sum(has_setting(each.name) for each in addition.parameters) if addition else 0
    slip = next((slip.called for slip in decision.diagnosis.outliers), "")
    what = slip or f"{count} number{'s' if count != 1 else ''}"
    return Link(follows.link.format(what), follows.screen)


# A screen on which numbers are accepted, written and sent.

CHANGES = "What would change?"
FITTED = Heading(CHANGES, "The numbers are fitted to your readings.")


def what_changes(decision: Decision, file: str, *, count: int) -> Heading:
    """Return how a screen begins that offers so many numbers of a file to change."""
    if decision.addition is None:
        return Heading(STATES[decision.state].title, headline(decision))
    if count == 0:
        return Heading("Nothing would change", f"{file} fits these marks as it is.")
    return Heading(CHANGES, headline(decision))


def what_is_written(file: str) -> Heading:
    """Return the same once the numbers are in a file, and not in the machine."""
    return Heading(
        "The numbers are written",
        f"{file} holds them; your old file stays. The machine takes them next: nothing moves, and "
        "each number is read back.",
    )


def what_is_stale(file: str, form: str, before: str) -> Heading:
    """Return the same for numbers fitted to a form that has other readings by now; `before`: the
    file that was open before them, empty if there is none.
    """
    then = (
        f"Go back to {before}, and they are fitted again to what you read now. {file} stays in the "
        "folder."
        if before
        else "Open the settings that were in force when the marks were cut."
    )
    said = f"The numbers in {file} are stale: they were fitted to {form} as it was before. {then}"
    return Heading("Your readings have changed", said)


def what_is_added(unit: Unit, *, any_marks: bool) -> Heading:
    """Return how the bench for effects begins."""
    said = f"Add an effect: each row says what would be left with it [{unit.name}]. "
    if any_marks:
        said += "Pale arrows show the state before. Lay an effect over the marks to see what it "
        said += "draws. "
    return Heading("Effects bench", f"{said}Nothing goes to the machine.")


# A round of measuring: the size of the error, then the decision, or what is measured first.


def round_sentence(decision: Decision, best: Proposal | None) -> str:
    """Return the end of a round in one sentence; `best`: what to measure first."""
    if not decision.asks_for_more:
        return headline(decision)
    if best is None:
        return "Not yet: nothing that can be proposed would tell more."
    return (
        f"Not yet: first measure {best.option.title}, about {best.option.minutes:.0f} minutes; "
        "nothing was written."
    )


def round_in_short(decision: Decision, comparison: Comparison) -> list[Part]:
    """Return what is to be known of the new numbers; where something is to be measured first, the
    error as it is.
    """
    if not decision.asks_for_more or decision.addition is None:
        return without_numbers(decision)
    return [paragraph(f"{headline(decision)} {_outside(comparison, decision)}".strip())]


def round_in_full(decision: Decision, comparison: Comparison) -> list[Part]:
    """Return all that is known after a round."""
    outside, inputs = _outside(comparison, decision), decision.inputs
    pose = pose_sentence(comparison, inputs)
    return filled(
        paragraph(conclusion(comparison, inputs.unit)),
        paragraph(pose),
        paragraph(f"{outside} The diagnosis asks for that again." if outside else ""),
        *full(decision, is_taken=decision.is_settled),
    )


def _outside(comparison: Comparison, decision: Decision) -> str:
    """Return what an earlier fit found outside of the machine, which the error as set counts."""
    record = comparison.promised
    return outside_sentence(record, decision.inputs.unit) if record else ""
