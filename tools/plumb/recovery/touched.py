"""Marks touched with the bit: where the hole is, and where the machine shows the bit in it."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import combinations
from math import dist

import numpy as np

from plumb.model.predict import FOUND, Array, believed_lengths, places
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

Point = tuple[float, float]
TOUCH_SIGMA = 0.5  # [mm] of a coordinate: the bit in its hole, and the hole's place
MISREAD = 100.0  # [mm] of a touch: a slip of two links shows less
SAME = 3.0  # [mm] between two holes: a bit is wider
FAR = 50.0  # [mm] between holes from which on they are two places; nearer, they err alike


@dataclass(frozen=True)
class Touch:
    """A mark with the bit in it. mm, from the middle of the sheet, y up."""

    name: str
    hole: Point  # where the mark is known to be
    shown: Point  # what the machine says of the bit in it


def refuse_repeated(touches: Sequence[Touch]) -> None:
    """Raise InputError for a hole that is given twice: what it says counts once."""
    for (first, earlier), (second, later) in combinations(enumerate(touches, 1), 2):
        if dist(earlier.hole, later.hole) < SAME:
            raise InputError(
                f"touch {second} is touch {first} again; touch another hole far from it"
            )


def are_apart(touches: Sequence[Touch]) -> bool:
    """Whether two of the holes are far enough apart to be two places."""
    return any(dist(left.hole, right.hole) >= FAR for left, right in combinations(touches, 2))


def lost_sign(touch: Touch) -> str:
    """The coordinate, x or y, whose sign was lost: the other sign shows the bit near the hole."""
    (x, y), (shown_x, shown_y) = touch.hole, touch.shown
    if dist(touch.hole, touch.shown) <= MISREAD:
        return ""
    flipped = {"x": (-shown_x, shown_y), "y": (shown_x, -shown_y)}
    near = [name for name, place in flipped.items() if dist((x, y), place) <= MISREAD]
    return near[0] if near else ""


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
