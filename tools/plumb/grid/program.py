"""The G-code of a grid."""

from plumb.grid.options import APPROACH, PLUNGE_FEED, UNITS, Grid, PlainMachine
from plumb.grid.pattern import (
    check,
    lead_in,
    listed,
    rest_after,
    touches_of,
)

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
            "# measured = [ , ]",
        ]
    return "\n".join([*lines, ""])
