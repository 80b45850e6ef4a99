"""Cutting the chosen marks: the program and its form into the folder, or to the machine."""

from collections.abc import Callable
from pathlib import Path
from typing import Annotated

from fastapi import APIRouter, Body
from pydantic import BaseModel

from plumb.grid import program, touches_of
from plumb.job.time_left import timetable
from plumb.lab.broken_cut import (
    HowFar,
    OnSheet,
    begin,
    go_on,
    how_far,
    plunges_in,
)
from plumb.lab.machine_line import MachineLine, TheLine, refuse_other_machine, refuse_unknown_place
from plumb.lab.project import (
    FILE,
    Choices,
    Project,
    read_choices,
    save_choices,
    with_marks,
)
from plumb.lab.rounds import (
    Planned,
    Taken,
    command,
    cut_commands,
    is_read_again,
    kept_settings,
    next_names,
    on_new_sheet,
    opened,
    planned,
    refuse_unreachable,
    round_files,
    taken_marks,
)
from plumb.lab.routes.machine import MachineAnswer, machine
from plumb.lab.routes.project import ProjectAnswer, TheProject, show
from plumb.lab.routes.readings import CHECK
from plumb.line.progress import Wait
from plumb.line.sender import cleaned
from plumb.marks.form import BLANK, read_form, with_distances
from plumb.model.predict import known_effects
from plumb.plan.options import HANGING, MARK, ROUND
from plumb.plan.planned_visits import refuse_way
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError, on_page
from plumb.vm.owner import VirtualOwner

router = APIRouter(tags=["grid"])


class GridMark(BaseModel):
    """A mark of the program [mm, machine frame]; cut when the machine took that many lines."""

    name: str
    place: tuple[float, float]
    lines: int


class GridAnswer(HowFar):
    """The program that cuts the chosen marks, or those that the verdict proposed."""

    form: str  # the file that waits for readings
    program: str  # the file of the G-code
    is_saved: bool  # both are in the folder as they would be written now
    marks: list[GridMark]  # in the order of the program
    minutes: float
    text: str  # the G-code
    trouble: str  # why the sled cannot take this way; empty if it can
    waits: int  # marks of the form that wait for a reading
    last_form: str  # the newest with readings; empty if there is none
    command: str
    sheet_rise: float = 0.0  # [mm] by which the next sheet's right end is raised, as the fit says
    is_proposed: bool = False  # somebody took them from the verdict; they go onto the sheet before
    pauses: tuple[Wait, ...] = ()  # where the program waits for somebody
    # [min] from the start until so many lines are done; empty without a machine's numbers
    done_at: tuple[float, ...] = ()


@router.get("/grid")
def show_grid(project: TheProject, line: TheLine) -> GridAnswer:
    """Return the program for the chosen marks, as it would be written now, and whether it broke
    off.
    """
    answer = _shown(project)
    names = [mark.name for mark in answer.marks]
    far = how_far(project, line, answer.program, answer.text, names)
    # What is to be done in a pause is asked again.
    taken = taken_marks(project, project.choices)
    goes_on = far.goes_on and not (taken and _pauses_between(answer))
    done_at = _done_at(line, answer.text)
    return answer.model_copy(update={**vars(far), "goes_on": goes_on, "done_at": done_at})


def _done_at(line: MachineLine, text: str) -> tuple[float, ...]:
    """Return when the lines of a program are done, as the connected machine runs it dry."""
    numbers, place = line.state.numbers, line.state.place or (0.0, 0.0, 5.0)
    lines = list(cleaned(text.splitlines()))
    times = timetable(numbers, lines, place) if numbers and lines else None
    return tuple(round(float(seconds) / 60, 2) for seconds in times.done_at) if times else ()


def _pauses_between(answer: GridAnswer) -> bool:
    """Return whether something is to be done between the first mark and the last."""
    first, last = answer.marks[0].lines, answer.marks[-1].lines
    return any(first <= wait.lines < last for wait in answer.pauses)


def _shown(project: Project) -> GridAnswer:
    choices = project.choices
    settings, trouble = opened(project), ""
    taken = taken_marks(project, choices)
    if taken:
        return _shown_taken(taken, settings, choices)
    plan = planned(settings, choices.layout, choices.planned)
    try:
        refuse_unreachable(plan, settings)
        text = program(plan.grid, plan.machine)
    except (ValueError, InputError) as error:
        text, trouble = "", on_page(error)
    form, file = next_names(project)
    files = round_files(project, choices, plan, text, form=form, program=file)
    there = project.read(form)
    return GridAnswer(
        form=form,
        program=file,
        is_saved=all(project.read(name) == content for name, content in files.items()),
        marks=_marks(plan, text),
        minutes=plan.minutes,
        text=text,
        trouble=trouble,
        waits=there.decode().count(BLANK) if there else 0,
        last_form=choices.marks[-1] if choices.marks else "",
        sheet_rise=_sheet_rise(settings, choices),
        command=cut_commands(project, choices, plan, form=form, program=file),
    )


def _shown_taken(taken: Taken, settings: MachineSettings, choices: Choices) -> GridAnswer:
    """Return the marks that the verdict proposed and the owner took."""
    trouble = ""
    try:
        refuse_way(settings, taken.marks)
    except InputError as error:
        trouble = on_page(error)
    lines = _lines_of_marks(taken.text)
    minutes = ROUND + MARK * len(taken.marks) + HANGING * bool(taken.waits)
    return GridAnswer(
        form=taken.form,
        program=taken.program,
        is_saved=True,
        marks=[
            GridMark(name=mark.name, place=mark.target, lines=count)
            for mark, count in zip(taken.marks, lines, strict=True)
        ],
        minutes=minutes,
        text=taken.text,
        trouble=trouble,
        waits=len(taken.marks),
        last_form=choices.marks[-1] if choices.marks else "",
        is_proposed=True,
        pauses=taken.waits,
        command=command("send", taken.program),
    )


@router.post("/grid")
def save_grid(project: TheProject) -> ProjectAnswer:
    """Write the program and a form for its marks into the folder."""
    _save(project)
    return show(project)


@router.post("/grid/cut")
def cut_grid(project: TheProject, line: TheLine) -> MachineAnswer:
    """Write both, and send the program. The machine moves."""
    refuse_unknown_place(line)
    choices = project.choices
    taken = taken_marks(project, choices)
    if taken:
        return _cut_taken(taken, project, line)
    refuse_other_machine(project, line)
    name, text = _save(project)
    owner = line.virtual
    if owner:
        raised = _sheet_rise(opened(project), choices)
        line.do(lambda sender: _lay(owner, raised, new_sheet=on_new_sheet(choices)))
    begin(project, line, name, text)
    return machine(line)


@router.post("/grid/go-on")
def go_on_with_grid(cut: OnSheet, project: TheProject, line: TheLine) -> MachineAnswer:
    """Send the marks that are not on the sheet. The machine moves."""
    refuse_unknown_place(line)
    answer = show_grid(project, line)
    if not answer.goes_on:
        raise InputError("no cut broke off that could go on: begin with the first mark")
    refuse_other_machine(project, line)
    taken = taken_marks(project, project.choices)
    go_on(
        project,
        line,
        answer.program,
        answer.text,
        cut,
        paused=_weighing(taken, line.virtual, on_sheet=cut),
    )
    return machine(line)


def _cut_taken(taken: Taken, project: Project, line: MachineLine) -> MachineAnswer:
    """Send the program of a proposal. Who owns a virtual machine hangs weights in its pauses."""
    refuse_way(opened(project), taken.marks)
    owner = line.virtual
    refuse_other_machine(project, line)
    if owner:
        laid = owner
        line.do(lambda sender: _lay(laid, 0.0, new_sheet=False))
    begin(project, line, taken.program, taken.text, paused=_weighing(taken, owner))
    return machine(line)


def _weighing(
    taken: Taken | None, owner: VirtualOwner | None, *, on_sheet: int = 0
) -> Callable[[int], None]:
    """Return what hears of pauses, and lets the sled of a virtual machine weigh what the next mark
    asks that is not on the sheet.
    """
    if taken is None or owner is None:
        return lambda lines: None
    usual = owner.settings.sled_weight
    cut = list(zip(_lines_of_marks(taken.text), taken.marks, strict=True))[on_sheet:]

    def paused(done: int) -> None:
        asked = (mark.sled_weight or usual for lines, mark in cut if lines > done)
        owner.weigh_down(next(asked, usual))

    return paused


@router.post("/machine/readings")
def read_with_tape(
    form: Annotated[str, Body(embed=True)], project: TheProject, line: TheLine
) -> ProjectAnswer:
    """Let the virtual machine's tape fill a form in."""
    owner = line.virtual
    if owner is None:
        raise InputError("a tape reads only the marks of a virtual machine: type what yours says")
    known = {form: project.digest(form)}
    blank = project.read(form)
    if blank is None or BLANK not in blank.decode():
        raise InputError(f"{form}: no mark of it waits for a reading")
    if is_read_again(project, form):
        filled: str | None = owner.tape.fill_again(blank.decode())
    else:
        filled = line.do(lambda sender: owner.tape.fill_when_cut(blank.decode(), owner.machine))
    if filled is None:
        raise InputError("the marks are not all cut yet: cut them first")
    settings = opened(project)
    files = {form: _as_asked(filled, project.path(form), settings, owner)}
    if form.startswith(CHECK):
        project.save(files, read=known)
    else:
        save_choices(project, lambda now: with_marks(now, form), files=files, read=known)
    return show(project)


def _as_asked(filled: str, form: Path, settings: MachineSettings, owner: VirtualOwner) -> bytes:
    """Return what the tape filled in; where distances are asked, these instead of places."""
    blank = read_form(form, sheet=settings.sheet, known=known_effects())
    if not blank.spans:
        return filled.encode()
    lengths = [round(length, 1) for length in owner.tape.lengths(blank.spans)]
    return with_distances(blank, list(zip(blank.spans, lengths, strict=True))).encode()


def _lay(owner: VirtualOwner, raised: float, *, new_sheet: bool) -> None:
    """Another sheet on the virtual machine, or the same: marks that it has are not read again.

    Nothing hangs on the sled, whatever was given up before.
    """
    owner.weigh_down(owner.settings.sled_weight)
    if new_sheet:
        owner.lay_next_sheet(raised=raised)
    owner.tape.pass_over(owner.machine)


def _sheet_rise(settings: MachineSettings, choices: Choices) -> float:
    """Return how far to raise the next sheet [mm]: the last that was cut still lies as the fit saw
    it.
    """
    fitted = settings.fitted
    if fitted is None or not fitted.boards or fitted.boards[-1].marks not in choices.marks[-1:]:
        return 0.0
    return fitted.sheet_rise(settings.sheet_width)


def _marks(plan: Planned, text: str) -> list[GridMark]:
    """Return the marks in the order in which the program cuts them."""
    touches = touches_of(plan.grid, plan.machine)
    lifts = _lines_of_marks(text) or [0] * len(touches)
    return [
        GridMark(name=touch.name, place=(touch.x, touch.y), lines=lines_taken)
        for touch, lines_taken in zip(touches, lifts, strict=True)
    ]


def _lines_of_marks(text: str) -> list[int]:
    """Return how many lines of a program the machine has taken when each mark is cut: with that
    which lifts the bit.
    """
    return [plunge + 1 for plunge in plunges_in(text)]


def _save(project: Project) -> tuple[str, str]:
    """Write program and form; the program's name and text. Raises InputError."""
    choices, digest = read_choices(project)
    settings = opened(project)
    plan = planned(settings, choices.layout, choices.planned)
    refuse_unreachable(plan, settings)
    text = program(plan.grid, plan.machine)
    form, file = next_names(project)
    files = round_files(project, choices, plan, text, form=form, program=file)
    known = {name: project.digest(name) for name in files}
    project.save({**files, **kept_settings(project, choices)}, read={FILE: digest, **known})
    return file, text
