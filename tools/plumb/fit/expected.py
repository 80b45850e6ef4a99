"""How far marks will be off before anything is measured, by what is known of the machine.

Each number of the frame is wrong by its stated error, and each effect that the settings leave out
may be there in its typical size, all independent of each other.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from plumb.board.sighting import SHEET_ROTATION
from plumb.fit.fit import rms
from plumb.fit.problem import PRIORS
from plumb.fit.shape import best_pose
from plumb.model.catalogue import parameter_words
from plumb.model.predict import (
    FOUND,
    NAMES,
    Array,
    believed_lengths,
    places_with_slopes,
    values_of,
)
from plumb.settings.machine import FRAME_FIELDS, MachineSettings
from plumb.text.shown import worded

# [mm, N] how far a number may be off that no fit moves, before the owner measured it.
WIDE = {"rotation_radius": 5.0, "sled_weight": 15.0}
COLUMNS, ROWS, MARGIN = 7, 5, 100.0  # of the places that are looked at; [mm] from the edge


@dataclass(frozen=True)
class Expected:
    """What is normal, RMS over the sheet [mm]."""

    frame: float  # by the frame's numbers and where the sheet lies
    shape: float  # by the same, the sheet laid at its best
    effects: float  # by effects that the settings leave out, the sheet laid at its best

    @property
    def whole(self) -> float:
        """All of it, as a tape from the sheet's edges reads it."""
        return float(np.hypot(self.frame, self.effects))

    @property
    def all_shape(self) -> float:
        """All of it, the sheet laid at its best."""
        return float(np.hypot(self.shape, self.effects))


def expected_priors(known: Mapping[str, float]) -> dict[str, float]:
    """How far each number of the frame may be off, with those that the owner knows better."""
    frame = {name: sigma for name, sigma in known.items() if "." not in name}
    return {**PRIORS, **WIDE, **frame}


def expected_sentence(expected: Expected | None) -> str:
    """What is normal, for people; empty if no mark can be made."""
    if expected is None:
        return ""
    return (
        "Before anything is corrected, marks may well be off by "
        f"{worded(expected.all_shape, 1)} among each other, and all together by "
        f"{worded(expected.whole, 0)} where the sheet hangs otherwise. That is normal."
    )


def expected_error(
    settings: MachineSettings, priors: Mapping[str, float], *, at: Array | None = None
) -> Expected:
    """How far marks will be off, all over the sheet or at places (n, 2) [mm].

    Raises ValueError where the controller cannot go.
    """
    model = settings.as_plumb_model()
    targets = places_over(settings.sheet) if at is None else at
    where, slopes, outcome = places_with_slopes(
        values_of(model),
        over_top=model.feed == "top",
        chains=believed_lengths(settings, targets),
    )
    good = outcome == FOUND
    where, slopes = where[good], slopes[good]
    of_frame = [
        slopes[:, :, NAMES.index(name)] * priors[name]
        for name in FRAME_FIELDS
        if priors.get(name) and name in NAMES
    ]
    turned = np.column_stack([-where[:, 1], where[:, 0]]) * priors.get(SHEET_ROTATION, 0.0)
    of_effects = [
        slopes[:, :, NAMES.index(name)] * abs(float(words["typical"]))
        for name, words in parameter_words().items()
        if name in NAMES and not settings.effect(*name.split("."))
    ]
    return Expected(
        frame=_together([*of_frame, turned]),
        shape=_together([_shape(where, moved) for moved in of_frame]),
        effects=_together([_shape(where, moved) for moved in of_effects]),
    )


def expected_anywhere(settings: MachineSettings, priors: Mapping[str, float]) -> Expected | None:
    """How far marks will be off all over the sheet; None where no sled hangs there."""
    try:
        expected = expected_error(settings, priors)
    except ValueError:
        return None
    return expected if np.isfinite(expected.whole) else None


def places_over(sheet: tuple[float, float]) -> Array:
    """Places (n, 2) [mm] all over a sheet."""
    width, height = sheet
    x = np.linspace(-width / 2 + MARGIN, width / 2 - MARGIN, COLUMNS)
    y = np.linspace(height / 2 - MARGIN, -height / 2 + MARGIN, ROWS)
    places: Array = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    return places


def _shape(where: Array, moved: Array) -> Array:
    """What is left of a motion (n, 2) when the sheet is shifted and turned back."""
    pose = best_pose(where, where + moved)
    return pose.errors if pose else np.zeros_like(moved)


def _together(several: list[Array]) -> float:
    """RMS of independent motions (n, 2), added up."""
    return float(np.sqrt(sum(rms(moved) ** 2 for moved in several)))
