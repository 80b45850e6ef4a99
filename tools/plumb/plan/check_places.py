"""Where to cut check marks: reachable places, as far as can be from marks that were fitted."""

from __future__ import annotations

import numpy as np

from plumb.model.ranks import greatest
from plumb.plan.sites import grid, usable
from plumb.settings.machine import MachineSettings

Array = np.ndarray
FINE = (15, 9)  # places across and up that are considered
COUNT = 2
BELOW = 40.0  # [mm] that a sled comes from below, so this far down it must hang too


def check_places(settings: MachineSettings, known: Array, count: int = COUNT) -> Array:
    """The places (count, 2) [mm], given the targets (n, 2) of the marks there are."""
    places = grid(settings.sheet, *FINE)
    for shift in (0.0, BELOW):
        places = places[usable(settings, places - [0.0, shift], settings.sled_weight)]
    taken = np.asarray(known, dtype=float).reshape(-1, 2)
    chosen: list[Array] = []
    while len(chosen) < count and len(places):
        gaps = np.linalg.norm(places[:, np.newaxis] - np.vstack([taken, *chosen]), axis=2)
        best = places[greatest(gaps.min(axis=1, initial=np.inf))]
        chosen.append(best)
    return np.array(chosen).reshape(-1, 2)
