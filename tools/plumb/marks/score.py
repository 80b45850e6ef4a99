"""The score of the Calibration Benchmark Test, as the community computes it.

Two numbers: the mean absolute error of the long spans (three of 1905 mm, three of 900 mm) and of
the sides of the 100 mm squares (GroundControl, pull requests 576 and 580, January 2018).
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.marks.benchmark import span_kind
from plumb.marks.model import Measurements, Point

FULL_LONG, FULL_SMALL = 6, 8  # readings of the published cut; a square in the middle makes 10


@dataclass(frozen=True)
class Score:
    """How far the spans of the test are off [mm]; None where none was measured."""

    long: float | None
    small: float | None
    long_count: int
    small_count: int

    def __str__(self) -> str:
        """As people post it: 1.23-0.45."""
        return "-".join("?" if mean is None else f"{mean:.2f}" for mean in (self.long, self.small))

    @property
    def complete(self) -> bool:
        """Whether all readings of the published test are there."""
        return self.long_count >= FULL_LONG and self.small_count >= FULL_SMALL


def score_of(measurements: Measurements, errors: Sequence[float]) -> Score | None:
    """The score of errors (m,) [mm] of the distances; None if no span of the test is among them."""
    errors_of: dict[str, list[float]] = {"long": [], "small": []}
    for ends, error in zip(measurements.distance_targets, errors, strict=True):
        kind = span_kind((_point(ends[0]), _point(ends[1])))
        if kind:
            errors_of[kind].append(abs(float(error)))
    if not errors_of["long"] and not errors_of["small"]:
        return None
    means = {kind: float(np.mean(spans)) if spans else None for kind, spans in errors_of.items()}
    return Score(means["long"], means["small"], len(errors_of["long"]), len(errors_of["small"]))


def _point(place: np.ndarray) -> Point:
    return float(place[0]), float(place[1])


def score_as_cut(measurements: Measurements) -> Score | None:
    """The score of what was cut: readings less what they should have been."""
    ends = measurements.distance_targets
    nominal = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    return score_of(measurements, measurements.distance_lengths - nominal)
