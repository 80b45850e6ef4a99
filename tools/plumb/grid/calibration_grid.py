"""Writes the G-code for a grid of calibration marks, each one approached in the same direction.

It needs only Python 3.9; tools/calibration_grid.py runs it without an installation.
Frame: origin in the middle of the sheet, x right, y up. Lengths are mm, forces N, feeds mm/min.
"""

import argparse
import configparser
import math
import os
import sys
from collections import namedtuple

from plumb.grid import benchmark_pattern

DEPTH = {"touch": 0.5, "drill": 5.0}  # [mm] a scratch that a tape can find; a hole for a pin
# Twice what friction moves a sled in a lower corner: after it, the way before is forgotten.
MIN_LEAD_IN = 10.0  # [mm]
MIN_FREE_CHAIN = 100.0  # [mm] between ring and sprocket, so that the carriage stays clear
# Others: 0.1 to 10000. A 3/4 inch sheet ends at 19 mm of depth.
LIMITS = {"columns": (2, 31), "rows": (2, 31), "margin": (0, 10000), "repeats": (0, 9)}
LIMITS |= {"repeat_spacing": (0, 1000), "depth": (0.1, 19), "safe_height": (1, 50)}
LIMITS |= {"min_tension": (0, 1000)}
WAY_STEP = 25.0  # [mm] between the places on the way at which the chains are checked
PICTURE_WIDTH = 77  # [characters] odd, so that the middle of the sheet has a column


class GridError(ValueError):
    """What is wrong, where, and what to do, in one line."""


def pair(text):
    """Two numbers with a comma between them."""
    across, up = map(float, text.split(","))
    return across, up


# Name, default, kind or choices, meaning.
GRID_OPTIONS = (
    ("pattern", "grid", ("grid", "benchmark"), "benchmark: the community's test, places fixed"),
    ("columns", 5, int, "marks side by side, 2 to 31"),
    ("rows", 3, int, "marks one above the other, 2 to 31"),
    ("margin", 100.0, float, "mm from the outer marks to the sheet's edge"),
    ("order", "snake", ("snake", "rows", "columns"), "there and back, by rows, or by columns"),
    # Upwards friction moves a sled least: 0.4 mm in a lower corner, against 2.5 mm sideways.
    ("approach", (0.0, 40.0), pair, "DX,DY in mm, the way into every mark (--approach=-9,9)"),
    ("repeats", 1, int, "times that corners and middles of edges are made again, 0 to 9"),
    ("repeat_spacing", 20.0, float, "mm from a mark inwards to its repeat; 0 hits it again"),
    ("mode", "touch", tuple(DEPTH), "touch with the router off, or drill"),
    ("depth", None, float, "mm below the surface (touch 0.5, drill 5)"),
    ("safe_height", 5.0, float, "mm above the surface for all sideways moves"),
    ("feed", 700.0, float, "mm/min sideways"),
    ("plunge_feed", 40.0, float, "mm/min downwards"),
    ("units", "mm", ("mm", "inch"), "of the program; options and comments stay in mm"),
    # A third of the motors' stall is kept for friction and for the hose.
    ("max_tension", 200.0, float, "N, the tightest chain allowed; motors stall near 290 N"),
    # Below a slack-side bungee's pull the gears change sides, and the far chain is too soft.
    ("min_tension", 18.0, float, "N, the slackest chain allowed; a bungee pulls about 18 N"),
)
# Name, default, section and key of groundcontrol.ini, meaning.
MACHINE_OPTIONS = (
    ("sheet_width", 2438.4, "Maslow Settings", "bedWidth", "mm"),
    ("sheet_height", 1219.2, "Maslow Settings", "bedHeight", "mm"),
    ("motor_spacing", 2978.4, "Maslow Settings", "motorSpacingX", "mm between the sprockets"),
    ("motor_offset", 463.0, "Maslow Settings", "motorOffsetY", "mm, sprockets above the sheet"),
    ("rotation_radius", 139.1, "Advanced Settings", "rotationRadius", "mm, chain's end to bit"),
    ("sled_weight_n", 97.9, "Maslow Settings", "sledWeight", "N, with router and bricks"),
)

Grid = namedtuple("Grid", [o[0] for o in GRID_OPTIONS], defaults=[o[1] for o in GRID_OPTIONS])
Machine = namedtuple(
    "Machine", [o[0] for o in MACHINE_OPTIONS], defaults=[o[1] for o in MACHINE_OPTIONS]
)


class Mark(namedtuple("Mark", "name x y visit")):
    """One touch of the bit at x, y [mm]; the same name with visit 1, 2, ... is a repeat."""

    def __str__(self):
        return f"mark {self.name}{' again' if self.visit else ''}"


def tensions(machine, x, y):
    """Left and right chain tension [N] at x, y [mm]: weight * cos(other) / sin(left + right)."""
    height = machine.sheet_height / 2 + machine.motor_offset - y
    left = math.atan2(height, machine.motor_spacing / 2 + x)
    right = math.atan2(height, machine.motor_spacing / 2 - x)
    share = machine.sled_weight_n / math.sin(left + right)
    return share * math.cos(right), share * math.cos(left)


def marks(grid, machine):
    """Every touch in the order in which it is made; names count by rows from the top left."""
    _check_numbers(grid, machine)
    if grid.pattern == "benchmark":
        return [Mark(*place, 0) for place in benchmark_pattern.places()]
    width = machine.sheet_width - 2 * grid.margin
    height = machine.sheet_height - 2 * grid.margin
    places = _places(grid)
    first = {}
    for row, column in places:
        # Whole tenths: program, comment and list say the same number. Adding 0 turns -0 into 0.
        x = round(width * (column / (grid.columns - 1) - 0.5), 1) + 0.0
        y = round(height * (0.5 - row / (grid.rows - 1)), 1) + 0.0
        first[row, column] = Mark(str(row * grid.columns + column + 1), x, y, 0)
    touches = list(first.values())
    for visit in range(1, grid.repeats + 1):
        # Backwards every other time: what the lead-in fails to forget then shows as noise.
        for row, column in places[::-1] if visit % 2 else places:
            mark = first[row, column]
            shift = visit * grid.repeat_spacing * (-1 if mark.x > 0 else 1)
            if _is_extreme(grid, row, column):
                touches.append(mark._replace(x=round(mark.x + shift, 1), visit=visit))
    return touches


def _places(grid):
    """Pairs of row and column in the order of the visit."""
    rows, columns = range(grid.rows), range(grid.columns)
    if grid.order == "columns":
        return [(row, column) for column in columns for row in rows]
    turned = grid.order == "snake"
    return [(row, column) for row in rows for column in columns[:: -1 if turned and row % 2 else 1]]


def _is_extreme(grid, row, column):
    """True for the corners and, where there is one, the middle of each edge (1; ends: 0, 2)."""
    across, down = 2 * column / (grid.columns - 1), 2 * row / (grid.rows - 1)
    return across in (0, 1, 2) and down in (0, 1, 2) and (across, down) != (1, 1)


def _demand(holds, sentence):
    """Raises the sentence unless the condition holds."""
    if not holds:
        raise GridError(sentence)


def _check_numbers(grid, machine):
    """Refuses numbers that no grid can have."""
    given = {**machine._asdict(), **grid._asdict(), "depth": _depth(grid)}
    for name, value in given.items():
        if isinstance(value, (int, float)):
            low, high = LIMITS.get(name, (0.1, 10000))
            option = name.replace("_", "-")
            limits = f"give a number from {low:g} to {high:g}"
            _demand(low <= value <= high, f"--{option} is {value:g}: {limits}")
    short = f"--approach is shorter than {MIN_LEAD_IN:g} mm: give a longer way into the marks"
    _demand(math.hypot(*grid.approach) >= MIN_LEAD_IN, short)
    half = min(machine.sheet_width, machine.sheet_height) / 2
    _demand(grid.margin < half, f"--margin is {grid.margin:g} mm: give less than {half:g}")
    gap = (machine.sheet_width - 2 * grid.margin) / (grid.columns - 1)
    crowded = f"repeats reach more than half of the {gap:.0f} mm to the next column of marks: "
    crowded += "lower --repeats, --repeat-spacing or --columns"
    _demand(grid.repeats * grid.repeat_spacing <= gap / 2, crowded)


def _depth(grid):
    """How far the bit goes below the surface [mm]."""
    return DEPTH[grid.mode] if grid.depth is None else grid.depth


def _lead_in(grid, mark):
    """x, y [mm] from which the sled travels straight into the mark."""
    return mark.x - grid.approach[0], mark.y - grid.approach[1]


def _stops(grid, machine):
    """Names and places [mm] of all ends of sideways moves."""
    stops = []
    for mark in marks(grid, machine):
        stops += [(f"the lead-in of {mark}", _lead_in(grid, mark)), (str(mark), (mark.x, mark.y))]
    return [("the start", (0.0, 0.0)), *stops, ("the end", (0.0, 0.0))]


def _check_place(grid, machine, what, x, y):
    """Refuses a place [mm] that the sled must not go to."""
    what = f"{what} at x {x:.1f} y {y:.1f}"
    half_width, half_height = machine.sheet_width / 2, machine.sheet_height / 2
    inside = max(abs(x) - half_width, abs(y) - half_height) < 1e-6  # room for rounding
    _demand(inside, f"{what} is outside the sheet: raise --margin or change --approach")
    sprocket = (machine.motor_spacing / 2, half_height + machine.motor_offset)
    free = math.dist(sprocket, (abs(x), y)) - machine.rotation_radius
    close = f"{what} brings ring and sprocket within {free:.0f} mm of each other: raise --margin"
    _demand(free >= MIN_FREE_CHAIN, close)
    pulls = tensions(machine, x, y)
    tight = f"{what} puts {max(pulls):.0f} N on a chain, more than --max-tension "
    tight += f"{grid.max_tension:g}: raise --margin or lighten the sled"
    _demand(max(pulls) <= grid.max_tension, tight)
    side = "left" if pulls[0] < pulls[1] else "right"
    slack = f"{what} leaves {min(pulls):.1f} N on the {side} chain, less than --min-tension "
    slack += f"{grid.min_tension:g}: raise --margin or move the motors apart"
    _demand(min(pulls) >= grid.min_tension, slack)


def check(grid, machine, ask=_check_place):
    """Asks about all places that the sled passes; refuses what leaves the sheet or its limits."""
    stops = _stops(grid, machine)
    for what, place in stops:
        ask(grid, machine, what, *place)
    x, y = stops[0][1]  # the way between two top corners passes the tightest place of all
    for what, end in stops[1:]:
        for steps in range(math.ceil(math.dist((x, y), end) / WAY_STEP), 0, -1):
            x, y = x + (end[0] - x) / steps, y + (end[1] - y) / steps
            ask(grid, machine, f"the way to {what}", x, y)


def program(grid, machine):
    """The G-code as text; raises GridError if the grid cannot be made."""
    check(grid, machine)

    def word(letter, length):
        scale, digits = (1, 3) if grid.units == "mm" else (1 / 25.4, 4)
        text = f"{length * scale:.{digits}f}".rstrip("0").rstrip(".")
        return letter + ("0" if text == "-0" else text)

    touches = marks(grid, machine)
    router = "leave the router off" if grid.mode == "touch" else "switch the router on first"
    up = f"G0 {word('Z', grid.safe_height)}"
    lines = [
        "(Plumb calibration grid)",
        f"(pattern: {grid.pattern}, {len(touches)} marks with repeats)",
        "(X0 Y0 middle of sheet, Z0 surface, comments in mm)",
        f"({grid.mode} {_depth(grid):g} mm deep: {router})",
        "G21" if grid.units == "mm" else "G20",
        "G90",
        up,
    ]
    for mark in touches:
        x, y = _lead_in(grid, mark)
        lines += [
            f"({mark} at x {mark.x:.1f} y {mark.y:.1f})",
            f"G0 {word('X', x)} {word('Y', y)}",
            f"G1 {word('X', mark.x)} {word('Y', mark.y)} {word('F', grid.feed)}",
            f"G1 {word('Z', -_depth(grid))} {word('F', grid.plunge_feed)}",
            up,
        ]
    return "\n".join([*lines, "(back to the middle)", "G0 X0 Y0", ""])


def preview(grid, machine):
    """A picture of the sheet, and the marks in the order in which they are made."""
    touches = marks(grid, machine)
    places = [place for _, place in _stops(grid, machine)]
    minutes = sum(map(math.dist, places, places[1:])) / grid.feed
    minutes += 2 * (grid.safe_height + _depth(grid)) * len(touches) / grid.plunge_feed
    lines = [
        f"{len(touches)} marks, {grid.mode} {_depth(grid):g} mm deep, about {minutes:.0f} minutes",
        *_picture(machine, touches),
        "Into every mark the sled moves {:g} mm right and {:g} mm up.".format(*grid.approach),
        f"Repeats of marks with *: {grid.repeats}, each {grid.repeat_spacing:g} mm further in.",
        "",
        "step                       x         y   from left  from top   left N  right N",
    ]
    for step, mark in enumerate(touches, 1):
        from_left, from_top = machine.sheet_width / 2 + mark.x, machine.sheet_height / 2 - mark.y
        left, right = tensions(machine, mark.x, mark.y)
        where = f"{mark.x:10.1f}{mark.y:10.1f}{from_left:12.1f}{from_top:10.1f}"
        lines.append(f"{step:4d}  {mark!s:14s}{where}{left:9.0f}{right:9.0f}")
    return "\n".join([*lines, ""])


def _picture(machine, touches):
    """The sheet in characters, which are twice as high as wide."""
    height = max(3, round(PICTURE_WIDTH * machine.sheet_height / machine.sheet_width / 2))
    canvas = [[" "] * PICTURE_WIDTH for _ in range(height)]
    repeated = {mark.name for mark in touches if mark.visit}
    for mark in touches:
        column = round((mark.x / machine.sheet_width + 0.5) * (PICTURE_WIDTH - 1))
        row = round((0.5 - mark.y / machine.sheet_height) * (height - 1))
        label = mark.name + "*" * (mark.name in repeated)
        start = min(max(0, column - len(mark.name) // 2), PICTURE_WIDTH - len(label))
        if not mark.visit:
            canvas[row][start : start + len(label)] = label
    edge = "+" + "-" * PICTURE_WIDTH + "+"
    return [edge, *("|" + "".join(line) + "|" for line in canvas), edge]


def marks_list(grid, machine):
    """The text of a marks.toml that waits for the tape's readings."""
    if grid.pattern == "benchmark":
        return benchmark_pattern.form(grid.approach)
    lines = [
        "# Calibration marks, mm from the sheet's top left corner; x right, y down, approach too.",
        "# Fill in each measured line and take away its #; delete a [[mark]] that you cannot read.",
        'frame = "sheet-top-left"',
    ]
    for mark in marks(grid, machine):
        x, y = machine.sheet_width / 2 + mark.x, machine.sheet_height / 2 - mark.y
        lines += [
            f'\n[[mark]]\nname = "{mark.name}"\ntarget = [{x:.2f}, {y:.2f}]',
            f"approach = [{grid.approach[0]:.1f}, {0.0 - grid.approach[1]:.1f}]",
            "# measured = [ , ]",
        ]
    return "\n".join([*lines, ""])


def add_arguments(parser):
    """Gives the parser every option of this tool; None stands for what was not given."""
    for title, table in (("grid", GRID_OPTIONS), ("machine", MACHINE_OPTIONS)):
        group = parser.add_argument_group(title)
        for name, default, kind, *_, meaning in table:
            how = {"type": kind if callable(kind) else float, "metavar": "N"}
            if isinstance(kind, tuple):
                how = {"choices": kind}
            if default is not None:
                meaning += " [{:g},{:g}]".format(*default) if kind is pair else f" [{default}]"
            group.add_argument("--" + name.replace("_", "-"), help=meaning, **how)
    group.add_argument("--settings", metavar="FILE", help="groundcontrol.ini with these numbers")
    group = parser.add_argument_group("output")
    group.add_argument("--output", metavar="FILE", help="where the program goes [the screen]")
    group.add_argument("--marks", metavar="FILE", help="also write a marks.toml to fill in")
    group.add_argument("--preview", action="store_true", help="show a picture, not the program")


def read_settings(path):
    """The numbers [mm, N] in a groundcontrol.ini, by their names in Machine."""
    parser = configparser.ConfigParser(interpolation=None, strict=False)
    try:
        with open(path, encoding="utf-8-sig") as file:
            parser.read_file(file)
    except OSError as error:
        raise GridError(f"{path}: {error.strerror}: check the name after --settings") from None
    except (configparser.Error, UnicodeDecodeError):
        raise GridError(f"{path} is not a groundcontrol.ini: give its numbers as options") from None
    found = {}
    for name, _, section, key, _ in MACHINE_OPTIONS:
        text = parser.get(section, key, fallback="")
        try:
            found[name] = float(text)
        except ValueError:
            # GroundControl itself does not know the sled's weight.
            if text or key != "sledWeight":
                wrong = f"{path}: {key} in [{section}] is {text!r}: give a number there"
                raise GridError(wrong) from None
    return found


def from_arguments(arguments):
    """Grid and Machine of parsed options; an option outweighs the settings file."""
    found = read_settings(arguments.settings) if arguments.settings else {}
    given = {name: value for name, value in vars(arguments).items() if value is not None}
    grid = Grid(**{name: given[name] for name in Grid._fields if name in given})
    grid = grid._replace(repeats=0) if grid.pattern == "benchmark" else grid
    return grid, Machine(**{n: v for n, v in {**found, **given}.items() if n in Machine._fields})


def run(arguments, name="calibration grid"):
    """Does what the parsed options ask; 0 done, 2 refused with one line of that name on stderr."""
    try:
        grid, machine = from_arguments(arguments)
        text = program(grid, machine)
        files = {arguments.output: text} if arguments.output else {}
        if arguments.marks:
            _demand(arguments.marks != arguments.output, "--marks and --output are the same file")
            # Readings that took an hour must not be lost to a second run.
            kept = f"{arguments.marks} exists: move it away or give --marks another name"
            _demand(not os.path.exists(arguments.marks), kept)
            files[arguments.marks] = marks_list(grid, machine)
        _write(files)
    except GridError as refusal:
        print(f"{name}: {refusal}", file=sys.stderr)
        return 2
    if arguments.preview:
        sys.stdout.write(preview(grid, machine))
    elif not arguments.output:
        sys.stdout.write(text)
    return 0


def _write(files):
    """Writes all texts or none: each goes beside its place first and is moved there last."""
    path = ""
    try:
        for path, text in files.items():
            with open(f"{path}.part", "w", encoding="ascii", newline="\n") as file:
                file.write(text)
        for path in files:
            os.replace(f"{path}.part", path)
    except OSError as error:
        for part in filter(os.path.exists, [f"{place}.part" for place in files]):
            os.remove(part)
        raise GridError(f"cannot write {path}: {error.strerror}: give another name") from None


def main(argv=None):
    """The command line; returns the exit code."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    complaint = "calibration grid: {}; --help lists the options\n"
    parser.error = lambda message: parser.exit(2, complaint.format(message))
    add_arguments(parser)
    return run(parser.parse_args(argv))
