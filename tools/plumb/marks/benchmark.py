"""The form of the Calibration Benchmark Test: readings by the names of their spans."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from os import PathLike
from typing import Annotated, Any

import numpy as np

from plumb.grid.pattern import SPANS, benchmark_targets
from plumb.marks.model import Distance, Mark, Measurements, Point
from plumb.text.answers import key
from plumb.text.errors import InputError, naming
from plumb.text.values import length, pair, refuse_unknown


def read_benchmark(
    path: str | PathLike[str], table: object, *, weight: float | None, unit: float = 1.0
) -> tuple[tuple[Mark, ...], tuple[Distance, ...]]:
    """Return marks and distances of a table [benchmark]; readings that were not taken are
    left out.
    """
    place = "[benchmark]"
    if not isinstance(table, dict):
        raise InputError(path, "benchmark is not a table", remedy=f"write a line {place}")
    with naming(path, place):
        refuse_unknown(table, ("approach", *SPANS))
    approach = None
    if "approach" in table:
        with naming(path, f"{place} approach"):
            approach = pair(table["approach"])
    distances = [
        Distance(ends, length)
        for name, spans in SPANS.items()
        for ends, length in zip(spans, _readings(path, table, name, len(spans), unit), strict=False)
    ]
    if not distances:
        raise InputError(path, "has no reading", place=place, remedy="fill in what you measured")
    needed = {name for distance in distances for name in distance.between}
    marks = tuple(
        Mark(name, target, approach=approach, sled_weight=weight)
        for name, target in benchmark_targets().items()
        if name in needed
    )
    return marks, tuple(distances)


def span_kind(ends: tuple[Point, Point]) -> str | None:
    """`long` or `small` if the test has such a span [mm], by its targets; else None."""
    return _KINDS.get(frozenset(ends))


def _readings(
    path: str | PathLike[str], table: dict[str, Any], name: str, count: int, unit: float
) -> list[float]:
    """Return the numbers of a line of the form [mm]; none if the line is not there."""
    if name not in table:
        return []
    given = table[name]
    with naming(path, f"[benchmark] {name}"):
        if not isinstance(given, list) or len(given) != count:
            raise ValueError(
                f"{count} numbers are needed, as in the form; put a # before a line that you "
                "did not measure"
            )
        lengths = [length(reading, unit=unit) for reading in given]
        for size in lengths:
            if size <= 0:
                raise ValueError(f"{size:g}; a distance is above zero")
    return lengths


def _kinds() -> dict[frozenset[Point], str]:
    places = benchmark_targets()
    return {
        frozenset(places[name] for name in ends): "long" if line in LONG_LINES else "small"
        for line, spans in SPANS.items()
        for ends in spans
    }


LONG_LINES = ("across", "upwards")
_KINDS = _kinds()


# The score of the Calibration Benchmark Test, as the community computes it.
#
# Two numbers: the mean absolute error of the long spans (three of 1905 mm, three of 900 mm) and of
# the sides of the 100 mm squares (GroundControl, pull requests 576 and 580, January 2018).

FULL_LONG, FULL_SMALL = 6, 8  # readings of the published cut; a square in the middle makes 10


@dataclass(frozen=True)
class Score:
    """How far the spans of the test are off [mm]; None where none was measured."""

    long: Annotated[float | None, key("long_mm")]
    small: Annotated[float | None, key("small_mm")]
    long_count: int
    small_count: int

    def __str__(self) -> str:
        """Return the score as people post it: 1.23-0.45."""
        return "-".join("?" if mean is None else f"{mean:.2f}" for mean in (self.long, self.small))

    @property
    def complete(self) -> bool:
        """Whether all readings of the published test are there."""
        return self.long_count >= FULL_LONG and self.small_count >= FULL_SMALL


def score_of(measurements: Measurements, errors: Sequence[float]) -> Score | None:
    """Return the score of errors (m,) [mm] of the distances; None if no span of the test is among
    them.
    """
    errors_of: dict[str, list[float]] = {"long": [], "small": []}
    for ends, error in zip(measurements.distance_targets, errors, strict=True):
        kind = span_kind((_point(ends[0]), _point(ends[1])))
        if kind:
            errors_of[kind].append(abs(float(error)))
    if not errors_of["long"] and not errors_of["small"]:
        return None
    means = {kind: float(np.mean(spans)) if spans else None for kind, spans in errors_of.items()}
    return Score(means["long"], means["small"], len(errors_of["long"]), len(errors_of["small"]))


def _point(place: np.ndarray) -> Point:
    return float(place[0]), float(place[1])


def score_as_cut(measurements: Measurements) -> Score | None:
    """Return the score of what was cut: readings less what they should have been."""
    ends = measurements.distance_targets
    nominal = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    return score_of(measurements, measurements.distance_lengths - nominal)
