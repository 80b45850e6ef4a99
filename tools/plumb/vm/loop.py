"""The closed loop: cut, compare, diagnose, measure what is proposed, add, cut again.

The owner follows the lab's advice and nothing else.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from plumb.cure.add import Addition
from plumb.cure.decision import Decision, decide
from plumb.diagnosis import Checked, Diagnosis, diagnose
from plumb.fit.compare import Comparison, compare
from plumb.fit.inputs import Inputs
from plumb.grid.options import Grid
from plumb.line.sender import RefusedError, cleaned
from plumb.marks.read import Mark, Measurements, join_measurements, read_marks
from plumb.plan import Proposal, propose
from plumb.settings.machine import MachineSettings
from plumb.vm.owner import VirtualOwner

ROUNDS = 2  # times that the owner measures what is proposed
# What this owner can carry out.
DOABLE = ("marks", "weight", "approach", "check", "frame", "near", "reread")
MOST_HUNG = 60.0  # [N] that this owner hangs on the sled
OPEN = ("cannot_tell", "slip", "not_in_library")  # verdicts after which more is measured


@dataclass(frozen=True)
class Loop:
    """Result of a closed loop."""

    owner: VirtualOwner
    forms: tuple[str, ...]  # what was read, as files of marks: the first sheet, the last sheet
    before: Comparison  # the first sheet, with the owner's first settings
    first: Diagnosis
    inputs: Inputs  # all that was measured
    done: tuple[Proposal, ...]  # what else was measured
    auto: Decision
    after: Comparison | None  # the second sheet; None where nothing could be added

    @property
    def addition(self) -> Addition:
        """Fitted effects."""
        assert self.auto.addition is not None
        return self.auto.addition

    @property
    def promised(self) -> float:
        """[mm] RMS that the fit expects at marks that took no part."""
        return self.addition.after.left_out_rms

    @property
    def left(self) -> float | None:
        """[mm] RMS at the marks of the second sheet, none of which took part in the fit."""
        return self.after.rms if self.after else None


def closed_loop(
    owner: VirtualOwner,
    *,
    grid: Grid,
    progress: Callable[[float], None] = lambda share: None,
) -> Loop:
    """Go once round; `progress` hears the share of the cutting so far."""
    cut = _Cutting(owner, grid, progress)
    owner.switch_on()
    forms = [cut.next()]
    board = read(owner, forms[0])
    inputs = Inputs(owner.settings, board)
    before, first = compare(Inputs(owner.settings, board)), diagnose(inputs)
    inputs, done = _measured_more(owner, inputs, first)
    auto = decide(inputs)
    after = None
    if auto.addition:
        lay_next_sheet(owner, auto.addition.settings, raised=auto.addition.sheet_rise)
        forms.append(cut.next())
        after = compare(Inputs(owner.settings, read(owner, forms[-1])))
    progress(1.0)
    return Loop(owner, tuple(forms), before, first, inputs, done, auto, after)


def lay_next_sheet(owner: VirtualOwner, settings: MachineSettings, *, raised: float) -> None:
    """Send new settings, and lay the second sheet on the stops, the right stop `raised` [mm]."""
    owner.send(settings)
    owner.lay_new_sheet(owner.garage.seed + 1, raised=raised)


class _Cutting:
    """The two sheets of a loop, with the share of both that is done."""

    def __init__(self, owner: VirtualOwner, grid: Grid, progress: Callable[[float], None]) -> None:
        self._owner, self._grid, self._progress = owner, grid, progress
        self._lines = 2 * len(list(cleaned(owner.grid_program(grid)[0])))
        self._done = 0

    def next(self) -> str:
        """Cut a sheet: its form, filled."""
        before = self._done

        def answered(lines: int) -> None:
            self._done = before + lines
            self._progress(self._done / self._lines)

        return self._owner.cut_grid(self._grid, answered=answered)


def _measured_more(
    owner: VirtualOwner, inputs: Inputs, first: Diagnosis
) -> tuple[Inputs, tuple[Proposal, ...]]:
    """Return the inputs with what was proposed, as long as the marks leave a question open."""
    diagnosis, usual = first, owner.settings.sled_weight
    done: tuple[Proposal, ...] = ()
    while diagnosis.verdict in OPEN and len(done) < ROUNDS:
        best = _best(propose(diagnosis, inputs).proposals, done, usual)
        if best is None:
            break
        done, inputs = (*done, best), _with(owner, inputs, best)
        diagnosis = diagnose(inputs)
    return inputs, done


def _best(
    proposals: tuple[Proposal, ...], done: tuple[Proposal, ...], usual_weight: float
) -> Proposal | None:
    """Return the best proposal that this owner can carry out and has not yet."""
    titles = {proposal.option.title for proposal in done}
    for proposal in proposals:
        if proposal.option.title not in titles and _is_doable(proposal, usual_weight):
            return proposal
    return None


def _is_doable(proposal: Proposal, usual_weight: float) -> bool:
    """Return whether this owner can carry it out."""
    visits = proposal.option.visits
    is_light = not len(visits) or visits.sled_weights.max() < usual_weight + MOST_HUNG
    return proposal.option.kind in DOABLE and is_light


def _with(owner: VirtualOwner, inputs: Inputs, proposal: Proposal) -> Inputs:
    """Return the inputs with what a proposal brought."""
    option, checked = proposal.option, tuple[Checked, ...]()
    if option.kind == "reread":
        marks = inputs.measurements
        for name in option.visits.names:
            marks = _read_again(owner, marks, name)
        return replace(inputs, measurements=marks)
    if option.checks:
        checked = tuple(owner.check(option.checks))
    if len(option.visits):
        try:
            more = read(owner, owner.carry_out(option.visits))
        except RefusedError:
            # The machine halted; the round at it was for nothing.
            owner.restart()
            return inputs
        inputs = replace(inputs, measurements=join_measurements([inputs.measurements, more]))
    return replace(inputs, checked=(*inputs.checked, *checked))


def _read_again(owner: VirtualOwner, measurements: Measurements, name: str) -> Measurements:
    """Return the measurements with new readings of a mark in the place of the old."""
    new = iter(owner.tape.read_again(name))
    marks: list[Mark] = [
        replace(mark, measured=next(new)) if mark.name == name else mark
        for mark in measurements.marks
    ]
    return replace(measurements, marks=tuple(marks))


def read(owner: VirtualOwner, form: str) -> Measurements:
    """Return the filled form as the lab reads it."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "marks.toml")
        path.write_text(form)
        return read_marks(path, sheet=owner.settings.sheet)
