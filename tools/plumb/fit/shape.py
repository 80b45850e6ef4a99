"""The shape of errors: what no shift and no turn of the sheet takes away."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

Array = np.ndarray


@dataclass(frozen=True)
class Pose:
    """How the measured marks lie as a whole against the predicted marks."""

    shift: tuple[float, float]  # [mm] of the middle of all marks
    rotation: float  # [rad] counter-clockwise
    errors: Array  # (n, 2) [mm] what is left


def best_pose(predicted: Array, measured: Array) -> Pose | None:
    """The rigid motion that brings predicted (n, 2) closest to measured (n, 2) [mm].

    None for fewer than two different places: one place has no shape.
    """
    if len(predicted) < 2 or np.ptp(predicted, axis=0).max() == 0:
        return None
    middle, aim = predicted.mean(axis=0), measured.mean(axis=0)
    before, after = predicted - middle, measured - aim
    # tan(rotation) = sum of cross products / sum of dot products (Procrustes in the plane)
    cross = np.sum(before[:, 0] * after[:, 1] - before[:, 1] * after[:, 0])
    rotation = float(np.arctan2(cross, np.sum(before * after)))
    cosine, sine = np.cos(rotation), np.sin(rotation)
    turned = before @ np.array([[cosine, sine], [-sine, cosine]])
    shift = aim - middle
    return Pose((float(shift[0]), float(shift[1])), rotation, after - turned)
