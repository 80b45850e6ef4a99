"""The G-code of a grid."""

from __future__ import annotations

from plumb.grid.options import Grid, PlainMachine
from plumb.grid.touches import lead_in, touches_of
from plumb.grid.way import check

FIRST_LINE = "(Plumb calibration grid)"


def program(grid: Grid, machine: PlainMachine) -> str:
    """The G-code as text; raises GridError if the grid cannot be made."""
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
