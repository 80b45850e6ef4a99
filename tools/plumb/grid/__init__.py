"""The G-code for calibration marks."""

from plumb.grid.options import MIN_FREE_CHAIN, PRESETS, Grid, GridError, PlainMachine
from plumb.grid.pattern import check, inwards, tensions, touches_of
from plumb.grid.program import marks_list, program

__all__ = [
    "MIN_FREE_CHAIN",
    "PRESETS",
    "Grid",
    "GridError",
    "PlainMachine",
    "check",
    "inwards",
    "marks_list",
    "program",
    "tensions",
    "touches_of",
]
