"""Rounds of marks: written into the folder, cut, gone on with, and read by a virtual tape.

The marks of the chosen layout, those that the verdict proposed and two proof marks go the same way.
"""

from collections.abc import Callable
from dataclasses import dataclass, replace
from typing import Annotated, Literal

from fastapi import APIRouter, Body

from plumb.grid import BLANK
from plumb.job.dry_run import timetable
from plumb.lab.broken_cut import HowFar, OnSheet, begin, how_far, plunges_in
from plumb.lab.machine_line import MachineLine, TheLine, refuse_other_machine, refuse_unknown_place
from plumb.lab.project import Choices, Project, save_choices, with_marks
from plumb.lab.rounds import RoundToCut, chosen_round, is_proof, is_read_again, opened, proof_round
from plumb.lab.routes.machine import MachineAnswer, machine
from plumb.lab.routes.project import ProjectAnswer, TheProject, show
from plumb.line.sender import Wait, cleaned, waits_in
from plumb.settings import MachineSettings
from plumb.text.errors import InputError
from plumb.vm.garage import VirtualOwner
from plumb.words import Heading
from plumb.words import round as words

router = APIRouter(tags=["rounds"])
Which = Literal["marks", "proof"]


@dataclass(frozen=True, kw_only=True)
class RoundAnswer(RoundToCut, HowFar):
    """A round of marks, the program that cuts it, and whether that broke off."""

    heading: Heading
    begins: str  # how the button begins that cuts it from the first mark
    ended: str  # how the last cut ended, in a sentence or two; empty: none did
    is_saved: bool  # its files are in the folder as they would be written now
    files_said: str
    lines: tuple[int, ...]  # of the program that the machine has taken when each mark is cut
    waits: int  # marks of the form that wait for a reading
    last_form: str  # the newest with readings; empty if there is none
    next_sheet: str  # how the next sheet lies, as the fit says
    pauses: tuple[Wait, ...]  # where the program waits for somebody
    # [min] from the start until so many lines are done; empty without a machine's numbers
    done_at: tuple[float, ...]


@router.get("/rounds/{which}")
def show_round(which: Which, project: TheProject, line: TheLine) -> RoundAnswer:
    """Return the marks to be cut next, as they would be written now; proof marks that are in the
    folder as they are there.
    """
    return round_answer(_round(which, project), project, line)


def _round(which: Which, project: Project, *, anew: bool = False) -> RoundToCut:
    return proof_round(project, anew=anew) if which == "proof" else chosen_round(project)


def round_answer(this: RoundToCut, project: Project, line: MachineLine) -> RoundAnswer:
    """Return a round as the page shows it."""
    choices, blank = project.choices, project.read(this.form)
    lines = _lines_of_marks(this)
    pauses = tuple(waits_in(this.text.splitlines()))
    far = how_far(project, line, this.program, this.text)
    # What is to be done in a pause is asked again: nothing goes on where one is between two marks.
    is_between = any(lines[0] <= wait.lines < lines[-1] for wait in pauses)
    far = replace(far, goes_on=far.goes_on and not is_between)
    is_saved = this.is_in(project)
    rise = _sheet_rise(opened(project), choices)
    return RoundAnswer(
        **vars(this),
        **vars(far),
        heading=words.what_is_cut(len(this.marks), this.origin),
        begins=_begins(this, far, line),
        ended=_ended(this, far, line),
        is_saved=is_saved,
        files_said=words.of_files(this.program, this.form, is_saved=is_saved),
        lines=tuple(lines),
        waits=blank.decode(errors="replace").count(BLANK) if blank else 0,
        last_form=choices.marks[-1] if choices.marks else "",
        next_sheet=words.next_sheet(rise, choices.unit, is_virtual=bool(line.virtual)),
        pauses=pauses,
        done_at=_done_at(line, this.text),
    )


def _ended(this: RoundToCut, far: HowFar, line: MachineLine) -> str:
    """Return how the last cut ended, and what can be done if it broke off; empty if none ended."""
    ran, cut, names = line.state.program, far.broke_off, [mark.name for mark in this.marks]
    outcome = ran.outcome if ran and ran.title == this.program else ""
    if cut is None:
        return words.ended(outcome, "")
    broken = words.how_far(cut, cut + far.perhaps, names)
    if cut == len(names):
        return broken
    then = words.begin_or_go_on(
        this.origin,
        is_virtual=bool(line.virtual),
        is_connected=bool(line.name) and line.state.phase != "lost",
        goes_on=far.goes_on,
        next_mark="" if far.perhaps else names[cut],
    )
    return words.ended(outcome, f"{broken} {then}")


def _begins(this: RoundToCut, far: HowFar, line: MachineLine) -> str:
    if far.broke_off is None:
        return "Move"
    cut = far.broke_off + far.perhaps > 0
    return words.beginning(this.origin, may_be_twice=cut and not line.virtual)


def _done_at(line: MachineLine, text: str) -> tuple[float, ...]:
    """Return when the lines of a program are done, as the connected machine runs it dry."""
    numbers, place = line.state.numbers, line.state.place or (0.0, 0.0, 5.0)
    lines = list(cleaned(text.splitlines()))
    times = timetable(numbers, lines, place) if numbers and lines else None
    return tuple(round(float(seconds) / 60, 2) for seconds in times.done_at) if times else ()


@router.post("/rounds/{which}")
def save_round(which: Which, project: TheProject) -> ProjectAnswer:
    """Write the program and a form for its marks into the folder."""
    _round(which, project, anew=True).save(project)
    return show(project)


@router.post("/rounds/{which}/cut")
def cut_round(which: Which, project: TheProject, line: TheLine) -> MachineAnswer:
    """Write both, and send the program. The machine moves."""
    refuse_unknown_place(line)
    this = _round(which, project, anew=True)
    refuse_other_machine(project, line, this.cut_with)
    this.save(project)
    owner = line.virtual
    if owner:
        raised = _sheet_rise(opened(project), project.choices)
        line.do(lambda sender: _lay(owner, raised, new_sheet=this.new_sheet))
    begin(project, line, this.program, this.text, paused=_weighing(this, owner))
    return machine(line)


@router.post("/rounds/{which}/go-on")
def go_on_with_round(
    which: Which, cut: OnSheet, project: TheProject, line: TheLine
) -> MachineAnswer:
    """Send the marks that are not on the sheet. The machine moves."""
    refuse_unknown_place(line)
    this = _round(which, project)
    if not round_answer(this, project, line).goes_on:
        raise InputError("no cut broke off that could go on: begin with the first mark")
    refuse_other_machine(project, line, this.cut_with)
    paused = _weighing(this, line.virtual, on_sheet=cut)
    begin(project, line, this.program, this.text, on_sheet=cut, paused=paused)
    return machine(line)


def _lines_of_marks(this: RoundToCut) -> list[int]:
    """Return how many lines of the program the machine has taken when each mark is cut: with that
    which lifts the bit; 0 for each mark of a form that has another program.
    """
    lines = [plunge + 1 for plunge in plunges_in(this.text)]
    return lines if len(lines) == len(this.marks) else [0] * len(this.marks)


def _weighing(
    this: RoundToCut, owner: VirtualOwner | None, *, on_sheet: int = 0
) -> Callable[[int], None]:
    """Return what hears of pauses, and lets the sled of a virtual machine weigh what the next mark
    asks that is not on the sheet.
    """
    if owner is None:
        return lambda lines: None
    usual = owner.settings.sled_weight
    cut = list(zip(_lines_of_marks(this), this.marks, strict=True))[on_sheet:]

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
    files = {form: filled.encode()}
    if is_proof(form):
        project.save(files, read=known)
    else:
        save_choices(project, lambda now: with_marks(now, form), files=files, read=known)
    return show(project)


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
