"""Smooth fields that no mechanics made: what their columns say is the field's covariance."""

import numpy as np
import pytest
from plumb.bench.boards import MAKER, Hidden, cut, plan
from plumb.diagnosis.explanation import Board, explain, gaussian_process_columns
from plumb.fit.observations import observe

HALF = np.array([1100.0, 500.0])  # [mm] that the marks span


def columns_on(layout, width):
    """The targets of a plan, and what a field of this width moves there."""
    rows = observe(MAKER, cut(Hidden(), layout, seed=1).measurements)
    frame = explain(Board.of(MAKER, rows, sigma=0.5))
    (columns,) = gaussian_process_columns(frame, (width,), 1e-8)
    assert len(columns) == rows.count
    return layout.targets, columns


def alike(first, second, width):
    """How alike a field of this width moves two places."""
    return np.exp(-np.sum(((first - second) / HALF) ** 2) / (2 * width**2))


@pytest.mark.parametrize("width", [0.35, 1.4])
def test_marks_are_moved_the_more_alike_the_closer_they_are(width):
    targets, columns = columns_on(plan(3, 3), width)
    covariance = columns @ columns.T
    for i, j in ((0, 0), (0, 1), (0, 4), (2, 6)):
        wanted = alike(targets[i], targets[j], width)
        for axis in (0, 1):
            assert covariance[2 * i + axis, 2 * j + axis] == pytest.approx(wanted, abs=0.01)
        assert covariance[2 * i, 2 * j + 1] == pytest.approx(0.0, abs=1e-9)


def test_a_distance_grows_by_what_its_ends_move_apart():
    targets, columns = columns_on(plan(3, 3, spans=True), 0.7)
    # The first distance goes from the first mark to the second, to its right.
    apart = 2 - 2 * alike(targets[0], targets[1], 0.7)
    assert columns[0] @ columns[0] == pytest.approx(apart, abs=0.01)
