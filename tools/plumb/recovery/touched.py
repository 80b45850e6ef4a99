"""Marks touched with the bit: where the hole is, and where the machine shows the bit in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.model.predict import FOUND, Array, believed_lengths, places
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

Point = tuple[float, float]
TOUCH_SIGMA = 0.5  # [mm] of a coordinate: the bit in its hole, and the hole's place


@dataclass(frozen=True)
class Touch:
    """A mark with the bit in it. mm, from the middle of the sheet, y up."""

    name: str
    hole: Point  # where the mark is known to be
    shown: Point  # what the machine says of the bit in it


def believed_chains(settings: MachineSettings, touches: Sequence[Touch]) -> Array:
    """The chains (n, 2) [mm] that the machine believes at each touch. Raises InputError."""
    shown = np.array([touch.shown for touch in touches], dtype=float).reshape(-1, 2)
    try:
        return believed_lengths(settings, shown)
    except ValueError as error:
        raise InputError(f"what the machine shows cannot be: {error}") from None


def places_with(settings: MachineSettings, chains: Array) -> Array:
    """Places (..., 2) [mm] for chains (..., 2) [mm]; NaN where no sled hangs."""
    where, outcome = places(settings.as_plumb_model(), chains.reshape(-1, 2))
    where = np.where((outcome == FOUND)[:, None], where, np.nan)
    return where.reshape(chains.shape)


def sigma_of(settings: MachineSettings, *, taped: bool) -> float:
    """How good a coordinate of a touch is [mm], if nobody says.

    A hole that the machine made by these settings is as good as a touch: what the settings do not
    know moves hole and bit alike. A hole that was measured with a tape is no better than what the
    fit left at marks that it did not see.
    """
    if not taped or settings.fitted is None:
        return TOUCH_SIGMA
    return max(TOUCH_SIGMA, settings.fitted.left_out_rms / 2**0.5)


def turned_back(holes: Array, turn: float) -> Array:
    """Holes (n, 2) [mm] that a tape read from the edges of a sheet, as the machine has them, if the
    sheet is turned [rad] counter-clockwise about its middle."""
    cosine, sine = np.cos(turn), np.sin(turn)
    back: Array = holes.reshape(-1, 2) @ np.array([[cosine, -sine], [sine, cosine]])
    return back
