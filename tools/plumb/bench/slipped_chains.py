"""Slips of whole links on the judge's machines: how often the right chain and count are named.

`python -m plumb.bench.slipped_chains 300 --first 1001` prints the table of
docs/commands/recover.md; `--outside 1` hides what no effect of the library does as well.

A machine is hidden, cut, measured and fitted as an owner does it. Then a chain slips, or the
sheet moves, or nothing happens; the owner puts the bit into two marks and asks.
"""

from __future__ import annotations

import argparse
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cache
from itertools import product
from math import cos, sin

import numpy as np

from plumb.bench.boards import BoardCut, TrueMachine, cut, plan
from plumb.bench.causes import MAKER, OUTSIDE
from plumb.bench.hiding import as_bought, usual_machine
from plumb.fit.fit import fit
from plumb.fit.inputs import Inputs
from plumb.job.home import Touch
from plumb.job.slip import CANNOT_TELL, LINK, MOST_LINKS, NO_LINKS, SLIP, Links, find_slip
from plumb.model.predict import lengths, places
from plumb.settings.machine import MachineSettings
from plumb.settings.toml import FitRecord

Array = np.ndarray
FITTED = ("chain_pitch", "chain_stretch")
MARKS = np.array([(-900.0, 250.0), (900.0, -250.0)])  # [mm] where the owner touches
COUNTED = ("boards", "right", "is_open", "false")
HAND = 0.3  # [mm] of a coordinate: how well a bit sits in its hole
TRIES = 6  # steps in which the judge's sled is brought to a hole


@dataclass(frozen=True)
class Mishap:
    """What happens between the marks and their touch."""

    name: str
    links: Links = NO_LINKS
    shift: float = 0.0  # [mm] one sigma of a sheet that moves
    turn: float = 0.0  # [rad] of it
    gap: float = 0.0  # [mm] one sigma by which a motor moves


MISHAPS = (
    *(
        Mishap(f"left {left:+d}, right {right:+d}", (left, right))
        for left, right in product(range(-MOST_LINKS, MOST_LINKS + 1), repeat=2)
        if (left, right) != NO_LINKS
    ),
    Mishap("a link, and the sheet by 3 mm and 1 mrad", (1, 0), shift=3, turn=0.001),
    Mishap("nothing"),
    *(
        Mishap(f"the sheet by {shift:g} mm and {1000 * turn:g} mrad", shift=shift, turn=turn)
        for shift, turn in ((1.0, 0.0005), (3.0, 0.001), (10.0, 0.004), (20.0, 0.008))
    ),
    Mishap("a motor by 3 mm", gap=3.0),
)


@dataclass(frozen=True)
class TouchedMachine:
    """A machine of the judge, with the settings that its owner fitted."""

    board: BoardCut
    settings: MachineSettings
    sheet_rotation: float  # [rad] as fitted


@dataclass(frozen=True)
class SlipCount:
    """How often what was said, for a kind of mishap."""

    name: str
    boards: int
    right: int  # a slip: its chain and count are named; else: no slip is named
    is_open: int  # nothing is named
    false: int  # a slip is named that is not so


@cache
def fitted_machine(number: int, *, noise: float = 0.5, outside: float = 0.0) -> TouchedMachine:
    """Machine `number` of the judge after its first calibration, on 15 marks read to `noise`.

    outside [mm]: the size of a shape in its marks that no effect of the library makes.
    """
    sites, source = plan(5, 3), np.random.default_rng(number)
    hidden = as_bought(usual_machine(source, number, sites), source)
    if outside:
        shape = list(OUTSIDE)[number % len(OUTSIDE)]
        hidden = replace(hidden, outside=shape, outside_mm=outside)
    board = cut(hidden, sites, seed=source, noise=noise)
    model, rows = Inputs(MAKER, board.measurements).model_and_observations()
    fitted = fit(model, rows, effects=FITTED, sigma=noise)
    record = FitRecord(
        start_rms=0.0,
        rms=fitted.rms,
        priced_rms=fitted.corrected_rms,
        left_out_rms=fitted.left_out_rms,
        sheet_rotation=fitted.sheet_rotation,
    )
    settings = replace(fitted.settings, fitted=record)
    return TouchedMachine(board, settings, fitted.sheet_rotation)


def touched(
    machine: TouchedMachine,
    mishap: Mishap,
    source: np.random.Generator,
    *,
    marks: Array = MARKS,
    taped: float | None = None,
) -> tuple[Touch, ...]:
    """Return what an owner writes down who puts the bit into holes that the machine made at
    `marks`.

    taped: the places of the holes are read with a tape of this noise [mm]; else they are where the
    machine was sent.
    """
    true = machine.board.machine
    holes = true.sleds(lengths(machine.settings, marks)[0])
    known = marks if taped is None else holes + taped * source.standard_normal(holes.shape)
    shift = mishap.shift * source.standard_normal(2)
    turn = mishap.turn * source.standard_normal()
    moved = holes @ np.array([[cos(turn), sin(turn)], [-sin(turn), cos(turn)]]) + shift
    sleds = moved + HAND * source.standard_normal(holes.shape)
    gap = true.motor_gap + mishap.gap * source.standard_normal()
    chains = _chains_to(replace(true, motor_gap=gap), machine.settings, sleds)
    chains = chains - LINK * np.array(mishap.links)
    shown = places(machine.settings, chains)[0]
    return tuple(
        Touch(f"{i}", (float(hole[0]), float(hole[1])), (float(where[0]), float(where[1])))
        for i, (hole, where) in enumerate(zip(known, shown, strict=True), 1)
    )


def _chains_to(true: TrueMachine, settings: MachineSettings, sleds: Array) -> Array:
    """Return the chains (n, 2) [mm] on which the judge's sled hangs at places (n, 2) [mm]."""
    chains = aimed = lengths(settings, sleds)[0]
    for _ in range(TRIES):
        chains = chains + aimed - lengths(settings, true.sleds(chains))[0]
    missed = np.abs(true.sleds(chains) - sleds).max()
    if not missed < 1e-3:
        raise ValueError(f"the judge's sled hangs {missed} mm from where it is to be")
    return chains


def count_slips(
    mishap: Mishap,
    boards: Sequence[int],
    *,
    taped: float | None = None,
    marks: Array = MARKS,
    outside: float = 0.0,
) -> SlipCount:
    """Return what is said of a mishap on machines with these numbers."""
    said = [
        find_slip(
            machine.settings,
            touched(machine, mishap, source, marks=marks, taped=taped),
            taped=taped is not None,
        )
        for machine, source in (
            (fitted_machine(number, outside=outside), np.random.default_rng([number, 41]))
            for number in boards
        )
    ]
    named = [finding.best.links for finding in said if finding.verdict == SLIP]
    right = sum(links == mishap.links for links in named)
    if mishap.links == NO_LINKS:
        right = len(said) - len(named)
    return SlipCount(
        name=mishap.name,
        boards=len(said),
        right=right,
        is_open=sum(finding.verdict == CANNOT_TELL for finding in said),
        false=sum(links != mishap.links for links in named),
    )


def _row(count: SlipCount) -> str:
    shares = (100 * each / count.boards for each in (count.right, count.is_open, count.false))
    return f"| {count.name} | " + " | ".join(f"{share:.1f}" for share in shares) + " |"


def _sum(name: str, counts: Sequence[SlipCount]) -> SlipCount:
    totals = [sum(getattr(each, field) for each in counts) for field in COUNTED]
    return SlipCount(name, *totals)


def main(boards: Sequence[int], *, outside: float = 0.0) -> None:
    """Print the rates of every mishap, each on machines with these numbers."""
    counts = {mishap: count_slips(mishap, boards, outside=outside) for mishap in MISHAPS}
    pure = [mishap for mishap in counts if mishap.links != NO_LINKS and not mishap.shift]
    single = [counts[mishap] for mishap in pure if 0 in mishap.links]
    both = [counts[mishap] for mishap in pure if 0 not in mishap.links]
    harmless = [counts[mishap] for mishap in counts if mishap.links == NO_LINKS]
    print(f"{len(boards)} machines for each mishap; %\n")
    print("| mishap | right | cannot tell | false slip |\n|---|---|---|---|")
    print(_row(_sum("a chain slips by 1 to 3 links, either way", single)))
    print(_row(_sum("both chains slip, by 1 to 3 links each", both)))
    for mishap, count in counts.items():
        if mishap not in pure:
            print(_row(count))
    worst = min((counts[mishap] for mishap in pure), key=lambda count: count.right)
    print(f"\nThe worst of the {len(pure)} slips: {worst.name}, {_row(worst)}")
    for name, group in (("slips", [*single, *both]), ("harmless mishaps", harmless)):
        total = _sum(name, group)
        print(f"False slips: {total.false} of {total.boards} {name}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description="How often a slip is named, and rightly.")
    parser.add_argument("machines", type=int)
    parser.add_argument("--first", type=int, default=1, help="number of the first machine [1]")
    parser.add_argument(
        "--outside", type=float, default=0.0, help="[mm] of what no effect does [0]"
    )
    given = parser.parse_args()
    main(range(given.first, given.first + given.machines), outside=given.outside)
