"""What to measure? The best proposal with its steps, and the other ways in a few rows."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Annotated

from plumb.fit.inputs import what_to_type
from plumb.model.plain import noun_of, plainly
from plumb.plan.preview import Outline, Preview
from plumb.plan.proposal import CONFIRM, EXPLORE, FIND, READ_ONLY, REREAD, SETTLE, Next, Proposal
from plumb.settings import MachineSettings
from plumb.text.answers import Internal, in_json, key, part
from plumb.text.values import Unit
from plumb.words import Part, Rows, Sentences
from plumb.words.verdict import DiagnosisInWords

FEW = 5  # proposals; the JSON has all
HEADS = {
    SETTLE: "chance to settle",
    CONFIRM: "chance to confirm",
    FIND: "may act unseen then",
    REREAD: "chance to show it",
    EXPLORE: "",
}
VERBS = {SETTLE: "settle it", CONFIRM: "confirm it", REREAD: "show it"}


@dataclass(frozen=True)
class ProposalInWords(Proposal):
    """One thing to measure, what to expect of it, and the same in words."""

    @in_json
    def headline(self) -> str:
        """What to measure, how long it takes and what to hope of it; without the full stop."""
        said = f"{self.option.title}; about {self.option.minutes:.0f} minutes"
        if self.question == FIND and self.rooms:
            first = self.rooms[0]
            noun = noun_of(first.effect)
            now, then = (self.unit.worded(size, 1) for size in (first.now, first.then))
            may_act = f"{noun[0].upper()}{noun[1:]} may act unseen by"
            return f"{said}. {may_act} {now} now, by {then} then"
        verb = VERBS.get(self.question)
        hope = f", chance to {verb} {percent(self.chance)}"
        return said if self.chance is None or verb is None else said + hope

    @in_json
    def steps(self) -> list[str]:
        """What to do, and which effects are tried by it, in sentences."""
        do = [*map(self.unit.reading, self.option.do)]
        sets = [[set(side.split(" + ") if side else ()) for side in pair] for pair in self.parts]
        tried = dict.fromkeys(
            name
            for pair, (left, right) in zip(self.parts, sets, strict=True)
            for name in " + ".join(pair).split(" + ")
            if name and name in left ^ right
        )
        if len(tried) == 1:
            return [*do, f"It shows whether {plainly(tried)} acts."]
        acting = ", ".join(map(noun_of, tried))
        return [*do, f"It shows which of these act: {acting}."] if tried else do

    @in_json
    def promise(self) -> str:
        """What to hope of it, for a table."""
        if self.question != FIND or not self.rooms:
            return percent(self.chance)
        unit = self.unit
        promise = ", ".join(
            f"{noun_of(room.effect)} {unit.bare(room.now, 1)} -> {unit.worded(room.then, 1)}"
            for room in self.rooms[:2]
            if room.then < 0.9 * room.now
        )
        return promise or "no change"


def percent(chance: float | None) -> str:
    """Return a chance in steps of five in a hundred: it is not known better."""
    if chance is None:
        return "-"
    near = 5 * round(20 * chance)
    return "below 5 %" if near < 5 else "above 95 %" if near > 95 else f"{near:.0f} %"


@dataclass(frozen=True)
class NextInWords(Next):
    """All that is worth measuring, in words too."""

    proposals: Annotated[tuple[ProposalInWords, ...], key("next")]
    blind: Annotated[ProposalInWords | None, key("more_marks")]


def in_words(advice: Next) -> NextInWords:
    """Return the next measurements, in words too."""
    several = tuple(ProposalInWords(**vars(each)) for each in advice.proposals)
    blind = ProposalInWords(**vars(advice.blind)) if advice.blind else None
    return NextInWords(**{**vars(advice), "proposals": several, "blind": blind})


@dataclass(frozen=True)
class ProposalsAnswer(NextInWords):
    """The proposals, with what they are for."""

    diagnosis: Internal[DiagnosisInWords]
    written: tuple[str, ...]

    sentence = part("diagnosis.sentence", str)
    suspects = part("diagnosis.suspects", tuple[str, ...])


def headline(best: ProposalInWords | None) -> str:
    """Return what to measure and what to hope of it, or that nothing would tell more."""
    return f"Next: {best.headline}." if best else "Nothing that can be proposed would tell more."


def other_ways(advice: NextInWords, shown: int = 1) -> list[Part]:
    """Return the best proposals in a few rows, without the one that is shown in whole."""
    others = [(i, each) for i, each in enumerate(advice.proposals[:FEW], 1) if i != shown]
    if not others:
        return []
    question = others[0][1].question
    columns = 4 if HEADS[question] else 3  # a look around promises nothing
    rows = [
        [f"{i}", each.option.title, f"{each.option.minutes:.0f}", each.promise][:columns]
        for i, each in others
    ]
    head = ["", "other ways", "minutes", HEADS[question]][:columns]
    return [Rows(head, rows, left=2, words=[3] if question == FIND else ())]


def to_read(best: Proposal, steps: Sequence[str], settings: MachineSettings) -> Sentences:
    """Return the steps of a measurement, and what is typed for VALUE."""
    typed = what_to_type([check.name for check in best.option.checks], settings, best.unit)
    return Sentences([*steps, typed] if typed else steps, "  ")


def when_measured(best: Proposal, form: str) -> str:
    """Return what to do with the readings; `form`: the file of the marks so far."""
    if best.option.checks or len(best.option.visits):
        return f"When {'that is' if best.option.checks else 'they are'} measured:"
    if best.question == REREAD:
        return f"Correct its line in {form}. Then:"
    if best.option.kind in READ_ONLY:
        return f"Add each reading to {form} as a [[distance]] of the same ends. Then:"
    return "When that is measured:"


def taking_words(marks: int, form: str, program: str) -> tuple[str, str]:
    """Return what taking a proposal writes, and what its button says; no program: a tape reads
    marks that are there.
    """
    if program:
        said = f"{program} cuts them, {form} waits for their readings."
        return said, f"Take these {marks} marks; nothing moves yet"
    return f"{form} waits for them; nothing is cut.", f"Take these {marks} readings"


# What marks could tell before a hole is cut.

ALIKE = 2  # causes that a cause may be taken for, by name


def could_tell(seen: Preview) -> str:
    """Return how many causes marks would show, and how many could be named; no whole sentence."""
    return (
        f"of {len(seen.outlines)} causes in their usual size, {seen.seen} would show and "
        f"{seen.named} could be named"
    )


def causes(seen: Preview, unit: Unit) -> list[Part]:
    """Return what marks could tell, and each cause by itself."""
    rows = [[sign, each.noun, said] for each in seen.outlines for sign, said in [chances(each)]]
    first = f"{seen.marks} marks read to {unit.worded(seen.sigma)}: {could_tell(seen)}."
    return [
        Sentences([first], ""),
        Rows(["", "cause", "by these marks it"], rows, left=3, words=[2]),
    ]


def _taken_for(outline: Outline) -> str:
    """Return the causes that a cause may be taken for; empty if there are none."""
    named, more = ", ".join(map(noun_of, outline.alike[:ALIKE])), len(outline.alike) - ALIKE
    return f"{named} and {more} more" if more > 0 else named


def chances(outline: Outline) -> tuple[str, str]:
    """Return whether marks would show and name a cause, in a sign and in words."""
    if not outline.is_seen:
        return "○", "would stay hidden in its usual size"
    if outline.is_distinct:
        return "●", "would be found and named"
    alike = _taken_for(outline)
    said = f"but may be taken for {alike}" if alike else "but is not always told apart"
    return "◐", f"would show, {said}"


def advised(
    seen: Preview, title: str, minutes: float, unit: Unit, *, instead_of: tuple[Preview, str] | None
) -> str:
    """Return what the recommended marks could tell; `instead_of`: the usual marks, and a title."""
    if seen.seen:
        few, usual = instead_of or (None, "")
        more = f", instead of {few.seen} and {few.named} with {usual.lower()}" if few else ""
        return f"{title}, about {minutes:.0f} minutes: {could_tell(seen)}{more}."
    return (
        f"With a tape that reads to {unit.worded(seen.sigma)} no plan here would show a cause of "
        "its usual size. Any of them shows causes that move marks further."
    )
