"""The G-code of a grid."""

from __future__ import annotations

import configparser
import json
import math
from collections.abc import Sequence

from plumb.grid.options import Grid, PlainMachine
from plumb.grid.pattern import (
    Touch,
    benchmark_form,
    check,
    lead_in,
    listed,
    spans_line,
    stops_of,
    tensions,
    touches_of,
)

FIRST_LINE = "(Plumb calibration grid)"


def program(grid: Grid, machine: PlainMachine) -> str:
    """Return the G-code as text; raises GridError if the grid cannot be made."""
    check(grid, machine)

    def word(letter: str, length: float) -> str:
        scale, digits = (1, 3) if grid.units == "mm" else (1 / 25.4, 4)
        text = f"{length * scale:.{digits}f}".rstrip("0").rstrip(".")
        return letter + ("0" if text == "-0" else text)

    touches = touches_of(grid, machine)
    router = "leave the router off" if grid.mode == "touch" else "switch the router on first"
    up = f"G0 {word('Z', grid.safe_height)}"
    pattern = "places" if grid.places else grid.pattern
    lines = [
        FIRST_LINE,
        f"(pattern: {pattern}, {len(touches)} marks with repeats)",
        "(X0 Y0 middle of sheet, Z0 surface, comments in mm)",
        f"({grid.mode} {grid.bit_depth:g} mm deep: {router})",
        "G21" if grid.units == "mm" else "G20",
        "G90",
        up,
    ]
    for mark in touches:
        x, y = lead_in(grid, mark)
        lines += [
            f"({mark} at x {mark.x:.1f} y {mark.y:.1f})",
            f"G0 {word('X', x)} {word('Y', y)}",
            f"G1 {word('X', mark.x)} {word('Y', mark.y)} {word('F', grid.feed)}",
            f"G1 {word('Z', -grid.bit_depth)} {word('F', grid.plunge_feed)}",
            up,
        ]
    return "\n".join([*lines, "(back to the middle)", "G0 X0 Y0", ""])


# The form for the tape's readings: a marks.toml that waits for them.


def marks_list(
    grid: Grid,
    machine: PlainMachine,
    cut_with: str = "",
    *,
    new_sheet: bool = False,
    spans: Sequence[tuple[str, str]] = (),
) -> str:
    """Return the text of a marks.toml that waits for the tape's readings.

    `cut_with` are lines that name the settings in force, `new_sheet` says that the marks are on
    another sheet than those before, and `spans` are marks between which a tape is laid.
    """
    cut_with = "\nnew_sheet = true" * new_sheet + cut_with
    if grid.pattern == "benchmark":
        return benchmark_form(grid.approach, cut_with)
    lines = [
        "# Calibration marks, mm from the sheet's top left corner; x right, y down, approach too.",
        "# Fill in each measured line and take away its #; delete a [[mark]] that you cannot read.",
        *([spans_line(spans)] if spans else []),
        f'frame = "sheet-top-left"{cut_with}',
    ]
    for mark in listed(touches_of(grid, machine)):
        x, y = machine.sheet_width / 2 + mark.x, machine.sheet_height / 2 - mark.y
        lines += [
            f'\n[[mark]]\nname = "{mark.name}"\ntarget = [{x:.2f}, {y:.2f}]',
            f"approach = [{grid.approach[0]:.1f}, {0.0 - grid.approach[1]:.1f}]",
            "# measured = [ , ]",
        ]
    for first, second in spans:
        lines.append(f'\n# [[distance]]\n# between = ["{first}", "{second}"]\n# length =')
    return "\n".join([*lines, ""])


# A picture of the grid in characters, for a look before anything is cut.

PICTURE_WIDTH = 77  # [characters] odd, so that the middle of the sheet has a column


def preview(grid: Grid, machine: PlainMachine) -> str:
    """Return a picture of the sheet, and the marks in the order in which they are made."""
    touches = touches_of(grid, machine)
    places = [place for _, place in stops_of(grid, machine)]
    minutes = sum(map(math.dist, places, places[1:])) / grid.feed
    minutes += 2 * (grid.safe_height + grid.bit_depth) * len(touches) / grid.plunge_feed
    lines = [
        f"{len(touches)} marks, {grid.mode} {grid.bit_depth:g} mm deep, "
        f"about {minutes:.0f} minutes",
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


def _picture(machine: PlainMachine, touches: Sequence[Touch]) -> list[str]:
    """Return the sheet in characters, which are twice as high as wide."""
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


# The settings of WebControl as the sections, keys and values of a groundcontrol.ini.


def is_webcontrol(text: str) -> bool:
    """Return whether this may be a webcontrol.json."""
    return text.lstrip().startswith("{")


def as_ini(text: str) -> configparser.RawConfigParser:
    """Return the values of a webcontrol.json; a ValueError if it is none."""
    parser = configparser.RawConfigParser(strict=False)
    document = json.loads(text)
    for section, options in document.items():
        if not isinstance(options, list):
            raise ValueError("a section of WebControl is a list")
        said = {str(each["key"]): str(each["value"]) for each in options if "value" in each}
        parser.read_dict({section: said})
    return parser
