"""How far the hanging sled gives way to a force along the sheet, such as friction."""

from __future__ import annotations

import numpy as np

from plumb import _core
from plumb.model.predict import Array


def compliance(values: Array, *, over_top: bool, points: Array) -> Array:
    """Motion (n, 2 of place, 2 of force) [mm/N] with the chains held; zero where none can hang.

    A side force changes both tensions, so whatever answers to tension (sag and stretch above all)
    moves the sled. The core works it out from all effects of the values.
    """
    where = np.ascontiguousarray(points, dtype=float).reshape(-1, 2)
    # Friction does not ask how near the ring may come to a sprocket.
    return _core.reach(values, over_top, where, least_free=0.0)["compliance"]
