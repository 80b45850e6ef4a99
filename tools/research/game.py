"""A game that the lab's advice plays: something is hidden, and the closed loop looks for it."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from plumb.bench.causes import Hidden
from plumb.cure.add import Addition, add
from plumb.cure.auto import AutoAddition
from plumb.fit.compare import Comparison, compare
from plumb.fit.inputs import Inputs
from plumb.grid.options import Grid
from plumb.settings.machine import MachineSettings
from plumb.vm.garage import Garage, described, random_garage, sled_error
from plumb.vm.loop import Budget, Loop, closed_loop, lay_next_sheet, read, shape
from plumb.vm.owner import FRICTION_NAME, VirtualOwner

ALWAYS = (FRICTION_NAME.partition(".")[0],)  # effects that every virtual machine has


@dataclass(frozen=True)
class SledError:
    """RMS [mm] of the sled's error all over the sheet, the sheet laid at its best."""

    before: float  # by the settings as they were
    frame: float  # by a fit of the frame alone
    after: float  # by the settings that were chosen
    known: float  # by a fit with what is hidden


@dataclass(frozen=True)
class Played:
    """What came of a game."""

    row: str  # the level or the kind, with the marks of the first sheet
    seed: int
    hidden: str
    verdict: str  # the last
    claimed: tuple[str, ...]  # effects that the lab added without a rival
    chosen: tuple[str, ...]  # effects that it added
    solved: bool  # what was hidden, and nothing else, is what was added or reported
    false: int  # claims of what is not there
    marks: int  # cut on the first sheet
    minutes: float  # until the machine was changed
    sled_before: float  # [mm] RMS all over the sheet, without noise
    sled_frame: float
    sled_after: float
    sled_known: float
    cut_before: float  # [mm] RMS of the first sheet as it was read, laid at its best
    cut_after: float  # of the second sheet
    cut_known: float  # of the second sheet, had the truth been known


def play(
    row: str,
    hidden: Hidden,
    *,
    seed: int,
    grid: Grid,
    budget: Budget,
    elf: str | None = None,
    progress: Callable[[float], None] = lambda share: None,
) -> Played:
    """Play by the lab's advice, then look at the truth."""
    owner = VirtualOwner(random_garage(hidden, seed), elf=elf)
    garage = owner.garage
    loop = closed_loop(owner, grid=grid, budget=budget, progress=progress)
    chosen, claimed = chosen_in(loop.auto), claimed_in(loop.auto)
    settings = loop.addition.settings if loop.auto.addition else loop.inputs.settings
    errors = sled_errors(loop.inputs, garage, settings)
    return Played(
        row,
        seed,
        described(hidden),
        loop.auto.diagnosis.verdict,
        claimed,
        chosen,
        is_solved(hidden, loop.auto),
        len({*claimed} - {*hidden.effects}),
        loop.spent.marks,
        loop.spent.minutes,
        errors.before,
        errors.frame,
        errors.after,
        errors.known,
        shape(loop.before),
        shape(loop.after or loop.before),
        shape(_cut_with_truth(loop, grid)),
    )


def chosen_in(auto: AutoAddition) -> tuple[str, ...]:
    """Return the effects that were added, but for those that every machine has."""
    return tuple(name for name in auto.chosen if name not in ALWAYS)


def claimed_in(auto: AutoAddition) -> tuple[str, ...]:
    """Return those of them that nothing speaks against: no rival, and nothing left that is
    unknown.
    """
    unsure = auto.rivals or auto.diagnosis.verdict in ("not_in_library", "slip")
    return () if unsure else chosen_in(auto)


def is_solved(hidden: Hidden, auto: AutoAddition) -> bool:
    """Return whether the right thing was said: for what no effect explains, that it is such a
    thing.
    """
    if hidden.outside:
        return auto.diagnosis.verdict == "not_in_library"
    return {*chosen_in(auto)} == {*hidden.effects} and auto.addition is not None


def _cut_with_truth(loop: Loop, grid: Grid) -> Comparison:
    """Return the second sheet as it is cut by somebody who knows what is hidden.

    Where the lab added just that, it is the sheet that was cut.
    """
    owner = loop.owner
    known = with_truth(loop.inputs, owner.garage)
    if loop.after and loop.addition.settings == known.settings:
        return loop.after
    fresh = owner.again()
    lay_next_sheet(fresh, known.settings, raised=known.sheet_rise)
    return compare(Inputs(fresh.settings, read(fresh, fresh.cut_grid(grid))))


def with_truth(inputs: Inputs, garage: Garage) -> Addition:
    """Return the fit of somebody who knows what is hidden."""
    return add(inputs, effects=garage.hidden.effects)


def sled_errors(inputs: Inputs, garage: Garage, settings: MachineSettings) -> SledError:
    """Return what settings are worth, against what the same marks allow."""
    frame, known = add(inputs, effects=()).settings, with_truth(inputs, garage).settings
    each = (inputs.settings, frame, settings, known)
    return SledError(*(sled_error(garage, machine) for machine in each))
