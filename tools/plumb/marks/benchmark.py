"""The form of the Calibration Benchmark Test: readings by the names of their spans."""

from __future__ import annotations

from os import PathLike
from typing import Any

from plumb.grid.benchmark_pattern import SPANS, benchmark_targets
from plumb.marks.model import Distance, Mark, Point
from plumb.text.errors import naming, refusal
from plumb.text.lengths import length
from plumb.text.values import pair, refuse_unknown


def read_benchmark(
    path: str | PathLike[str], table: object, *, weight: float | None, unit: float = 1.0
) -> tuple[tuple[Mark, ...], tuple[Distance, ...]]:
    """Marks and distances of a table [benchmark]; readings that were not taken are left out."""
    place = "[benchmark]"
    if not isinstance(table, dict):
        raise refusal(path, "benchmark is not a table", remedy=f"write a line {place}")
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
        raise refusal(path, "has no reading", place=place, remedy="fill in what you measured")
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
    """The numbers of a line of the form [mm]; none if the line is not there."""
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
