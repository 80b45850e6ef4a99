"""The community's Calibration Benchmark Test: its places, its spans, and the form for its readings.

GroundControl's "Calibration Benchmark Test.nc" (January 2018) cuts ticks 1905 mm apart across the
sheet and 900 mm apart upwards, and a square of 100 mm in each corner of that rectangle; the score
that its simulator prints (pull requests 576 and 580) counts a fifth square in the middle too.
Here each end is a mark. Like the rest of this room it needs only Python 3.9.
"""

from __future__ import annotations

import math

ACROSS, UPWARDS, SQUARE = 1905.0, 900.0, 100.0  # [mm]
RIGHT, TOP = ACROSS / 2, UPWARDS / 2
# Where a square begins; two of its sides end 100 mm further in, at TLx and TLy and so on.
CORNERS = {
    "TL": (-RIGHT, TOP),
    "TR": (RIGHT, TOP),
    "BL": (-RIGHT, -TOP),
    "BR": (RIGHT, -TOP),
    "C": (-SQUARE / 2, SQUARE / 2),
}
ENDS = {"L": (-RIGHT, 0.0), "R": (RIGHT, 0.0), "T": (0.0, TOP), "B": (0.0, -TOP)}
# Readings by their name in the form: the marks at both ends of each.
ACROSS_SPANS = (("TL", "TR"), ("L", "R"), ("BL", "BR"))
UPWARDS_SPANS = (("TL", "BL"), ("T", "B"), ("TR", "BR"))
SPANS: dict[str, tuple[tuple[str, str], ...]] = {"across": ACROSS_SPANS, "upwards": UPWARDS_SPANS}
SQUARES = {"TL": "top_left", "TR": "top_right", "BL": "bottom_left", "BR": "bottom_right"}
SQUARES |= {"C": "center"}
SPANS |= {SQUARES[name]: ((name, f"{name}x"), (name, f"{name}y")) for name in CORNERS}

_FORM = """\
# Readings of the Calibration Benchmark Test, mm. Fill in what you read and take away its #.
# From mark to mark, or from one side of a cut to the same side of the other. T and B, L and R are
# the middles of top and bottom, left and right; TL the outer corner of the top left square.
frame = "machine"{}

[benchmark]
approach = [{:.1f}, {:.1f}]
# 1905 mm across the sheet: TL to TR, L to R, BL to BR
# across = [ , , ]
# 900 mm upwards: TL to BL, T to B, TR to BR
# upwards = [ , , ]
# 100 mm squares: width (TL to TLx), height (TL to TLy)
"""


def benchmark_targets() -> dict[str, tuple[float, float]]:
    """Where each mark is [mm] by its name."""
    place_of = dict(ENDS)
    for name, (x, y) in CORNERS.items():
        place_of[name] = (x, y)
        place_of[f"{name}x"] = (x - math.copysign(SQUARE, x), y)
        place_of[f"{name}y"] = (x, y - math.copysign(SQUARE, y))
    return place_of


def benchmark_places() -> list[tuple[str, float, float]]:
    """Name, x and y [mm] of all marks, there and back in rows from the top left."""
    rows: dict[float, list[tuple[float, str]]] = {}
    for name, (x, y) in benchmark_targets().items():
        rows.setdefault(y, []).append((x, name))
    ordered = []
    for number, y in enumerate(sorted(rows, reverse=True)):
        row = sorted(rows[y], reverse=bool(number % 2))
        ordered += [(name, x, y) for x, name in row]
    return ordered


def benchmark_form(approach: tuple[float, float], cut_with: str = "") -> str:
    """The text of a marks file that waits for the readings; approach [mm] into every mark."""
    squares = [f"# {SQUARES[name]} = [ , ]" for name in CORNERS]
    return "\n".join([_FORM.format(cut_with, *approach) + squares[0], *squares[1:], ""])
