"""What no grid can be: numbers beyond their limits."""

from __future__ import annotations

import math

from plumb.grid.options import LIMITS, MIN_LEAD_IN, Grid, GridError, PlainMachine


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
            option = name.replace("_", "-")
            limits = f"give a number from {low:g} to {high:g}"
            demand(low <= value <= high, f"--{option} is {value:g}: {limits}")
    short = f"--approach is shorter than {MIN_LEAD_IN:g} mm: give a longer way into the marks"
    demand(math.hypot(*grid.approach) >= MIN_LEAD_IN, short)
    half = min(machine.sheet_width, machine.sheet_height) / 2
    demand(grid.margin < half, f"--margin is {grid.margin:g} mm: give less than {half:g}")
    gap = (machine.sheet_width - 2 * grid.margin) / (grid.columns - 1)
    crowded = f"repeats reach more than half of the {gap:.0f} mm to the next column of marks: "
    crowded += "lower --repeats, --repeat-spacing or --columns"
    demand(grid.repeats * grid.repeat_spacing <= gap / 2, crowded)
