"""The way of the sled over the sheet: each place is checked before anything is written."""

from __future__ import annotations

import math
from collections.abc import Callable

from plumb.grid.limits import demand
from plumb.grid.options import MIN_FREE_CHAIN, Grid, PlainMachine
from plumb.grid.touches import stops_of
from plumb.text.readers import to_do

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
    approach = to_do(" or change --approach", page="")
    demand(inside, f"{what} is outside the sheet: {move}{approach}")
    sprocket = (machine.motor_spacing / 2, half_height + machine.motor_offset)
    free = math.dist(sprocket, (abs(x), y)) - machine.rotation_radius
    close = f"{what} brings ring and sprocket within {free:.0f} mm of each other: {move}"
    demand(free >= MIN_FREE_CHAIN, close)
    pulls = tensions(machine, x, y)
    most = to_do("--max-tension ", page="")
    tight = f"{what} puts {max(pulls):.0f} N on a chain, more than {most}"
    tight += f"{grid.max_tension:g}: {move}, or lighten the sled"
    demand(max(pulls) <= grid.max_tension, tight)
    side = "left" if pulls[0] < pulls[1] else "right"
    least = to_do("--min-tension ", page="")
    slack = f"{what} leaves {min(pulls):.1f} N on the {side} chain, less than {least}"
    slack += f"{grid.min_tension:g}: {move}, or move the motors apart"
    demand(min(pulls) >= grid.min_tension, slack)


def inwards(grid: Grid) -> str:
    """What to do about a mark where the sled cannot go."""
    return to_do("move that place" if grid.places else "raise --margin", page=INWARDS)


def check(grid: Grid, machine: PlainMachine, ask: Question = _check_place) -> None:
    """Asks about all places that the sled passes; refuses what leaves the sheet or its limits."""
    stops = stops_of(grid, machine)
    for what, place in stops:
        ask(grid, machine, what, *place)
    x, y = stops[0][1]  # the way between two top corners passes the tightest place of all
    for what, end in stops[1:]:
        for steps in range(math.ceil(math.dist((x, y), end) / WAY_STEP), 0, -1):
            x, y = x + (end[0] - x) / steps, y + (end[1] - y) / steps
            ask(grid, machine, f"the way to {what}", x, y)
