"""The distances that are taped between the marks of a grid."""

from __future__ import annotations

from collections.abc import Sequence

from plumb.grid.limits import demand
from plumb.grid.options import Grid
from plumb.text.readers import to_do

Cell = tuple[int, int]  # row and column
ASKED = "# Lay the tape between these marks, in this order: "


def spans_of(grid: Grid) -> list[tuple[str, str]]:
    """Names of marks: the sides and diagonals of the grid, and from its middle what halves them."""
    plain = grid.pattern == "grid" and not grid.places
    option = to_do("--distances is", page="distances are")
    demand(plain, f"{option} for marks in columns and rows: leave that out")
    end, bottom = grid.columns - 1, grid.rows - 1
    top_left, top_right, bottom_right, bottom_left = (0, 0), (0, end), (bottom, end), (bottom, 0)
    spans = [(top_left, top_right), (top_right, bottom_right), (bottom_right, bottom_left)]
    spans += [(bottom_left, top_left), (top_left, bottom_right), (top_right, bottom_left)]
    if end % 2 == 0 and bottom % 2 == 0:
        across, down = end // 2, bottom // 2
        top, middle, left, right = (0, across), (down, across), (down, 0), (down, end)
        spans += [(top, (bottom, across)), (left, right), (top_left, top)]
        spans += [(left, middle), (middle, right), (top, middle)]

    def name(cell: Cell) -> str:
        return str(cell[0] * grid.columns + cell[1] + 1)

    return [(name(first), name(second)) for first, second in spans]


def spans_line(spans: Sequence[tuple[str, str]]) -> str:
    """The line of a form's head that says between which marks a tape is laid."""
    return ASKED + ", ".join(f"{first} - {second}" for first, second in spans)


def spans_in(head: Sequence[str]) -> list[tuple[str, str]]:
    """The spans that the lines of a form's head ask for, in their order."""
    pairs = [
        pair.split(" - ")
        for line in head
        if line.startswith(ASKED)
        for pair in line[len(ASKED) :].split(", ")
    ]
    return [(pair[0], pair[1]) for pair in pairs if len(pair) == 2]
