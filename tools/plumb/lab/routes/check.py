"""Two check marks: where to cut them, and whether they are where the settings promise."""

from collections.abc import Mapping, Sequence
from datetime import datetime
from math import dist
from typing import Any

import numpy as np
from fastapi import APIRouter
from pydantic import BaseModel

from plumb.cure.add import add
from plumb.diary.file import CHECK as NOTED
from plumb.diary.file import FIT, Entry, append, fit_entry, read_diary
from plumb.diary.recheck import Recheck, fit_of, recheck
from plumb.fit.inputs import Inputs, settings_in
from plumb.grid import program
from plumb.job.home import HomeTouch
from plumb.lab.broken_cut import HowFar, OnSheet, begin, go_on, how_far
from plumb.lab.machine_line import TheLine, refuse_other_machine, refuse_unknown_place
from plumb.lab.project import Choices, Project, save_choices
from plumb.lab.rounds import (
    Planned,
    command,
    cut_commands,
    has_readings,
    inputs_of,
    kept_settings,
    planned,
    refuse_unreachable,
    round_files,
    unit_words,
)
from plumb.lab.routes.machine import MachineAnswer, machine
from plumb.lab.routes.project import ProjectAnswer, TheProject, show
from plumb.lab.routes.readings import CHECK, ENDING, form_of
from plumb.marks.model import Measurements
from plumb.marks.plausible import from_edges
from plumb.model.catalogue import effect_names
from plumb.plan.planned_visits import check_places
from plumb.text.errors import InputError

router = APIRouter(tags=["check"])


class RoundError(BaseModel):
    """The errors of a form's marks."""

    form: str
    off_target: float  # [mm] RMS
    is_check: bool


class CheckedMark(BaseModel):
    """A check mark [mm]."""

    name: str
    target: tuple[float, float]
    predicted: tuple[float, float]  # where the fit says that it is
    measured: tuple[float, float]
    promised: float  # how far off 99 of 100 such readings are at most
    off: float  # how far the reading is from the prediction
    error: float  # how far it is from its target


class CheckAnswer(HowFar):
    """The check marks: to be cut, to be read, or judged."""

    trouble: str  # why nothing can be checked yet; empty if it can
    places: list[tuple[float, float]]  # machine frame
    earlier: list[tuple[float, float]]  # of the marks that were fitted
    meant: list[tuple[float, float]]  # the same from the chosen edges
    form: str
    program: str
    is_saved: bool
    marks: tuple[CheckedMark, ...]
    sentence: str  # empty: not all is read yet
    rounds: list[RoundError]  # in the order they were cut, the check marks last
    holds: bool
    is_used: bool  # the verdict goes by these marks too
    is_noted: bool  # the diary has this result
    command: str


@router.get("/check")
def show_check(project: TheProject, line: TheLine) -> CheckAnswer:
    """Return the newest check round, or a plan for the first."""
    choices = project.choices
    inputs = _of_promise(project)
    trouble = "" if inputs.settings.fitted else "write a correction first: it makes the promise"
    number = _newest(project)
    form, file = f"{CHECK}{number}{ENDING}", f"{CHECK}{number}.nc"
    is_saved = project.read(form) is not None
    plan = None if trouble or is_saved else _plan(inputs, [])
    of_plan = [(touch.x, touch.y) for touch in plan.touches] if plan else []
    places = _places(project, choices, form) if is_saved else of_plan
    corner, sheet = choices.edges, inputs.settings.sheet
    checked = None if trouble or not is_saved else _checked(project, inputs, form)
    names = [str(number) for number in range(1, len(places) + 1)]
    far = HowFar() if checked else how_far(project, line, file, _text(project, file), names)
    return CheckAnswer(
        **vars(far),
        trouble=trouble,
        places=places,
        earlier=[mark.target for mark in inputs.measurements.marks if mark.measured],
        meant=[from_edges(place, sheet=sheet, corner=corner) for place in places],
        form=form,
        program=file,
        is_saved=is_saved,
        marks=_marks(project, form, checked) if checked else (),
        sentence=checked.sentence if checked else "",
        rounds=_rounds(project, choices, form) if checked else [],
        holds=checked is not None and checked.holds,
        is_used=form in choices.marks,
        is_noted=checked is not None and _is_noted(project, _entry(choices, form, checked)),
        command=_command(project, inputs, form) if is_saved else _made(project, number, plan),
    )


@router.post("/check")
def save_check(project: TheProject) -> ProjectAnswer:
    """Write the program and the form for two check marks into the folder."""
    _save(project)
    return show(project)


@router.post("/check/cut")
def cut_check(project: TheProject, line: TheLine) -> MachineAnswer:
    """Write both, and send the program. The machine moves."""
    refuse_unknown_place(line)
    refuse_other_machine(project, line)
    name, text = _save(project)
    if owner := line.virtual:
        line.do(lambda sender: owner.weigh_down(owner.settings.sled_weight))
    begin(project, line, name, text)
    return machine(line)


@router.post("/check/go-on")
def go_on_with_check(cut: OnSheet, project: TheProject, line: TheLine) -> MachineAnswer:
    """Send the mark that is not on the sheet. The machine moves."""
    refuse_unknown_place(line)
    name = f"{CHECK}{_newest(project)}.nc"
    refuse_other_machine(project, line)
    go_on(project, line, name, _text(project, name), cut)
    return machine(line)


def _text(project: Project, name: str) -> str:
    """Return a program of the folder; empty if there is none."""
    return (project.read(name) or b"").decode(errors="replace")


@router.post("/check/note")
def note_check(project: TheProject) -> ProjectAnswer:
    """Write the result of the newest check round into the folder's diary, once."""
    choices, form = project.choices, f"{CHECK}{_newest(project)}{ENDING}"
    checked = _checked(project, _of_promise(project), form) if project.read(form) else None
    if checked is None:
        raise InputError("not all check marks are read: there is no result yet")
    entry = _entry(choices, form, checked)
    if not _is_noted(project, entry):
        append(project.folder, NOTED, entry)
    return show(project)


@router.post("/check/use")
def use_check(project: TheProject) -> ProjectAnswer:
    """Let the verdict go by the check marks too, so that the next check needs new marks."""
    form = f"{CHECK}{_newest(project)}{ENDING}"
    if project.read(form) is None:
        raise InputError("there are no check marks yet: cut them first")

    def with_it_last(choices: Choices) -> Choices:
        used = [*(name for name in choices.marks if name != form), form]
        return choices.model_copy(update={"marks": used})

    save_choices(project, with_it_last)
    return show(project)


def _command(project: Project, inputs: Inputs, form: str) -> str:
    """Return the same in a terminal: what the fit promises of the check marks that were read."""
    choices = project.choices
    unit = unit_words(choices, inputs.measurements.typed.unit)
    return command("calibrate", choices.settings, form, *unit)


def _made(project: Project, number: str, plan: Planned | None) -> str:
    """Return the command that writes the form and the program; empty if there is no plan."""
    if plan is None:
        return ""
    form, file = f"{CHECK}{number}{ENDING}", f"{CHECK}{number}.nc"
    return cut_commands(project, _same_sheet(project.choices), plan, form=form, program=file)


def _same_sheet(choices: Choices) -> Choices:
    """Check marks are on the sheet of the marks before them."""
    return choices.model_copy(update={"new_sheet": False})


def _of_promise(project: Project) -> Inputs:
    """Return the readings that the promise goes by."""
    return inputs_of(project, among=_promising(project))


def _promising(project: Project) -> list[str]:
    """Return the files of these readings: check marks take no part, nor does a sheet that was laid
    after the correction, for check marks are on the sheet before it.
    """
    choices = project.choices
    names = [name for name in choices.marks if not name.startswith(CHECK)]
    fitted = settings_in(project.path(choices.settings)).fitted if choices.settings else None
    seen = [board.marks for board in fitted.boards] if fitted else names
    later = (
        place
        for place, name in enumerate(names)
        if name not in seen and form_of(project, choices, name).measurements.rounds[0].new_sheet
    )
    return names[: next(later, len(names))]


def _entry(choices: Choices, form: str, checked: Recheck) -> dict[str, Any]:
    """Return the result of a round of check marks as the diary has it. mm."""
    return {
        "form": form,
        "machine": choices.settings,
        "sentence": checked.sentence,
        "holds": checked.holds,
        "marks": [
            {"name": mark.name, "promised": round(mark.expected_mm, 3), "off": round(mark.off, 3)}
            for mark in checked.marks
        ],
    }


def _is_noted(project: Project, entry: Mapping[str, Any]) -> bool:
    """Return whether the diary's newest result of this form is this, in whatever unit."""
    noted = [
        each
        for each in read_diary(project.folder).of_kind(NOTED)
        if each.content["form"] == entry["form"]
    ]
    same = ("machine", "marks")
    return bool(noted) and all(noted[-1].content[key] == entry[key] for key in same)


def _rounds(project: Project, choices: Choices, check_form: str) -> list[RoundError]:
    """Return how far off the marks of each round are."""
    names = [*(name for name in choices.marks if not name.startswith(CHECK)), check_form]
    forms = {name: form_of(project, choices, name).measurements for name in names}
    return [
        RoundError(form=name, off_target=off, is_check=name == check_form)
        for name, form in forms.items()
        if (off := form.off_target) is not None
    ]


def _newest(project: Project) -> str:
    """Return the number of the newest check round, as in the names of its files."""
    number, count = "", 1
    while project.read(f"{CHECK}-{count + 1}{ENDING}") is not None:
        count += 1
        number = f"-{count}"
    return number


def _plan(inputs: Inputs, cut: Sequence[tuple[float, float]]) -> Planned:
    """Two marks far from those that were fitted, and from check marks that were cut before."""
    known = [*map(tuple, inputs.measurements.targets), *cut]
    places = check_places(inputs.settings, np.array(known))
    if not len(places):
        raise InputError("no place is left that the sled reaches and that was not fitted")
    plan = planned(inputs.settings, "own", [(float(x), float(y)) for x, y in places])
    refuse_unreachable(plan, inputs.settings)
    return plan


def _save(project: Project) -> tuple[str, str]:
    """Write program and form of a round; the program's name and text."""
    choices = project.choices
    inputs = _of_promise(project)
    number = _newest(project)
    form = f"{CHECK}{number}{ENDING}"
    if has_readings(project, form):
        number = f"-{int(number[1:] or 1) + 1}"
        form = f"{CHECK}{number}{ENDING}"
    name, plan = f"{CHECK}{number}.nc", _plan(inputs, _cut_before(project, choices, form))
    text = program(plan.grid, plan.machine)
    files = round_files(project, _same_sheet(choices), plan, text, form=form, program=name)
    known = {each: project.digest(each) for each in files}
    project.save({**files, **kept_settings(project, choices)}, read=known)
    return name, text


def _cut_before(project: Project, choices: Choices, form: str) -> list[tuple[float, float]]:
    """Return where check marks were cut in the rounds before that of a form."""
    names = [f"{CHECK}{ENDING}"]
    while names[-1] != form:
        names.append(f"{CHECK}-{len(names) + 1}{ENDING}")
    return [place for name in names[:-1] for place in _places(project, choices, name)]


def _places(project: Project, choices: Choices, form: str) -> list[tuple[float, float]]:
    return [mark.target for mark in _measured(project, form).marks]


def _checked(project: Project, inputs: Inputs, form: str) -> Recheck | None:
    """Return the check marks against the fit; None before all are read."""
    marks = _measured(project, form)
    touches = [HomeTouch(mark.name, where, mark.target) for mark, where in marks.readings]
    if len(touches) < len(marks.marks):
        return None
    fit = fit_of(read_diary(project.folder), inputs.settings) or _fitted_now(project, inputs)
    cut_with = marks.rounds[0].cut_with
    return recheck(
        fit,
        inputs.settings,
        touches,
        cut_with=cut_with,
        sigma=marks.tape_sigma,
        unit=inputs.unit,
    )


def _fitted_now(project: Project, inputs: Inputs) -> Entry:
    """Return the fit of settings that came without their diary: the same once more."""
    record = inputs.settings.fitted
    effects = [name for name in effect_names() if record and name in record.effects]
    name = project.choices.settings
    entry = fit_entry(add(inputs, effects=effects), inputs, machine=name, settings="")
    return Entry(FIT, datetime.now().astimezone(), entry)


def _marks(project: Project, form: str, checked: Recheck) -> tuple[CheckedMark, ...]:
    """Return the check marks as the page shows them."""
    return tuple(
        CheckedMark(
            name=mark.name,
            target=sent.target,
            predicted=(mark.hole[0] - mark.error[0], mark.hole[1] - mark.error[1]),
            measured=mark.hole,
            promised=mark.expected_mm,
            off=mark.off,
            error=dist(mark.hole, sent.target),
        )
        for mark, sent in zip(checked.marks, _measured(project, form).marks, strict=True)
    )


def _measured(project: Project, form: str) -> Measurements:
    return form_of(project, project.choices, form).measurements
