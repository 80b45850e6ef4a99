"""Where a word goes next to its mark: clear of arrows, of other words and of the picture's edge."""

from __future__ import annotations

from collections.abc import Sequence

import numpy as np

from plumb.model.ranks import least, ranked
from plumb.pictures.panel import Spots
from plumb.pictures.scale import View

Array = np.ndarray
LETTER, LINE = 0.66, 1.0  # a letter's width, a line's height: of the size of the type
SAMPLES = 24  # points of an arrow that a word should not cover
OUTSIDE, COVERED, SECOND, LATER = 1000.0, 30.0, 2.0, 0.1  # what a place costs: worst first
AROUND = [(np.cos(turn), np.sin(turn)) for turn in np.arange(8) * np.pi / 4]


def label_boxes(
    spots: Spots, words: Sequence[str], *, factor: float, view: View, size: float, gap: float
) -> Array:
    """Left, bottom, right and top [mm] of each word; size of the type and gap to the mark [mm]."""
    obstacles = _obstacles(spots, factor)
    boxes = np.zeros((0, 4))
    for place, error, word in zip(spots.places, spots.errors, words, strict=True):
        extent = np.array([LETTER * size * len(word), LINE * size])
        choices = _choices(place, error, extent, gap)
        # Only what is near can be in the way: with all else, a thousand names take long.
        low, high = np.min(choices, axis=0)[:2], np.max(choices, axis=0)[2:]
        near = obstacles[((obstacles > low) & (obstacles < high)).all(axis=1)]
        costs = [_cost(each, near, boxes, view) + _rank_cost(i) for i, each in enumerate(choices)]
        boxes = np.vstack([boxes, choices[least(costs)]])
    return boxes


def _obstacles(spots: Spots, factor: float) -> Array:
    """Points (n, 2) [mm] of all marks and arrows."""
    shares = np.linspace(0, 1, SAMPLES)[:, None, None]
    points: Array = (spots.places + shares * factor * spots.errors).reshape(-1, 2)
    return points


def _choices(place: Array, error: Array, extent: Array, gap: float) -> list[Array]:
    """Boxes around a place, those away from its arrow first, then the same farther out."""
    away = ranked(AROUND, lambda side: float(np.dot(side, error)))
    boxes = []
    for far in (1.0, 2.2):
        for side in away:
            middle = place + np.array(side) * (far * gap + extent / 2)
            boxes.append(np.concatenate([middle - extent / 2, middle + extent / 2]))
    return boxes


def _rank_cost(rank: int) -> float:
    return LATER * rank + (SECOND if rank >= len(AROUND) else 0.0)


def _cost(box: Array, obstacles: Array, boxes: Array, view: View) -> float:
    low, high = box[:2], box[2:]
    hit = int(((obstacles > low) & (obstacles < high)).all(axis=1).sum())
    over = int(((boxes[:, :2] < high) & (boxes[:, 2:] > low)).all(axis=1).sum())
    return hit + COVERED * over + OUTSIDE * (not view.holds(np.array([low, high])))
