"""The G-code for planned visits: a touch of the bit at each, come to from the prescribed side."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from plumb.grid.options import DEPTH, Grid
from plumb.plan.planned_visits import Visits

Array = np.ndarray
USUAL = Grid()  # heights, feeds and the way into a mark, as a grid has them


def visit_lines(visits: Visits) -> Iterator[list[str]]:
    """The lines for each visit; between two of them somebody may hang a weight on the sled."""
    for target, side in zip(visits.targets, visits.approaches, strict=True):
        yield touch(target, _lead_in(side))


def touch(target: Array, lead_in: Array) -> list[str]:
    """The lines for a mark at a target [mm], entered along a vector [mm]."""
    x, y = target - lead_in
    return [
        f"G0 Z{USUAL.safe_height:g}",
        f"G0 X{x:.3f} Y{y:.3f}",
        f"G1 X{target[0]:.3f} Y{target[1]:.3f} F{USUAL.feed:g}",
        f"G1 Z{-DEPTH[USUAL.mode]:g} F{USUAL.plunge_feed:g}",
        f"G0 Z{USUAL.safe_height:g}",
    ]


def _lead_in(side: Array) -> Array:
    """The way into a mark [mm] for a unit vector; the usual way if the side does not matter."""
    usual = np.array(USUAL.approach)
    return np.asarray(side * np.hypot(*usual)) if side.any() else usual
