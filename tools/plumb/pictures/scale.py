"""How much longer than life arrows are drawn, and how far a picture reaches around its sheet."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.pictures.panel import Spots

Array = np.ndarray
STEPS = (1, 2, 3, 5)  # a factor or scale bar is such a number times a power of ten
BESIDE, ABOVE = 0.05, 0.3  # of the sheet's width and height: as far as arrows may leave the sheet
BELOW = 0.02  # of its height, around a sheet whose arrows stay inside
HEAD = 30.0  # [mm] around the tip of an arrow, for its head
LONG = 0.37  # of the sheet's height: the longest arrow of a few marks
OVERLAP = 1.5  # times the distance between marks: the longest arrow of many


@dataclass(frozen=True)
class View:
    """What a picture shows [mm] from the middle of the sheet."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def width(self) -> float:
        """[mm]."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """[mm]."""
        return self.top - self.bottom

    def holds(self, places: Array, margin: float | Array = 0.0) -> bool:
        """Whether places (n, 2) lie inside, so far from the edges [mm]."""
        x, y = places.T
        return bool(
            (x - margin >= self.left).all()
            and (x + margin <= self.right).all()
            and (y - margin >= self.bottom).all()
            and (y + margin <= self.top).all()
        )


def round_down(value: float) -> float:
    """The largest 1, 2, 3 or 5 times a power of ten that is no larger than the value."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(step * power for step in STEPS if step * power <= value * (1 + 1e-9)))


def pitch_of(count: int, sheet: tuple[float, float]) -> float:
    """The usual distance between marks [mm], if they are spread over the sheet."""
    return float(np.sqrt(sheet[0] * sheet[1] / max(count, 1)))


def exaggeration(panels: Sequence[Spots], sheet: tuple[float, float]) -> float:
    """How much longer than life arrows are drawn: as long as fits, and as their neighbours allow.

    Arrows may leave the sheet a little. Below life size they are never drawn for that.
    """
    largest = max(*(spots.longest for spots in panels), 1e-6)
    pitch = pitch_of(max(map(len, panels)), sheet)
    factor = round_down(min(LONG * sheet[1], OVERLAP * pitch) / largest)
    widest = _around(sheet, ABOVE)
    while factor > 1 and not all(
        widest.holds(spots.tips(factor), factor * spots.spreads + HEAD) for spots in panels
    ):
        factor = round_down(0.99 * factor)
    return factor


def view_of(panels: Sequence[Spots], sheet: tuple[float, float], factor: float) -> View:
    """The sheet with all that is drawn on it and around it."""
    low, high = [], []
    for spots in panels:
        around = (factor * spots.spreads + HEAD)[:, None]
        tips = spots.tips(factor)
        low += [spots.places.min(axis=0) - HEAD, (tips - around).min(axis=0)]
        high += [spots.places.max(axis=0) + HEAD, (tips + around).max(axis=0)]
    edge = _around(sheet, BELOW)
    left, bottom = np.minimum(np.min(low, axis=0), (edge.left, edge.bottom))
    right, top = np.maximum(np.max(high, axis=0), (edge.right, edge.top))
    return View(float(left), float(right), float(bottom), float(top))


def _around(sheet: tuple[float, float], above: float) -> View:
    width, height = (0.5 + BESIDE) * sheet[0], (0.5 + above) * sheet[1]
    return View(-width, width, -height, height)
