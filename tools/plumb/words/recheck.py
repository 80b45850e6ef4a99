"""Is it as it was? A sentence, each mark against the promise, what may have changed; the diary."""

from dataclasses import dataclass
from math import dist
from typing import Any

from plumb.diary.recheck import LEFT, RIGHT, SHEET_X, SHEET_Y, LikelyChange, Recheck, RecheckedMark
from plumb.model.plain import in_feet, plain_change, plain_name, words_of
from plumb.text.answers import in_json, json_of
from plumb.text.values import Unit
from plumb.words import Heading, Link, Rows

SHOWN = 4  # changes
PROVES = (
    "Cut two marks that took no part, on the same sheet, with the new settings. Then read them. "
    "They show how the machine does away from the marks of the fit."
)
NO_PROMISE = (
    "Two marks that took no part show whether the settings hold. First write a correction: it "
    "makes the promise."
)
TO_PROMISE = Link("To the correction", "correct")


def what_is_proved(*, is_promised: bool) -> Heading:
    """Return how a screen begins that holds marks against a promise, once there is one."""
    return Heading("Is it true?", PROVES if is_promised else NO_PROMISE)


NOTES = (
    "Each correction with its error, and the history of the numbers. A number that moved by more "
    "than its interval says that the machine has changed."
)
NO_NOTE = (
    "Each correction that you write, and what you send to the machine, is noted here by itself. "
    "Nothing is noted yet."
)


def what_is_noted(*, any_note: bool) -> Heading:
    """Return how a screen begins that shows a diary."""
    return Heading("The diary", NOTES if any_note else NO_NOTE)


@dataclass(frozen=True)
class RecheckAnswer(Recheck):
    """Marks against what the fit promised, in words too."""

    @in_json
    def sentence(self) -> str:
        """The verdict in a sentence or two."""
        unit, of_date = self.unit, f"the fit of {self.fit.at:%Y-%m-%d}"
        worst = unit.worded(max(mark.off for mark in self.marks))
        if self.state == "as_fitted":
            return (
                f"The machine is as it was fitted: by {of_date}, errors up to {worst} are to be "
                "expected."
            )
        if self.state == "beyond_these_marks":
            said = (
                f"Errors up to {worst} are more than {of_date} allows; no single change explains "
                "them."
            )
        else:
            likeliest = changed(self.changes[0], unit)
            said = f"Something changed since {of_date}. The likeliest: {likeliest}."
        far = [mark.name for mark in self.marks if mark.off > mark.expected_mm]
        return f"{said} First read mark {far[0]} again: it alone is off." if len(far) == 1 else said

    @property
    def headline(self) -> str:
        """The same for calibrate, which else writes files."""
        return f"{self.sentence} Nothing was written." if self.holds else self.sentence

    def entry(self, form: str, machine: str) -> dict[str, Any]:
        """Return what the diary keeps of marks of a form, cut with these settings."""
        return {"form": form, "machine": machine, **json_of(self)}

    @property
    def tables(self) -> list[Rows]:
        """Each mark, and single changes that may explain what is off."""
        unit = self.unit
        head = ["mark", f"at [{unit.name}]", "error", "expected up to", "off its target"]
        marks = Rows(head, [_row(mark, unit) for mark in self.marks])
        if self.state == "as_fitted":
            return [marks]
        changes = [
            [changed(change, unit), "yes" if change.explains else "no"]
            for change in self.changes[:SHOWN]
        ]
        return [marks, Rows(["a single change", "explains the marks"], changes)]


def in_words(checked: Recheck) -> RecheckAnswer:
    """Return the same, in words too."""
    return RecheckAnswer(**vars(checked))


def _row(mark: RecheckedMark, unit: Unit) -> list[str]:
    at, error = map(unit.bare, mark.hole, (1, 1)), map(unit.signed, mark.error)
    off = dist(mark.hole, mark.target)
    return [mark.name, ", ".join(at), ", ".join(error), *map(unit.bare, (mark.expected_mm, off))]


def changed(change: LikelyChange, unit: Unit) -> str:
    """Return a change with its size."""
    size = f"{unit.signed(change.size)} +- {unit.worded(change.sigma)}"
    if change.name in (LEFT, RIGHT):
        return f"the {change.name} is {size} longer than the machine believes"
    if change.name in (SHEET_X, SHEET_Y):
        return f"the sheet has moved by {size} along {change.name[-1]}"
    words = words_of(change.name)
    if "." not in change.name and words["unit"] == "mm":
        return f"{plain_name(change.name)} by {size}"
    now = change.before + change.size
    low, high = now - change.sigma, now + change.sigma
    said = plain_change(change.name, change.before, now, low, high, unit)
    by = f"by {said.shift} +- {said.margin} {said.unit}"
    return in_feet(words["more"], unit).replace("by #", "#").replace("#", by)
