"""The marks of a grid in the order in which they are made, and the stops on the way to them."""

from __future__ import annotations

from typing import NamedTuple

from plumb.grid.benchmark_pattern import benchmark_places
from plumb.grid.limits import check_numbers
from plumb.grid.options import Grid, PlainMachine


class Touch(NamedTuple):
    """A touch of the bit at x, y [mm]; the same name with visit 1, 2, ... is a repeat."""

    name: str
    x: float
    y: float
    visit: int

    def __str__(self) -> str:
        return f"mark {self.name}{' again' if self.visit else ''}"


def touches_of(grid: Grid, machine: PlainMachine) -> list[Touch]:
    """Every touch in the order in which it is made; names count by rows from the top left."""
    check_numbers(grid, machine)
    if grid.pattern == "benchmark":
        return [Touch(*place, 0) for place in benchmark_places()]
    if grid.places:
        return [Touch(str(i), x, y, 0) for i, (x, y) in enumerate(grid.places, start=1)]
    width = machine.sheet_width - 2 * grid.margin
    height = machine.sheet_height - 2 * grid.margin
    places = _places(grid)
    first = {}
    for row, column in places:
        # Whole tenths: program, comment and list say the same number. Adding 0 turns -0 into 0.
        x = round(width * (column / (grid.columns - 1) - 0.5), 1) + 0.0
        y = round(height * (0.5 - row / (grid.rows - 1)), 1) + 0.0
        first[row, column] = Touch(str(row * grid.columns + column + 1), x, y, 0)
    touches = list(first.values())
    for visit in range(1, grid.repeats + 1):
        # Backwards every other time: what the lead-in fails to forget then shows as noise.
        for row, column in places[::-1] if visit % 2 else places:
            mark = first[row, column]
            shift = visit * grid.repeat_spacing * (-1 if mark.x > 0 else 1)
            if _is_extreme(grid, row, column):
                touches.append(mark._replace(x=round(mark.x + shift, 1), visit=visit))
    return touches


def listed(touches: list[Touch]) -> list[Touch]:
    """The touches as an owner looks for them: by their names, a repeat after its mark."""
    if not all(touch.name.isdigit() for touch in touches):
        return touches
    return sorted(touches, key=lambda touch: (int(touch.name), touch.visit))


def _places(grid: Grid) -> list[tuple[int, int]]:
    """Pairs of row and column in the order of the visit."""
    rows, columns = range(grid.rows), range(grid.columns)
    if grid.order == "columns":
        return [(row, column) for column in columns for row in rows]
    turned = grid.order == "snake"
    return [(row, column) for row in rows for column in columns[:: -1 if turned and row % 2 else 1]]


def _is_extreme(grid: Grid, row: int, column: int) -> bool:
    """True for corners and for the middle of an edge that has a mark there (1; ends: 0, 2)."""
    across, down = 2 * column / (grid.columns - 1), 2 * row / (grid.rows - 1)
    return across in (0, 1, 2) and down in (0, 1, 2) and (across, down) != (1, 1)


def lead_in(grid: Grid, mark: Touch) -> tuple[float, float]:
    """x, y [mm] from which the sled travels straight into the mark."""
    return mark.x - grid.approach[0], mark.y - grid.approach[1]


def stops_of(grid: Grid, machine: PlainMachine) -> list[tuple[str, tuple[float, float]]]:
    """Names and places [mm] of all ends of sideways moves."""
    stops: list[tuple[str, tuple[float, float]]] = []
    for mark in touches_of(grid, machine):
        stops += [(f"the lead-in of {mark}", lead_in(grid, mark)), (str(mark), (mark.x, mark.y))]
    return [("the start", (0.0, 0.0)), *stops, ("the end", (0.0, 0.0))]
