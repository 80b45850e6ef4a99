"""The files of a proposal: the form that waits for its readings, and the program that cuts it."""

from __future__ import annotations

from plumb.grid.cut_with import cut_with_lines, with_form
from plumb.plan.plan_marks import marks_file
from plumb.plan.proposal import Next
from plumb.plan.visits_program import program


def form_of(
    advice: Next, place: int, path: str, *, settings: str | None, sheet: tuple[float, float]
) -> bytes:
    """The form at that path for the proposal with this number, from 1.

    `settings` is the file of the settings that the new marks are cut with, which the form then
    names; `sheet` is theirs.
    """
    option = advice.proposals[place - 1].option
    assert advice.case, "what is proposed is proposed for a case"
    return marks_file(
        option.visits,
        sheet=sheet,
        controller=advice.case.controller,
        said=(f"Proposal {place}: {option.title}.", *option.do),
        cut_with=cut_with_lines(settings, path),
    ).encode()


def program_of(advice: Next, place: int, path: str, *, form: str | None) -> bytes:
    """The program at that path that cuts the proposal with this number, from 1; it names the form
    for its readings."""
    option = advice.proposals[place - 1].option
    assert advice.case, "what is proposed is proposed for a case"
    text = program(option.visits, usual_weight=advice.case.usual_weight, do=option.do)
    return (with_form(text, form, path) if form else text).encode()
