"""A picture of the grid in characters, for a look before anything is cut."""

from __future__ import annotations

import math
from collections.abc import Sequence

from plumb.grid.options import Grid, PlainMachine
from plumb.grid.touches import Touch, stops_of, touches_of
from plumb.grid.way import tensions

PICTURE_WIDTH = 77  # [characters] odd, so that the middle of the sheet has a column


def preview(grid: Grid, machine: PlainMachine) -> str:
    """A picture of the sheet, and the marks in the order in which they are made."""
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
