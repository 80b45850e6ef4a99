"""The G-code for calibration marks."""

import math
from collections.abc import Callable, Sequence
from typing import NamedTuple

from plumb.text.errors import InputError, to_do
from plumb.text.values import typed_length

# Options of a grid of marks, and the machine that cuts it.
#
# Frame: origin in the middle of the sheet, x right, y up. Lengths are mm, forces N, feeds mm/min.

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
BLANK = "# measured = [ , ]"  # what a form has where a reading is yet to come
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


class GridError(InputError):
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


# Where the marks of a grid are, and the way of the sled to them.


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


# The G-code of a grid.

FIRST_LINE = "(Plumb calibration grid)"


def program(grid: Grid, machine: PlainMachine) -> str:
    """Return the G-code as text; raises GridError if the grid cannot be made."""
    check(grid, machine)

    def word(letter: str, length: float) -> str:
        text = f"{length:.3f}".rstrip("0").rstrip(".")
        return letter + ("0" if text == "-0" else text)

    touches = touches_of(grid, machine)
    router = "leave the router off" if grid.mode == "touch" else "switch the router on first"
    up = f"G0 {word('Z', grid.safe_height)}"
    pattern = "places" if grid.places else "grid"
    lines = [
        FIRST_LINE,
        f"(pattern: {pattern}, {len(touches)} marks with repeats)",
        "(X0 Y0 middle of sheet, Z0 surface, comments in mm)",
        f"({grid.mode} {grid.depth:g} mm deep: {router})",
        "G21",
        "G90",
        up,
    ]
    for mark in touches:
        x, y = lead_in(mark)
        lines += [
            f"({mark} at x {mark.x:.1f} y {mark.y:.1f})",
            f"G0 {word('X', x)} {word('Y', y)}",
            f"G1 {word('X', mark.x)} {word('Y', mark.y)} {word('F', grid.feed)}",
            f"G1 {word('Z', -grid.depth)} {word('F', PLUNGE_FEED)}",
            up,
        ]
    x, y = rest_after(touches)
    lines += ["(to a place where the sled hides no mark)", f"G0 {word('X', x)} {word('Y', y)}"]
    return "\n".join([*lines, ""])


# The form for the tape's readings: a marks.toml that waits for them.


def marks_list(
    grid: Grid,
    machine: PlainMachine,
    cut_with: str = "",
    *,
    new_sheet: bool = False,
    units: str = "mm",
) -> str:
    """Return the text of a marks.toml that waits for the tape's readings, in units of UNITS.

    `cut_with` are lines that name the settings in force, and `new_sheet` says that the marks are on
    another sheet than those before.
    """
    cut_with = "\nnew_sheet = true" * new_sheet + cut_with
    if units == "inch":
        cut_with = f'\nunits = "inch"  # fractions too, like 3 7/8{cut_with}'
    lines = [
        f"# Calibration marks, {units} from the sheet's top left corner; x right, y down, approach "
        "too.",
        "# Fill in each measured line and take away its #; delete a [[mark]] that you cannot read.",
        f'frame = "sheet-top-left"{cut_with}',
    ]
    size, digits = UNITS[units]
    for mark in listed(touches_of(grid, machine)):
        x, y = machine.sheet_width / 2 + mark.x, machine.sheet_height / 2 - mark.y
        target = f"[{x / size:.{digits}f}, {y / size:.{digits}f}]"
        lines += [
            f'\n[[mark]]\nname = "{mark.name}"\ntarget = {target}',
            f"approach = [{APPROACH[0]:.1f}, {0.0 - APPROACH[1]:.1f}]",
            BLANK,
        ]
    return "\n".join([*lines, ""])
