"""What a grid of marks is made by: its options, and the machine that cuts it.

Frame: origin in the middle of the sheet, x right, y up. Lengths are mm, forces N, feeds mm/min.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from typing import NamedTuple, Union

from plumb.text.errors import to_do

Kind = Union[type, Callable[[str], object], "tuple[str, ...]"]  # how an option's text is read

DEPTH = {"touch": 0.5, "drill": 5.0}  # [mm] a scratch that a tape can find; a hole for a pin
# Twice what friction moves a sled in a lower corner: after it, the way before is forgotten.
MIN_LEAD_IN = 10.0  # [mm]
MIN_FREE_CHAIN = 100.0  # [mm] between ring and sprocket, so that the carriage stays clear
# Lowest and highest of other options: 0.1 to 10000. A 3/4 inch sheet ends at 19 mm of depth.
LIMITS: dict[str, tuple[float, float]] = {
    "columns": (2, 31),
    "rows": (2, 31),
    "margin": (0, 10000),
    "repeats": (0, 9),
    "repeat_spacing": (0, 1000),
    "depth": (0.1, 19),
    "safe_height": (1, 50),
    "min_tension": (0, 1000),
}


class GridError(ValueError):
    """What is wrong, where, and what to do, in one line."""


class Grid(NamedTuple):
    """The marks, and how they are made; GRID_OPTIONS says what each number means."""

    pattern: str = "grid"
    columns: int = 5
    rows: int = 3
    margin: float = 100.0
    order: str = "snake"
    # Upwards friction moves a sled least: 0.4 mm in a lower corner, against 2.5 mm sideways.
    approach: tuple[float, float] = (0.0, 40.0)
    repeats: int = 1
    repeat_spacing: float = 20.0
    mode: str = "touch"
    depth: float | None = None
    safe_height: float = 5.0
    feed: float = 700.0
    plunge_feed: float = 40.0
    units: str = "mm"
    # A third of the motors' stall is kept for friction and for the hose.
    max_tension: float = 200.0
    # Below a slack-side bungee's pull the gears change sides, and the far chain is too soft.
    min_tension: float = 18.0
    # [mm] marks here and nowhere else, in this order; empty: in columns and rows.
    places: tuple[tuple[float, float], ...] = ()

    @property
    def bit_depth(self) -> float:
        """How far the bit goes below the surface [mm]."""
        return DEPTH[self.mode] if self.depth is None else self.depth


class PlainMachine(NamedTuple):
    """The machine as the grid sees it: straight chains without weight.

    MACHINE_OPTIONS says what each number means.
    """

    sheet_width: float = 2438.4
    sheet_height: float = 1219.2
    motor_spacing: float = 2978.4
    motor_offset: float = 463.0
    rotation_radius: float = 139.1
    sled_weight_n: float = 97.9


def pair(text: str) -> tuple[float, float]:
    """Two numbers with a comma between them."""
    across, up = map(float, text.split(","))
    return across, up


def pairs(text: str) -> tuple[tuple[float, float], ...]:
    """Several of them, with spaces between."""
    each = tuple(map(pair, text.split()))
    if not each:
        raise ValueError("no place is given")
    return each


# Name, kind or choices, meaning.
GRID_OPTIONS: tuple[tuple[str, Kind, str], ...] = (
    ("pattern", ("grid", "benchmark"), "benchmark: the community's test, places fixed"),
    ("columns", int, "marks side by side, 2 to 31"),
    ("rows", int, "marks one above the other, 2 to 31"),
    ("margin", float, "mm from the outer marks to the sheet's edge"),
    ("order", ("snake", "rows", "columns"), "there and back, by rows, or by columns"),
    ("approach", pair, "DX,DY in mm, the way into every mark"),
    ("repeats", int, "times that corners and middles of edges are made again, 0 to 9"),
    ("repeat_spacing", float, "mm from a mark inwards to its repeat; 0 hits it again"),
    ("mode", tuple(DEPTH), "touch with the router off, or drill"),
    ("depth", float, "mm below the surface (touch 0.5, drill 5)"),
    ("safe_height", float, "mm above the surface for all sideways moves"),
    ("feed", float, "mm/min sideways"),
    ("plunge_feed", float, "mm/min downwards"),
    ("units", ("mm", "inch"), "of the program; options and comments stay in mm"),
    ("max_tension", float, "N, the tightest chain allowed; motors stall near 290 N"),
    ("min_tension", float, "N, the slackest chain allowed; a bungee pulls about 18 N"),
    ("places", pairs, "'X,Y X,Y ...' in mm from the sheet's middle: marks there, in this order"),
)
# Name, section and key of groundcontrol.ini, meaning.
MACHINE_OPTIONS = (
    ("sheet_width", "Maslow Settings", "bedWidth", "mm"),
    ("sheet_height", "Maslow Settings", "bedHeight", "mm"),
    ("motor_spacing", "Maslow Settings", "motorSpacingX", "mm between the sprockets"),
    ("motor_offset", "Maslow Settings", "motorOffsetY", "mm, sprockets above the sheet"),
    ("rotation_radius", "Advanced Settings", "rotationRadius", "mm, chain's end to bit"),
    ("sled_weight_n", "Maslow Settings", "sledWeight", "N, with router and bricks"),
)


# What no grid can be: numbers beyond their limits.


def demand(holds: bool, sentence: str) -> None:
    """Raise the sentence unless the condition holds."""
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
