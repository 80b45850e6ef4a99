"""Two proof marks: whether they are where the settings promise."""

from collections.abc import Mapping
from datetime import datetime
from typing import Any

from fastapi import APIRouter
from pydantic import BaseModel

from plumb.cure.add import add
from plumb.diary.file import FIT, RECHECK, Entry, append, fit_entry, read_diary
from plumb.diary.recheck import MeasuredMark, fit_of, recheck
from plumb.fit.inputs import Inputs
from plumb.lab.machine_line import TheLine
from plumb.lab.project import Choices, Project, save_choices
from plumb.lab.rounds import (
    command,
    form_of,
    inputs_of_promise,
    is_proof,
    proof_forms,
    proof_round,
    unit_words,
)
from plumb.lab.routes.project import ProjectAnswer, TheProject, show
from plumb.lab.routes.rounds import RoundAnswer, round_answer
from plumb.marks.read import from_edges
from plumb.model.catalogue import effect_names
from plumb.text.errors import InputError
from plumb.words import Heading, Link, Rows
from plumb.words.recheck import TO_PROMISE, RecheckAnswer, in_words, what_is_proved

router = APIRouter(tags=["proof"])


class RoundError(BaseModel):
    """The errors of a form's marks."""

    form: str
    off_target: float  # [mm] RMS
    is_proof: bool


class ProofAnswer(BaseModel):
    """The proof marks: to be cut, to be read, or judged."""

    heading: Heading
    instead: Link | None  # where to go on while nothing can be checked
    round: RoundAnswer | None  # the marks; None: nothing can be checked yet
    earlier: list[tuple[float, float]]  # of the marks that were fitted, machine frame
    meant: list[tuple[float, float]]  # the proof marks from the chosen edges
    checked: RecheckAnswer | None  # None: not all is read yet
    tables: list[Rows]
    rounds: list[RoundError]  # in the order they were cut, the proof marks last
    is_used: bool  # the verdict goes by these marks too
    is_noted: bool  # the diary has this result
    command: str


@router.get("/proof")
def show_proof(project: TheProject, line: TheLine) -> ProofAnswer:
    """Return the newest round of proof marks, or a plan for the first."""
    choices, inputs = project.choices, inputs_of_promise(project)
    is_promised = inputs.settings.fitted is not None
    shown = round_answer(proof_round(project), project, line) if is_promised else None
    form = shown.form if shown else ""
    checked = _checked(project, inputs, form) if form in proof_forms(project) else None
    corner, sheet = choices.edges, inputs.settings.sheet
    return ProofAnswer(
        heading=what_is_proved(is_promised=is_promised),
        instead=None if is_promised else TO_PROMISE,
        round=shown,
        earlier=[mark.target for mark in inputs.measurements.marks if mark.measured],
        meant=[from_edges(mark.target, sheet=sheet, corner=corner) for mark in shown.marks]
        if shown
        else [],
        checked=checked,
        tables=checked.tables if checked else [],
        rounds=_rounds(project, choices, form) if checked else [],
        is_used=form in choices.marks,
        is_noted=checked is not None and _is_noted(project, checked.entry(form, choices.settings)),
        command=_command(project, inputs, shown) if shown else "",
    )


@router.post("/proof/note")
def note_proof(project: TheProject) -> ProjectAnswer:
    """Write the result of the newest round of proof marks into the folder's diary, once."""
    choices, form = project.choices, _newest(project)
    checked = _checked(project, inputs_of_promise(project), form)
    if checked is None:
        raise InputError("not all proof marks are read: there is no result yet")
    entry = checked.entry(form, choices.settings)
    if not _is_noted(project, entry):
        append(project.folder, RECHECK, entry)
    return show(project)


@router.post("/proof/use")
def use_proof(project: TheProject) -> ProjectAnswer:
    """Let the verdict go by the proof marks too, so that the next check needs new marks."""
    form = _newest(project)

    def with_it_last(choices: Choices) -> Choices:
        used = [*(name for name in choices.marks if name != form), form]
        return choices.model_copy(update={"marks": used})

    save_choices(project, with_it_last)
    return show(project)


def _newest(project: Project) -> str:
    """Return the form of the newest proof marks. Raises InputError if there are none."""
    forms = proof_forms(project)
    if not forms:
        raise InputError("there are no proof marks yet: cut them first")
    return forms[-1]


def _command(project: Project, inputs: Inputs, shown: RoundAnswer) -> str:
    """Return the same in a terminal: what the fit promises of the proof marks that were read, or
    what makes them.
    """
    if project.read(shown.form) is None:
        return shown.command
    choices = project.choices
    unit = unit_words(choices, inputs.measurements.typed.unit)
    return command("calibrate", choices.settings, shown.form, *unit)


def _is_noted(project: Project, entry: Mapping[str, Any]) -> bool:
    """Return whether the diary's newest result of this form is this, in whatever unit."""
    kept = [each.content for each in read_diary(project.folder).of_kind(RECHECK)]
    noted = [each for each in kept if each.get("form") == entry["form"]]
    return bool(noted) and all(noted[-1][key] == entry[key] for key in ("machine", "marks"))


def _rounds(project: Project, choices: Choices, proof_form: str) -> list[RoundError]:
    """Return how far off the marks of each round are."""
    names = [*(name for name in choices.marks if not is_proof(name)), proof_form]
    forms = {name: form_of(project, choices, name).measurements for name in names}
    return [
        RoundError(form=name, off_target=off, is_proof=name == proof_form)
        for name, form in forms.items()
        if (off := form.off_target) is not None
    ]


def _checked(project: Project, inputs: Inputs, form: str) -> RecheckAnswer | None:
    """Return the proof marks against the fit; None before all are read."""
    marks = form_of(project, project.choices, form).measurements
    measured = [MeasuredMark(mark.name, where, mark.target) for mark, where in marks.readings]
    if len(measured) < len(marks.marks):
        return None
    fit = fit_of(read_diary(project.folder), inputs.settings) or _fitted_now(project, inputs)
    cut_with = marks.rounds[0].cut_with
    sigma, unit = marks.tape_sigma, inputs.unit
    checked = recheck(fit, inputs.settings, measured, cut_with=cut_with, sigma=sigma, unit=unit)
    return in_words(checked)


def _fitted_now(project: Project, inputs: Inputs) -> Entry:
    """Return the fit of settings that came without their diary: the same once more."""
    record = inputs.settings.fitted
    effects = [name for name in effect_names() if record and name in record.effects]
    name = project.choices.settings
    entry = fit_entry(add(inputs, effects=effects), inputs, machine=name, settings="")
    return Entry(FIT, datetime.now().astimezone(), entry)
