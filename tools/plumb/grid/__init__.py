"""The G-code for calibration marks; this room needs only the standard library of Python 3.9."""

from plumb.grid.command import add_arguments, from_arguments, main, run
from plumb.grid.options import MIN_FREE_CHAIN, PRESETS, Grid, GridError, PlainMachine
from plumb.grid.pattern import check, inwards, listed, spans_in, spans_of, tensions, touches_of
from plumb.grid.program import marks_list, program

__all__ = [
    "MIN_FREE_CHAIN",
    "PRESETS",
    "Grid",
    "GridError",
    "PlainMachine",
    "add_arguments",
    "check",
    "from_arguments",
    "inwards",
    "listed",
    "main",
    "marks_list",
    "program",
    "run",
    "spans_in",
    "spans_of",
    "tensions",
    "touches_of",
]
