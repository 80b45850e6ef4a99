"""Smooth fields that no mechanics made, as they would be measured."""

from __future__ import annotations

import numpy as np

from plumb.diagnosis.explanation import Explanation

Array = np.ndarray


def field_covariance(frame: Explanation, width: float) -> Array:
    """Of the measured numbers (n, n) [mm^2] by a field of 1 mm each way.

    width: of its details, in halves of what the marks span.
    """
    rows = frame.board.rows
    sighting, _ = frame.board.problem.predict(frame.unknowns)
    places = sighting.taped.where
    half = np.maximum(np.ptp(places, axis=0) / 2, 1.0)
    apart = (places[:, np.newaxis] - places[np.newaxis]) / half
    alike = np.exp(-np.sum(apart**2, axis=2) / (2 * width**2))
    along = places[rows.distance_rows]
    along = along[:, 1] - along[:, 0]
    along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
    # How a visit's move right and up (columns) shows in each measured number.
    shown = np.zeros((rows.count, len(places), 2))
    marks, spans = np.arange(len(rows.measured)), rows.measured.size + np.arange(len(along))
    for axis in (0, 1):
        shown[2 * marks + axis, rows.mark_rows, axis] = 1.0
        shown[spans, rows.distance_rows[:, 1], axis] = along[:, axis]
        shown[spans, rows.distance_rows[:, 0], axis] = -along[:, axis]
    covariance: Array = np.einsum("nva,vw,mwa->nm", shown, alike, shown, optimize=True)
    return covariance
