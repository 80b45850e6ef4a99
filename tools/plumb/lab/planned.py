"""The marks of a layout that somebody chose, as a grid that can be cut and as a plan to look at."""

from __future__ import annotations

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace

from plumb import _core
from plumb.grid import Grid, PlainMachine, marks_list, spans_of, touches_of
from plumb.grid.cut_with import cut_with_lines
from plumb.grid.pattern import Touch
from plumb.lab.choices import Layout
from plumb.marks.read import Distance, Mark, Measurements
from plumb.model.reach import refuse_way, with_soft_chains
from plumb.plan.options import MARK, READING, ROUND
from plumb.settings.machine import MachineSettings
from plumb.vm.owner import plain_machine

BAND = 150.0  # [mm] marks that lie so near in height are cut side by side
Place = tuple[float, float]


@dataclass(frozen=True)
class Kind:
    """A way to measure."""

    title: str
    columns: int
    rows: int
    is_taped: bool = False  # distances between marks instead of places on the sheet


KINDS: dict[Layout, Kind] = {
    "nine": Kind("Nine marks", 3, 3),
    "fifteen": Kind("Fifteen marks", 5, 3),
    "twenty-five": Kind("Twenty-five marks", 5, 5),
    "distances": Kind("Distances between nine marks", 3, 3, is_taped=True),
}


@dataclass(frozen=True)
class Planned:
    """The marks of a layout on a machine's sheet."""

    grid: Grid
    machine: PlainMachine
    touches: tuple[Touch, ...]
    spans: tuple[tuple[str, str], ...]  # names of marks between which a tape is laid

    @property
    def minutes(self) -> float:
        """How long it takes to cut and read them."""
        read = READING * len(self.spans)
        return ROUND + MARK * len(self.touches) + read

    def form(self, path: str, *, settings: str, new_sheet: bool = False) -> str:
        """The form at that path that waits for readings of marks cut with these settings."""
        named = cut_with_lines(settings, path)
        return marks_list(self.grid, self.machine, named, new_sheet=new_sheet, spans=self.spans)

    def words(self) -> list[str]:
        """What `plumb grid` is given for these marks."""
        if self.grid.places:
            places = " ".join(f"{x:.12g},{y:.12g}" for x, y in self.grid.places)
            return [f"--places={places}"]
        size = ["--columns", f"{self.grid.columns}", "--rows", f"{self.grid.rows}"]
        return [*size, "--repeats", "0", *["--distances"] * bool(self.spans)]

    def as_measured(self) -> Measurements:
        """The plan as if all were read just where it was sent."""
        side = self.grid.approach
        sent = {touch.name: (touch.x, touch.y) for touch in self.touches}
        marks = tuple(
            Mark(name, place, None if self.spans else place, approach=side)
            for name, place in sent.items()
        )
        distances = tuple(
            Distance((first, second), math.dist(sent[first], sent[second]))
            for first, second in self.spans
        )
        return Measurements(marks, distances=distances, source="the plan")


def planned(settings: MachineSettings, layout: Layout, places: Sequence[Place]) -> Planned:
    """The marks of a layout; `places` [mm] are those of the layout "own". Raises GridError."""
    machine = plain_machine(settings)
    kind = KINDS.get(layout)
    if kind:
        grid = Grid(columns=kind.columns, rows=kind.rows, repeats=0)
    else:
        grid = Grid(repeats=0, places=tuple(in_turn(places)))
    touches = tuple(sorted(touches_of(grid, machine), key=lambda touch: int(touch.name)))
    is_taped = kind is not None and kind.is_taped
    return Planned(grid, machine, touches, tuple(spans_of(grid)) if is_taped else ())


def refuse_unreachable(plan: Planned, settings: MachineSettings) -> None:
    """Raise GridError or InputError if the sled cannot take the way to all marks."""
    soft = with_soft_chains(replace(settings.as_plumb_model()))[0]
    refuse_way(plan.grid, plan.machine, soft, most_give=_core.reach_limits()["most_give"])


def in_turn(places: Sequence[Place]) -> list[Place]:
    """Places in an order that makes the way short: in bands from the top, there and back."""
    rows: list[list[Place]] = []
    for place in sorted(places, key=lambda place: -place[1]):
        if rows and rows[-1][0][1] - place[1] < BAND:
            rows[-1].append(place)
        else:
            rows.append([place])
    return [
        place
        for index, row in enumerate(rows)
        for place in sorted(row, key=lambda place: place[0] * (-1 if index % 2 else 1))
    ]
