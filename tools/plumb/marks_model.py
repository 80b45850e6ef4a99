"""What was measured on the sheet: marks and distances in the machine frame.

Machine frame: origin in the middle of the sheet, x right, y up, mm.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, field, replace
from pathlib import Path

import numpy as np

from plumb.errors import refusal

Point = tuple[float, float]
CONTROLLERS = ("stock", "holey", "plumb")


@dataclass(frozen=True)
class Mark:
    """One mark: where the sled was sent and where it was found [mm], and how it came there."""

    name: str
    target: Point  # [mm]
    measured: Point | None = None  # [mm]; None for an end of distances only
    approach: Point | None = None  # direction of the last move, any length
    sled_weight: float | None = None  # [N]
    chains: Point | None = None  # [mm] left and right paid out, if the machine reported them
    chains_swapped: bool = False  # each chain hung on the other's sprocket


@dataclass(frozen=True)
class Distance:
    """One measured distance [mm] between two marks, given by their names."""

    between: tuple[str, str]
    length: float  # [mm]


@dataclass(frozen=True)
class Measurements:
    """All marks and distances of one board, and what is known about how they were taken."""

    marks: tuple[Mark, ...]
    distances: tuple[Distance, ...] = ()
    controller: str | None = None  # whose formula moved the sled
    tape_sigma: float | None = None  # [mm] reading error of one coordinate or distance
    sled_weight: float | None = None  # [N] of the whole file; each mark carries its own already
    source: str = ""  # the path, for messages
    _by_name: dict[str, Mark] = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        """Index the marks by name; a repeated name keeps its first target."""
        first: dict[str, Mark] = {}
        for mark in self.marks:
            first.setdefault(mark.name, mark)
        object.__setattr__(self, "_by_name", first)

    @property
    def measured_marks(self) -> tuple[Mark, ...]:
        """The marks whose position was measured: the rows of `targets` and `measured`."""
        return tuple(mark for mark in self.marks if mark.measured is not None)

    @property
    def targets(self) -> np.ndarray:
        """Where the measured marks were sent, (n, 2) [mm]."""
        return _rows([mark.target for mark in self.measured_marks])

    @property
    def measured(self) -> np.ndarray:
        """Where the measured marks were found, (n, 2) [mm]."""
        return _rows([mark.measured for mark in self.measured_marks])

    @property
    def distance_targets(self) -> np.ndarray:
        """Where both ends of each distance were sent, (m, 2 ends, 2) [mm]."""
        ends = [[self.target_of(name) for name in one.between] for one in self.distances]
        return np.array(ends, dtype=float).reshape(-1, 2, 2)

    @property
    def distance_lengths(self) -> np.ndarray:
        """The measured distances, (m,) [mm]."""
        return np.array([one.length for one in self.distances], dtype=float)

    @property
    def repeats(self) -> dict[str, tuple[int, ...]]:
        """Rows of `measured` that share a name, for the names that were measured twice or more."""
        rows: dict[str, list[int]] = {}
        for row, mark in enumerate(self.measured_marks):
            rows.setdefault(mark.name, []).append(row)
        return {name: tuple(own) for name, own in rows.items() if len(own) > 1}

    def target_of(self, name: str) -> Point:
        """Where the mark of that name was sent [mm]."""
        return self._by_name[name].target


def join_measurements(parts: Iterable[Measurements]) -> Measurements:
    """Several files as one board: a name with the same target is a repeat, one with another target
    is a new mark and gets its file's name in front."""
    several = tuple(parts)
    if len(several) == 1:
        return several[0]
    known: dict[str, Point] = {}
    marks: list[Mark] = []
    distances: list[Distance] = []
    for part in several:
        clash = any(known.get(mark.name, mark.target) != mark.target for mark in part.marks)
        own = _renamed(part, f"{Path(part.source).stem}:") if clash else part
        for mark in own.marks:
            known[mark.name] = mark.target
        marks += own.marks
        distances += own.distances
    return Measurements(
        marks=tuple(marks),
        distances=tuple(distances),
        controller=_agreed(several, "controller", "controller"),
        tape_sigma=_agreed(several, "tape_sigma", "tape_sigma_mm"),
        sled_weight=_one_weight(several),
        source=" + ".join(part.source for part in several),
    )


def _rows(points: list[Point | None]) -> np.ndarray:
    return np.array(points, dtype=float).reshape(-1, 2)


def _renamed(part: Measurements, prefix: str) -> Measurements:
    return replace(
        part,
        marks=tuple(replace(mark, name=prefix + mark.name) for mark in part.marks),
        distances=tuple(
            replace(one, between=(prefix + one.between[0], prefix + one.between[1]))
            for one in part.distances
        ),
    )


def _agreed(parts: tuple[Measurements, ...], name: str, key: str) -> str | float | None:
    """What all files that say anything about it say."""
    said = [(part, getattr(part, name)) for part in parts if getattr(part, name) is not None]
    for part, value in said[1:]:
        if value != said[0][1]:
            raise refusal(
                part.source,
                f"{key} is {value} here and {said[0][1]} in {said[0][0].source}",
                remedy="make them equal, or use the files one at a time",
            )
    return said[0][1] if said else None


def _one_weight(parts: tuple[Measurements, ...]) -> float | None:
    """The sled weight [N] of the files if they all share it; each mark carries its own."""
    weights = {part.sled_weight for part in parts}
    return weights.pop() if len(weights) == 1 else None
