"""The closed loop: cut, compare, diagnose, measure what is proposed, add, cut again.

The owner follows the lab's advice and nothing else.
"""

from __future__ import annotations

import tempfile
from collections.abc import Callable
from dataclasses import dataclass, replace
from pathlib import Path

from plumb.cure.add import Addition
from plumb.cure.auto import AutoAddition, add_auto
from plumb.diagnosis import Checked, Diagnosis, diagnose
from plumb.fit.compare import Comparison, compare
from plumb.fit.inputs import Inputs
from plumb.grid.options import Grid
from plumb.line.sender import cleaned
from plumb.marks.join import join_measurements
from plumb.marks.read import Measurements, read_marks
from plumb.plan import Proposal, propose
from plumb.vm.owner import VirtualOwner

ROUNDS = 2  # times that the owner measures what is proposed
DOABLE = ("marks", "weight", "approach", "check", "frame")  # what this owner can carry out


@dataclass(frozen=True)
class Loop:
    """What came of a closed loop."""

    owner: VirtualOwner
    forms: tuple[str, ...]  # what was read, as files of marks: the first sheet, the last one
    before: Comparison  # the first sheet, with the owner's first settings
    first: Diagnosis
    done: tuple[Proposal, ...]  # what was measured besides
    auto: AutoAddition
    after: Comparison | None  # the second sheet; None where nothing could be added

    @property
    def addition(self) -> Addition:
        """What was fitted."""
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
    said: Callable[[str], None] = lambda sentence: None,
    progress: Callable[[float], None] = lambda share: None,
) -> Loop:
    """Go once round; `said` hears what happens, `progress` the share of the cutting so far."""
    cut = _Cutting(owner, grid, progress)
    said("The machine cuts a first grid.")
    owner.switch_on()
    forms = [cut.next()]
    board = _read(owner, forms[0])
    inputs = Inputs(owner.settings, board)
    before, first = compare(owner.settings, board), diagnose(inputs)
    inputs, done = _measured_more(owner, inputs, first, said)
    auto = add_auto(inputs)
    after = None
    if auto.addition:
        said("The new numbers go to the machine, and it cuts the grid again on another sheet.")
        owner.send(auto.addition.settings)
        owner.lay_new_sheet(owner.garage.seed + 1, raised=auto.addition.sheet_rise)
        forms.append(cut.next())
        after = compare(owner.settings, _read(owner, forms[-1]))
    progress(1.0)
    return Loop(owner, tuple(forms), before, first, done, auto, after)


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
    owner: VirtualOwner, inputs: Inputs, first: Diagnosis, said: Callable[[str], None]
) -> tuple[Inputs, tuple[Proposal, ...]]:
    """The inputs with what was proposed, as long as the marks leave a question open."""
    diagnosis = first
    done: tuple[Proposal, ...] = ()
    while diagnosis.verdict == "cannot_tell" and len(done) < ROUNDS:
        best = _best(propose(diagnosis, inputs).proposals, done)
        if best is None:
            break
        said(f"The marks cannot tell. The owner measures: {best.option.title}.")
        done = (*done, best)
        inputs = _with(owner, inputs, best)
        diagnosis = diagnose(inputs)
    return inputs, done


def _best(proposals: tuple[Proposal, ...], done: tuple[Proposal, ...]) -> Proposal | None:
    """The best proposal that this owner can carry out and has not yet."""
    titles = {proposal.option.title for proposal in done}
    for proposal in proposals:
        option = proposal.option
        if option.kind in DOABLE and option.title not in titles and not option.visits.swapped.any():
            return proposal
    return None


def _with(owner: VirtualOwner, inputs: Inputs, proposal: Proposal) -> Inputs:
    """The inputs with what a proposal brought."""
    option, checked = proposal.option, tuple[Checked, ...]()
    if option.checks:
        checked = tuple(owner.check(option.checks))
    if len(option.visits):
        more = _read(owner, owner.carry_out(option.visits))
        inputs = replace(inputs, measurements=join_measurements([inputs.measurements, more]))
    return replace(inputs, checked=(*inputs.checked, *checked))


def _read(owner: VirtualOwner, form: str) -> Measurements:
    """The filled form as the lab reads it."""
    with tempfile.TemporaryDirectory() as folder:
        path = Path(folder, "marks.toml")
        path.write_text(form)
        return read_marks(path, sheet=owner.settings.sheet)
