"""The decision on what to write, for terminal, page and report.

The diagnosis says what the marks prove. Here it is decided what follows for the machine: a reading
is looked at again; the settings are good and stay; new numbers are better, and by how much; or
something is measured first. The headline, what speaks against the numbers, what a hand must do
before they hold and the screen that comes next are said here and nowhere else.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from math import hypot
from typing import Annotated

from plumb.cure.add import WEIGHTS, Addition, Note, add
from plumb.cure.live_board import TooFewError
from plumb.cure.machine_file import has_setting
from plumb.diagnosis.answer import MOST_NAMED, Diagnosis, Verdict, odds_words
from plumb.diagnosis.diagnosis import diagnose
from plumb.diagnosis.expected_error import RivalError, expected_error, rival_error
from plumb.fit.inputs import Inputs
from plumb.model.catalogue import every_effect
from plumb.model.plain import noun_of, plainly, ranked
from plumb.text.answers import Internal, among, in_json, key, part
from plumb.text.errors import in_both, said_by, to_do

AS_GOOD = 0.95  # of an error at marks left out, below which another is clearly less
# Where two effects or more act, others hide behind them that the marks do not ask for, and so does
# what no effect draws. On 205 boards of the judge with such a verdict 1.44 times as much came as
# the explanations leave open.
HIDDEN_BESIDE = 1.4
STATES = ("read_again", "good", "impossible", "better", "measure_first", "unknown_cause")


@dataclass(frozen=True)
class NextStep:
    """Where a page goes on."""

    text: str
    screen: str


@dataclass(frozen=True)
class Decision:
    """Decision on what to write, and its reasons."""

    diagnosis: Internal[Diagnosis]
    inputs: Internal[Inputs]  # with what is usual of the sizes that were added
    reason: str  # one sentence
    chosen: tuple[str, ...] = ()  # effects added: those asked for, then what every machine has
    rivals: tuple[tuple[str, ...], ...] = ()  # explanations that the marks allow as well
    # None: nothing is fitted to a wrong reading, to too few marks, or where all is well
    addition: Internal[Addition | None] = None
    offer: Annotated[
        tuple[float, float] | None,
        key("patch_offer_mm", "Error on marks left out, without a patch and with it."),
    ] = None
    # How to tell the chosen from their rivals.
    settled_by: tuple[str, ...] = ()
    apart: RivalError | None = None  # where rivals would cut elsewhere by more than the noise

    verdict = part("diagnosis.verdict", Verdict)

    @in_json
    def state(self) -> Annotated[str, among(STATES)]:
        """Result for the machine."""
        if self.addition is None:
            state = self.diagnosis.state
            return state if state in ("read_again", "good") else "measure_first"
        if self.addition.stops:
            return "impossible"
        if not self.is_explained:
            return "unknown_cause"
        return "measure_first" if self.rivals else "better"

    @in_json
    def headline(self) -> str:
        """The decision for people, in at most forty words."""
        return _headline(self)

    @in_json
    def notes(self) -> tuple[Note, ...]:
        """Notes on the new numbers, the heaviest first."""
        return tuple(_notes(self))

    @in_json
    def slips(self) -> tuple[str, ...]:
        """Names of the readings that are wrong."""
        return tuple(slip.name for slip in self.diagnosis.outliers)

    @property
    def named(self) -> tuple[str, ...]:
        """Effects of the account behind the choice, without what every machine has and the
        settings leave out.
        """
        return self.diagnosis.likely

    @property
    def said(self) -> tuple[str, ...]:
        """Why it was added, and whether the choice matters, in sentences."""
        why = in_both(self.reason, lambda reason: f"{reason[0].upper()}{reason[1:]}.")
        if self.apart:
            return why, self.apart.sentence
        if self.rivals and self.addition:
            return why, "For cutting it hardly matters: they differ by less than a reading's noise."
        return (why,)

    @property
    def is_explained(self) -> bool:
        """Whether the library explains what the new numbers change."""
        is_named = self.diagnosis.is_finding and bool(self.chosen)
        return self.diagnosis.verdict != "not_in_library" or is_named

    @property
    def done(self) -> bool:
        """Whether the marks ask for nothing more once the chosen effects are there."""
        is_untested = self.state == "measure_first" and self.addition is not None
        return self.state in ("better", "good") or is_untested

    @property
    def expected_mm(self) -> float | None:
        """The error to expect over the sheet [mm RMS] of the settings to go on with, and of what
        no effect draws; None where nothing is to be cut yet.
        """
        if not self.done:
            return None
        expected = expected_error(self.diagnosis.best, self.diagnosis.rivals)
        if self.diagnosis.verdict == "not_in_library":
            return hypot(expected, self.diagnosis.pattern_mm)
        return expected * (HIDDEN_BESIDE if len(self.diagnosis.likely) > 1 else 1.0)

    @property
    def step(self) -> NextStep:
        """Where a page goes on."""
        addition, slips = self.addition, self.diagnosis.outliers
        if slips:
            return NextStep(f"Go to {slips[0].called}", "readings")
        if self.state == "better" and addition:
            count = sum(has_setting(each.name) for each in addition.parameters)
            return NextStep(f"Correct it: {count} number{'s' if count != 1 else ''}", "correct")
        if self.state == "measure_first" and addition is None:
            return NextStep("Choose marks all over the sheet", "measure")
        return NextStep("Back to the verdict", "verdict")


def decide(inputs: Inputs, *, patch: bool = False, diagnosis: Diagnosis | None = None) -> Decision:
    """Diagnose the marks and fit the likeliest account, with what every machine has and the
    settings leave out; nothing where the settings are as good as the marks can show. `diagnosis` is
    that of these inputs, if it is known.

    Where the library has no account, the nearest is added if marks left out are predicted better
    with it: to leave out a large effect because a small effect is unknown would help nobody. What
    every machine has is not added to it where it predicts them worse. A residual patch is offered
    then, and added only if `patch` asks for it. Raises InputError as diagnose() and add() do.
    """
    diagnosis = diagnosis or diagnose(inputs)
    inputs = replace(inputs, checked=(*inputs.checked, *diagnosis.usual))
    nothing = {
        "read_again": _slip_reason(diagnosis),
        "measure_first": f"nothing was added. {diagnosis.left_open.sentence}",
        "good": GOOD,
    }
    if diagnosis.state in nothing:
        return Decision(diagnosis, inputs, nothing[diagnosis.state])
    is_known = diagnosis.verdict != "not_in_library"
    try:
        # The noise is that of the diagnosis: what is usual would count twice in another posterior.
        addition = add(inputs, effects=diagnosis.to_add, noise=diagnosis.noise)
    except TooFewError as error:
        return Decision(diagnosis, inputs, "nothing was added: " + said_by(error))
    chosen, offer = diagnosis.to_add, None
    if not is_known:
        bare_addition = add(inputs, effects=diagnosis.likely, noise=diagnosis.noise)
        if bare_addition.after.left_out_rms < AS_GOOD * addition.after.left_out_rms:
            chosen, addition = diagnosis.likely, bare_addition
        if not addition.pays:
            chosen, addition = (), add(inputs, effects=(), noise=diagnosis.noise)
        patched = add(inputs, effects=chosen, patch=True, noise=diagnosis.noise)
        offer = addition.after.left_out_rms, patched.after.left_out_rms
        addition = patched if patch else addition
    rivals = tuple(each.effects for each in diagnosis.explanations[1:]) if is_known else ()
    return Decision(
        diagnosis=diagnosis,
        inputs=inputs,
        reason=_reason(diagnosis, chosen, rivals),
        chosen=chosen,
        rivals=rivals,
        addition=addition,
        offer=offer,
        settled_by=_settled_by(diagnosis),
        apart=rival_error(diagnosis.fits, diagnosis.noise.sigma) if rivals else None,
    )


# The decision in words.

GOOD = "your machine is as good as these marks can show: nothing to change"


def _headline(decision: Decision) -> str:
    diagnosis, addition = decision.diagnosis, decision.addition
    if decision.state == "good":
        return f"{GOOD[0].upper()}{GOOD[1:]}.".replace(": nothing", ". Nothing")
    if addition is None or (diagnosis.is_finding and decision.state == "better"):
        return diagnosis.sentence
    fall = fall_sentence(addition)
    if decision.state == "impossible":
        return f"Do not set the machine by these numbers. {fall}"
    if decision.state == "unknown_cause":
        return f"No cause explains all that the marks show. {fall}"
    added = addition.effects_added
    few = added if len(added) <= MOST_NAMED else ()
    what = plainly(few) if few or not added else f"{len(added)} causes at once"
    if decision.rivals:
        share = odds_words(diagnosis.explanations[0].share)
        return f"Untested: {what}, right with odds of {share}. {fall}"
    again = f"{plainly(decision.chosen)} fitted again" if decision.chosen else "the frame fitted"
    return f"With {f'{what} added' if added else again}, {fall[0].lower()}{fall[1:]}"


def fall_sentence(addition: Addition) -> str:
    """Return the error before and after, for people."""
    unit, after = addition.unit, addition.after
    return (
        f"The error falls from {unit.bare(addition.raw.rms)} to {unit.worded(after.fit_rms)} RMS, "
        f"{unit.worded(after.left_out_rms)} checked on marks not used."
    )


def _notes(decision: Decision) -> list[Note]:
    promises = [decision.apart.sentence] if decision.apart else []
    if decision.expected_mm is not None and not decision.rivals:
        expected = decision.inputs.unit.worded(decision.expected_mm)
        promises.append(f"Over the sheet expect errors of {expected} RMS.")
    slips = [slip.sentence for slip in decision.diagnosis.outliers]
    notes = list(decision.addition.notes) if decision.addition else []
    notes += [Note("promise", each) for each in promises] + [Note("doubt", each) for each in slips]
    return ranked(notes, lambda note: WEIGHTS.index(note.weight))


def _settled_by(diagnosis: Diagnosis) -> tuple[str, ...]:
    """Return how to look directly at each effect that is in some explanations only."""
    explanations = [each.effects for each in diagnosis.explanations]
    names = dict.fromkeys(name for explanation in explanations for name in explanation)
    remedies = {effect["name"]: effect["remedy"] for effect in every_effect()}
    undecided = (
        name for name in names if not all(name in explanation for explanation in explanations)
    )
    return tuple(f"{noun_of(name)}: {remedies[name]}" for name in undecided)


def _slip_reason(diagnosis: Diagnosis) -> str:
    names = ", ".join(dict.fromkeys(slip.name for slip in diagnosis.outliers))
    return (
        f"nothing was added: look at the reading of {names} again first, and correct it "
        + to_do(
            "in the file, or leave the mark out with --without NAME",
            page="under Readings, or clear it there",
        )
    )


def _reason(
    diagnosis: Diagnosis, chosen: tuple[str, ...], rivals: tuple[tuple[str, ...], ...]
) -> str:
    named = diagnosis.likely
    usual = _usual_sentence([name for name in chosen if name not in named])
    asked = to_do("plumb next", page="Verdict") + " for what to measure"
    if diagnosis.verdict == "nothing_provable" and named:
        said = f"no cause is certain, but it is more likely than not {plainly(named)}"
        return f"{said}: so that was added{usual}"
    if diagnosis.verdict == "nothing_provable":
        return f"the marks show no cause, so only the frame was fitted{usual}"
    if diagnosis.verdict == "not_in_library":
        added = [name for name in chosen if name in named]
        if diagnosis.is_finding and added:
            why = (
                "takes most of the error"
                if diagnosis.takes_most
                else "is likely whatever else acts"
            )
            return f"{plainly(added)} {why}, so that was added{usual}"
        part = f"only {plainly(added)} was added, as far as it goes" if added else "none was added"
        return (
            f"no effects of the library explain all that the marks show, so {part}; read the worst "
            "marks again, and see " + asked + usual
        )
    if rivals:
        return (
            f"a choice: the likeliest is {plainly(named)}, but it may also be {_listed(rivals)}. "
            "See " + asked + " to tell them apart" + usual
        )
    return f"the marks ask for {plainly(named)}{usual}"


def _usual_sentence(effects: Sequence[str]) -> str:
    """Return why effects were added that no mark asks for; it goes after another sentence."""
    if not effects:
        return ""
    it, its, size = ("it", "its", "size") if len(effects) == 1 else ("them", "their", "sizes")
    return (
        f". Every machine has {plainly(effects)}, and these settings leave {it} out. So the fit "
        f"has {it} too, near {its} usual {size} unless the marks say otherwise"
    )


def _listed(rivals: Sequence[tuple[str, ...]]) -> str:
    """Return rivals by name; the less likely by their number."""
    said = [plainly(rival) for rival in rivals[:MOST_NAMED]]
    more = len(rivals) - len(said)
    if more:
        said.append(f"one of {more} more" if more > 1 else "another")
    return "; or ".join(said)
