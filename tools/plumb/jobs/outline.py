"""G-code that goes round a job with the bit above the sheet, slowly, before anything is cut."""

from __future__ import annotations

import numpy as np
import scipy

from plumb.jobs.moves import Moves, Samples, safe_height
from plumb.model.predict import Array

FEED = 500.0  # [mm/min]


def hull_of(moves: Moves, samples: Samples) -> Array:
    """The corners (k, 2) [mm] of the smallest convex shape that holds all cuts."""
    places = samples.places[moves.cut[samples.move]]
    places = np.unique(np.round(places, 3), axis=0)
    spread = places - places.mean(axis=0) if len(places) else places
    if len(places) < 3 or np.linalg.matrix_rank(spread, tol=1e-3) < 2:
        return np.asarray(places[[0, -1]] if len(places) else places)
    return np.asarray(places[scipy.spatial.ConvexHull(places).vertices])


def outline_of(moves: Moves, samples: Samples, *, name: str) -> str:
    """A program that traces the hull, back to its first corner."""
    corners = hull_of(moves, samples)
    if not len(corners):
        return f"(plumb: {comment_of(name)} cuts nothing)\n"
    safe = safe_height(moves)
    lines = [
        f"(plumb: outline of {comment_of(name)}, bit {safe:.1f} mm above the sheet)",
        "G21 G90 G94 G17",
        f"G0 Z{safe:.3f}",
        f"G0 X{corners[0, 0]:.3f} Y{corners[0, 1]:.3f}",
    ]
    ring = [*corners[1:], corners[0]]
    lines += [f"G1 X{x:.3f} Y{y:.3f} F{FEED:g}" for x, y in ring]
    return "\n".join([*lines, "M5", ""])


def comment_of(name: str) -> str:
    """A file's name as a comment can hold it."""
    kept = [c if c.isascii() and c.isprintable() and c not in "()" else "_" for c in name]
    return "".join(kept)[:60]
