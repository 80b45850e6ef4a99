"""Smooth fields that no mechanics made, as they would be measured."""

from __future__ import annotations

from collections.abc import Iterator, Sequence

import numpy as np
import scipy

from plumb.board.observations import Observations
from plumb.diagnosis.explanation import Explanation

Array = np.ndarray


def field_columns(frame: Explanation, widths: Sequence[float], least: float) -> Iterator[Array]:
    """For each width what independent normals move of the measured numbers (n, c) [mm], together
    as a field of 1 mm each way does.

    widths: of a field's details, in halves of what the marks span. least [mm^2]: what the columns
    may leave out of its variance at any place.
    """
    rows = frame.board.rows
    sighting, _ = frame.board.problem.predict(frame.unknowns)
    places = sighting.taped.where
    half = np.maximum(np.ptp(places, axis=0) / 2, 1.0)
    apart = np.sum(((places[:, np.newaxis] - places[np.newaxis]) / half) ** 2, axis=2)
    for width in widths:
        yield _measured(_root(np.exp(-apart / (2 * width**2)), least), places, rows)


def _measured(moved: Array, places: Array, rows: Observations) -> Array:
    """Columns (n, 2 c) of the measured numbers; each column of `moved` (visits, c) [mm] acts once
    to the right and once upwards."""
    along = places[rows.distance_rows]
    along = along[:, 1] - along[:, 0]
    along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
    stretched = moved[rows.distance_rows[:, 1]] - moved[rows.distance_rows[:, 0]]
    columns = np.zeros((rows.count, 2, moved.shape[1]))
    for axis in (0, 1):
        columns[axis : rows.measured.size : 2, axis] = moved[rows.mark_rows]
        columns[rows.measured.size :, axis] = along[:, [axis]] * stretched
    return columns.reshape(rows.count, -1)


def _root(covariance: Array, least: float) -> Array:
    """Columns whose covariance it is, but for `least`: few where places lie close together."""
    lower, pivots, rank, _ = scipy.linalg.lapack.dpstrf(covariance, tol=least, lower=1)
    root = np.zeros((len(covariance), rank))
    root[pivots - 1] = np.tril(lower)[:, :rank]
    return root
