"""Options of a grid of marks, and the machine that cuts it.

Frame: origin in the middle of the sheet, x right, y up. Lengths are mm, forces N, feeds mm/min.
"""

from typing import NamedTuple

from plumb.text.errors import to_do
from plumb.text.values import typed_length

# Upwards friction moves a sled least: 0.4 mm in a lower corner, against 2.5 mm sideways.
APPROACH = (0.0, 40.0)  # [mm] the way into every mark
PLUNGE_FEED = 40.0  # [mm/min]
REPEAT_SPACING = 20.0  # [mm] from a mark inwards to its repeat, so that both can be measured
DEEPEST_TOUCH = 1.0  # [mm] what is deeper needs a bit that turns
# A third of the motors' stall is kept for friction and for the hose.
MAX_TENSION = 200.0  # [N]
# Below a slack-side bungee's pull the gears change sides, and the far chain is too soft.
MIN_TENSION = 18.0  # [N]
MIN_FREE_CHAIN = 100.0  # [mm] between ring and sprocket, so that the carriage stays clear
# [mm] of each unit of a form, and the decimals that its targets have.
UNITS = {"mm": (1.0, 2), "inch": (25.4, 4)}


class NumberOption(NamedTuple):
    """An option that takes a number from low to high."""

    low: float
    high: float
    meaning: str


NUMBERS = {
    "margin": NumberOption(0, 10000, "mm from the outer marks to the sheet's edge"),
    # A 3/4 inch sheet ends at 19 mm.
    "depth": NumberOption(0.1, 19, f"mm below the surface; more than {DEEPEST_TOUCH:g} drills"),
    "safe_height": NumberOption(1, 50, "mm above the surface for all sideways moves"),
    "feed": NumberOption(0.1, 10000, "mm/min sideways"),
}


class GridError(ValueError):
    """A fault, its place and its remedy, in one line."""


class Grid(NamedTuple):
    """The marks, and how they are made."""

    columns: int = 5
    rows: int = 3
    margin: float = 100.0  # [mm] from the outer marks to the sheet's edge
    repeats: bool = True  # corners and middles of edges are made again
    depth: float = 0.5  # [mm] below the surface: a scratch that a tape can find
    safe_height: float = 5.0
    feed: float = 700.0
    # [mm] marks here and nowhere else, in this order; empty: in columns and rows.
    places: tuple[tuple[float, float], ...] = ()

    @property
    def mode(self) -> str:
        """The way in which a mark is made."""
        return "drill" if self.depth > DEEPEST_TOUCH else "touch"


# Ways to measure, by the names that the lab has for them too.
PRESETS = {
    "nine": Grid(columns=3, rows=3, repeats=False),
    "fifteen": Grid(repeats=False),
    "twenty-five": Grid(columns=5, rows=5, repeats=False),
}


class PlainMachine(NamedTuple):
    """The machine as the grid sees it: straight chains without weight."""

    sheet_width: float = 2438.4
    sheet_height: float = 1219.2
    motor_spacing: float = 2978.4
    motor_offset: float = 463.0
    rotation_radius: float = 139.1
    sled_weight_n: float = 97.9


def pair(text: str) -> tuple[float, float]:
    """Two lengths [mm] with a comma between them."""
    across, up = map(typed_length, text.split(","))
    return across, up


def pairs(text: str) -> tuple[tuple[float, float], ...]:
    """Several of them, with spaces between."""
    each = tuple(map(pair, text.split()))
    if not each:
        raise ValueError("no place is given")
    return each


# What no grid can be: numbers beyond their limits.


def demand(holds: bool, sentence: str) -> None:
    """Raise the sentence unless the condition holds."""
    if not holds:
        raise GridError(sentence)


def check_numbers(grid: Grid, machine: PlainMachine) -> None:
    """Refuses numbers that no grid can have."""
    for name, (low, high, _) in NUMBERS.items():
        option = to_do(f"--{name.replace('_', '-')}", page=f"the {name.replace('_', ' ')}")
        _demand_within(option, getattr(grid, name), low, high)
    for name, value in machine._asdict().items():
        _demand_within(f"the {name.replace('_', ' ')} of the settings", value, 0.1, 10000)
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
        "lower --margin or give --preset fifteen", page="choose a way with fewer marks"
    )
    demand(not grid.repeats or gap >= 2 * REPEAT_SPACING, crowded)


def _demand_within(what: str, value: float, low: float, high: float) -> None:
    demand(low <= value <= high, what + f" is {value:g}: give a number from {low:g} to {high:g}")
