"""Targets and readings in each other's columns: then the readings lie on a lattice, and the targets
do not."""

from __future__ import annotations

from collections.abc import Sequence

from plumb.marks.model import Measurements, Point
from plumb.text.errors import refusal

FEWEST = 6  # different places, below which chance may line up readings
MUCH = 2  # this many times as many numbers in the targets as in the readings
ALIKE = 0.005  # [mm] numbers nearer than this are the same


def refuse_exchanged_columns(measurements: Measurements) -> None:
    """Ask about targets that look read and readings that look planned.

    Who plans marks uses few numbers, over and over: rows and columns share theirs. Readings differ
    by their errors. A machine that was steered to drawn points turns this round.
    """
    sent = [mark.target for mark, _ in measurements.readings]
    read = [place for _, place in measurements.readings]
    if measurements.steered or min(len(set(sent)), len(set(read))) < FEWEST:
        return
    if MUCH * _numbers_in(read) <= _numbers_in(sent):
        raise refusal(
            measurements.source,
            "the measured positions lie in rows and columns and the targets do not: are target "
            "and measured exchanged?",
            remedy="exchange the two, or write steered = true at the top of a marks.toml if you "
            "steered the sled to drawn points",
        )


def _numbers_in(points: Sequence[Point]) -> int:
    """How many different numbers their coordinates are made of."""
    return sum(len({round(point[axis] / ALIKE) for point in points}) for axis in (0, 1))
