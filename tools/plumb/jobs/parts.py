"""The parts of a job: what is cut in one neighbourhood."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from plumb.jobs.moves import Moves, Samples
from plumb.model.predict import Array

CELL = 10.0  # [mm] cuts in the same cell or in neighbours belong to one part
ALL_EIGHT = np.ones((3, 3))


@dataclass(frozen=True)
class Part:
    """Cuts that lie together."""

    lines: tuple[int, int]  # the first and the last
    low: tuple[float, float]  # [mm] lower left corner
    high: tuple[float, float]  # [mm] upper right corner
    deepest: float  # [mm] z
    places: Array  # (k, 2) [mm]

    @property
    def size(self) -> tuple[float, float]:
        """Width and height [mm], by the middle of the bit."""
        return self.high[0] - self.low[0], self.high[1] - self.low[1]


def parts_of(moves: Moves, samples: Samples) -> tuple[Part, ...]:
    """The parts of a job in the order in which they are begun; `samples` of all its moves."""
    cut = moves.cut[samples.move]
    if not cut.any():
        return ()
    places, rows, z = samples.places[cut], samples.move[cut], samples.z[cut]
    cells = np.floor((places - places.min(axis=0)) / CELL).astype(int)
    grid = np.zeros(cells.max(axis=0) + 1, dtype=bool)
    grid[tuple(cells.T)] = True
    numbers, _ = scipy.ndimage.label(grid, structure=ALL_EIGHT)
    part_of = numbers[tuple(cells.T)]
    lines = moves["line"][rows]
    order = np.argsort(part_of, kind="stable")
    ends = np.flatnonzero(np.diff(part_of[order])) + 1
    parts = [_part(places[each], lines[each], z[each]) for each in np.split(order, ends)]
    return tuple(sorted(parts, key=lambda part: part.lines))


def _part(places: Array, lines: Array, z: Array) -> Part:
    (left, low), (right, high) = places.min(axis=0), places.max(axis=0)
    return Part(
        lines=(int(lines.min()), int(lines.max())),
        low=(float(left), float(low)),
        high=(float(right), float(high)),
        deepest=float(z.min()),
        places=places,
    )
