"""The form for the tape's readings: a marks.toml that waits for them."""

from __future__ import annotations

from collections.abc import Sequence

from plumb.grid.benchmark_pattern import benchmark_form
from plumb.grid.options import Grid, PlainMachine
from plumb.grid.spans import spans_line
from plumb.grid.touches import listed, touches_of


def marks_list(
    grid: Grid,
    machine: PlainMachine,
    cut_with: str = "",
    *,
    new_sheet: bool = False,
    spans: Sequence[tuple[str, str]] = (),
) -> str:
    """The text of a marks.toml that waits for the tape's readings.

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
