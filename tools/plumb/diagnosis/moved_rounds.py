"""Rounds that do not go together, as they would be measured: a sheet moved, chains hung again."""

from __future__ import annotations

import numpy as np

from plumb.diagnosis.explanation import Explanation
from plumb.model.catalogue import ZEROING_NAMES

Array = np.ndarray
MOVED = 6.0  # [mm] spread of a sheet laid elsewhere, and of a chain's zero


def rounds_columns(frame: Explanation) -> Array | None:
    """What independent normals move of the measured numbers (n, c) [mm], together as what may have
    changed between rounds does; None if there is a single round."""
    board, rows = frame.board, frame.board.rows
    number = np.concatenate([np.repeat(rows.rounds[rows.mark_rows], 2), rows.distance_rounds])
    later = np.unique(number)[1:]
    if not len(later):
        return None
    names, scale = board.problem.names, board.problem.scale
    zeros = [names.index(name) for name in ZEROING_NAMES]
    slopes = frame.slopes[: rows.count] * board.sigma
    moved = np.zeros((rows.count, 2))
    for axis in (0, 1):
        moved[axis : rows.measured.size : 2, axis] = MOVED
    changed = np.hstack([moved, slopes[:, zeros] * MOVED / scale[zeros], slopes[:, board.frame]])
    return np.hstack([changed * (number == each)[:, np.newaxis] for each in later])
