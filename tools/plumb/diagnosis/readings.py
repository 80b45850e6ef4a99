"""Single readings: a mark's place or a distance, and how far a reading is off."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from plumb.board.observations import Observations

Array = np.ndarray
EXPLANATIONS, REPEATS = "every explanation", "its repeats"  # what a reading may disagree with


@dataclass(frozen=True)
class Reading:
    """A reading: a mark's place or a distance, by its index among its kind."""

    index: int
    is_mark: bool

    @property
    def size(self) -> int:
        """How many numbers were read."""
        return 2 if self.is_mark else 1

    def numbers(self, rows: Observations) -> Array:
        """Its entries among all measured numbers."""
        if self.is_mark:
            return np.array([2 * self.index, 2 * self.index + 1])
        return np.array([rows.measured.size + self.index])

    def place(self, rows: Observations) -> int:
        """Its place among all readings."""
        return self.index if self.is_mark else len(rows.measured) + self.index


@dataclass(frozen=True)
class Shift:
    """How far a reading is off by an explanation, or by its repeats."""

    reading: Reading
    offset: Array  # (2,) or (1,) [mm] read less what the rest says
    sigma: Array  # of each [mm]
    drop: float  # of chi-square when the reading is set free
    against: str = EXPLANATIONS  # what it disagrees with, for people
    is_one_of_two: bool = False  # of the same mark, and the other may be the wrong one


def readings_of(rows: Observations) -> list[Reading]:
    """All readings."""
    marks = [Reading(i, True) for i in range(len(rows.measured))]
    return marks + [Reading(i, False) for i in range(len(rows.distances))]


def without(rows: Observations, reading: Reading) -> Observations:
    """The observations without a reading; the visit itself stays."""
    if not reading.is_mark:
        return replace(
            rows,
            distance_rows=np.delete(rows.distance_rows, reading.index, axis=0),
            distances=np.delete(rows.distances, reading.index),
            distance_rounds=np.delete(rows.distance_rounds, reading.index),
        )
    return replace(
        rows,
        mark_rows=np.delete(rows.mark_rows, reading.index),
        measured=np.delete(rows.measured, reading.index, axis=0),
        targets=np.delete(rows.targets, reading.index, axis=0),
        names=rows.names[: reading.index] + rows.names[reading.index + 1 :],
    )
