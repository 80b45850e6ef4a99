"""What no grid can be: numbers beyond their limits."""

from __future__ import annotations

import math

from plumb.grid.options import LIMITS, MIN_LEAD_IN, Grid, GridError, PlainMachine
from plumb.text.readers import to_do


def demand(holds: bool, sentence: str) -> None:
    """Raises the sentence unless the condition holds."""
    if not holds:
        raise GridError(sentence)


def check_numbers(grid: Grid, machine: PlainMachine) -> None:
    """Refuses numbers that no grid can have."""
    given = {**machine._asdict(), **grid._asdict(), "depth": grid.bit_depth}
    for name, value in given.items():
        if isinstance(value, (int, float)):
            low, high = LIMITS.get(name, (0.1, 10000))
            said = name.replace("_", " ")
            option = to_do(f"--{name.replace('_', '-')}", page=f"the {said} of the settings")
            limits = f"give a number from {low:g} to {high:g}"
            demand(low <= value <= high, f"{option} is {value:g}: {limits}")
    short = to_do("--approach", page="the way into the marks")
    short += f" is shorter than {MIN_LEAD_IN:g} mm: give a longer way into the marks"
    demand(math.hypot(*grid.approach) >= MIN_LEAD_IN, short)
    half = min(machine.sheet_width, machine.sheet_height) / 2
    wide = to_do(
        f"--margin is {grid.margin:g} mm: give less than {half:g}",
        page=f"the sheet is too small for marks {grid.margin:g} mm from its edges: place your "
        "choice of marks",
    )
    demand(grid.margin < half or bool(grid.places), wide)
    gap = (machine.sheet_width - 2 * grid.margin) / (grid.columns - 1)
    crowded = f"repeats reach more than half of the {gap:.0f} mm to the next column of marks: "
    crowded += to_do(
        "lower --repeats, --repeat-spacing or --columns", page="choose a way with fewer marks"
    )
    demand(grid.repeats * grid.repeat_spacing <= gap / 2, crowded)
