"""Where the marks of a grid are, and the way of the sled to them."""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from plumb.grid.options import (
    APPROACH,
    MAX_TENSION,
    MIN_FREE_CHAIN,
    MIN_TENSION,
    REPEAT_SPACING,
    Grid,
    PlainMachine,
    check_numbers,
    demand,
)
from plumb.text.errors import to_do


class Touch(NamedTuple):
    """A touch of the bit at x, y [mm]; the same name with visit 1 is a repeat."""

    name: str
    x: float
    y: float
    visit: int

    def __str__(self) -> str:
        return f"mark {self.name}{' again' if self.visit else ''}"


def touches_of(grid: Grid, machine: PlainMachine) -> list[Touch]:
    """Return every touch in the order in which it is made; names count by rows from the top
    left.
    """
    check_numbers(grid, machine)
    if grid.places:
        return [Touch(str(i), x, y, 0) for i, (x, y) in enumerate(grid.places, start=1)]
    width = machine.sheet_width - 2 * grid.margin
    height = machine.sheet_height - 2 * grid.margin
    first = {}
    for row in range(grid.rows):
        for column in range(grid.columns)[:: -1 if row % 2 else 1]:
            # Whole tenths: program, comment and list say the same number. 0 turns -0 into 0.
            x = round(width * (column / (grid.columns - 1) - 0.5), 1) + 0.0
            y = round(height * (0.5 - row / (grid.rows - 1)), 1) + 0.0
            first[row, column] = Touch(str(row * grid.columns + column + 1), x, y, 0)
    touches = list(first.values())
    # Backwards: what the lead-in fails to forget then shows as noise.
    for row, column in reversed(first if grid.repeats else {}):
        mark = first[row, column]
        shift = REPEAT_SPACING * (-1 if mark.x > 0 else 1)
        if _is_extreme(grid, row, column):
            touches.append(mark._replace(x=round(mark.x + shift, 1), visit=1))
    return touches


def listed(touches: list[Touch]) -> list[Touch]:
    """Return the touches as an owner looks for them: by their names, a repeat after its mark."""
    return sorted(touches, key=lambda touch: (int(touch.name), touch.visit))


def _is_extreme(grid: Grid, row: int, column: int) -> bool:
    """Return whether it is a corner, or the middle of an edge that has a mark there (1; ends: 0,
    2).
    """
    across, down = 2 * column / (grid.columns - 1), 2 * row / (grid.rows - 1)
    return across in (0, 1, 2) and down in (0, 1, 2) and (across, down) != (1, 1)


def lead_in(mark: Touch) -> tuple[float, float]:
    """x, y [mm] from which the sled travels straight into the mark."""
    return mark.x - APPROACH[0], mark.y - APPROACH[1]


def stops_of(grid: Grid, machine: PlainMachine) -> list[tuple[str, tuple[float, float]]]:
    """Return names and places [mm] of all ends of sideways moves."""
    stops: list[tuple[str, tuple[float, float]]] = []
    for mark in touches_of(grid, machine):
        stops += [(f"the lead-in of {mark}", lead_in(mark)), (str(mark), (mark.x, mark.y))]
    return [("the start", (0.0, 0.0)), *stops, ("the end", rest_after(touches_of(grid, machine)))]


UNDER = 260.0  # [mm] around the bit: what is nearer lies under the sled, and no tape reaches it
RASTER = 50.0  # [mm] between places that are looked at


def rest_after(marks: Sequence[Touch]) -> tuple[float, float]:
    """x, y [mm] where the sled rests after the last mark: no mark lies under it, if that can be.

    The nearest such place to the middle, and never above it: a sled that is high may sink.
    """
    across, down = [0.0, *(mark.x for mark in marks)], [0.0, *(min(mark.y, 0.0) for mark in marks)]
    places = [
        (x * RASTER, y * RASTER)
        for x in range(math.ceil(min(across) / RASTER), math.floor(max(across) / RASTER) + 1)
        for y in range(math.ceil(min(down) / RASTER), 1)
    ]

    def order(place: tuple[float, float]) -> tuple[float, float]:
        clear = min(math.dist(place, (mark.x, mark.y)) for mark in marks)
        return max(0.0, UNDER - clear), math.hypot(*place)

    return min(places, key=order)


# The way of the sled over the sheet: each place is checked before anything is written.

# What moves marks where the sled can go, on the page of the lab.
INWARDS = "place your choice of marks farther from the sheet's edges"
WAY_STEP = 25.0  # [mm] between the places on the way at which the chains are checked
Question = Callable[[Grid, PlainMachine, str, float, float], object]


def tensions(machine: PlainMachine, x: float, y: float) -> tuple[float, float]:
    """Left and right chain tension [N] at x, y [mm]: weight * cos(other) / sin(left + right)."""
    height = machine.sheet_height / 2 + machine.motor_offset - y
    left = math.atan2(height, machine.motor_spacing / 2 + x)
    right = math.atan2(height, machine.motor_spacing / 2 - x)
    share = machine.sled_weight_n / math.sin(left + right)
    return share * math.cos(right), share * math.cos(left)


def _check_place(grid: Grid, machine: PlainMachine, what: str, x: float, y: float) -> None:
    """Refuses a place [mm] that the sled must not go to."""
    what = f"{what} at x {x:.1f} y {y:.1f}"
    half_width, half_height = machine.sheet_width / 2, machine.sheet_height / 2
    inside = max(abs(x) - half_width, abs(y) - half_height) < 1e-6  # room for rounding
    move = inwards(grid)
    demand(inside, f"{what} is outside the sheet: " + move)
    sprocket = (machine.motor_spacing / 2, half_height + machine.motor_offset)
    free = math.dist(sprocket, (abs(x), y)) - machine.rotation_radius
    close = f"{what} brings ring and sprocket within {free:.0f} mm of each other: " + move
    demand(free >= MIN_FREE_CHAIN, close)
    pulls = tensions(machine, x, y)
    tight = f"{what} puts {max(pulls):.0f} N on a chain, more than {MAX_TENSION:g}"
    demand(max(pulls) <= MAX_TENSION, f"{tight}: " + move + ", or lighten the sled")
    side = "left" if pulls[0] < pulls[1] else "right"
    slack = f"{what} leaves {min(pulls):.1f} N on the {side} chain, less than {MIN_TENSION:g}"
    demand(min(pulls) >= MIN_TENSION, f"{slack}: " + move + ", or move the motors apart")


def inwards(grid: Grid, margin: float | None = None) -> str:
    """Return what to do about a mark where the sled cannot go; margin: that would do [mm]."""
    if grid.places:
        return to_do("move that place", page=INWARDS)
    return to_do(f"raise --margin to {margin:g}" if margin else "raise --margin", page=INWARDS)


def check(grid: Grid, machine: PlainMachine, ask: Question = _check_place) -> None:
    """Ask about all places that the sled passes; refuses what leaves the sheet or its limits."""
    stops = stops_of(grid, machine)
    for what, place in stops:
        ask(grid, machine, what, *place)
    x, y = stops[0][1]  # the way between two top corners passes the tightest place of all
    for what, end in stops[1:]:
        for steps in range(math.ceil(math.dist((x, y), end) / WAY_STEP), 0, -1):
            x, y = x + (end[0] - x) / steps, y + (end[1] - y) / steps
            ask(grid, machine, f"the way to {what}", x, y)
