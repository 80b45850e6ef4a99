"""How the numbers of effects are measured by hand: what is read, and how the number follows.

A number is scale * curve(reading - zero). The steps and the accuracies are those of plumb next.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from typing import Literal

from plumb.settings.machine import GRAVITY, MachineSettings

Curve = Literal["straight", "square", "tangent squared"]  # of the tangent: degrees
Unit = Literal["mm", "kg", "g", "degrees"]

LINKS = 635.0  # [mm] of 100 links of a new chain
PULL = 50.0  # [N] at a motor arm
HUNG = 10 * GRAVITY  # [N] on a chain
CHAIN = 3000.0  # [mm] that is weighed, or stretched
METRE = 1000.0  # [mm]
GRAMS = 1000.0  # of a kilogram


@dataclass(frozen=True)
class Reading:
    """What somebody reads off a rule or a scale for a number of an effect."""

    title: str
    usual: float  # how far a careful reading may be off
    scale: float = 1.0
    unit: Unit = "mm"
    curve: Curve = "straight"
    zero: float = 0.0
    digits: int = 1
    marked: str = ""  # on the drawing

    def value(self, read: float) -> float:
        """The number that a reading says."""
        return self.scale * CURVES[self.curve][0](read - self.zero)

    def read(self, value: float) -> float:
        """What would be read for a number."""
        return self.zero + CURVES[self.curve][1](value / self.scale)


def readings(settings: MachineSettings, sled_weight: float) -> Mapping[str, Reading]:
    """The readings by the names of their numbers, for this sheet and this weight [N]."""
    return {**_of_chains(sled_weight), **_of_frame_and_sled(), **_of_sheet_and_tape(settings)}


def _of_chains(sled_weight: float) -> dict[str, Reading]:
    pitch = {
        f"chain_pitch.{side}": Reading(
            f"100 links of the {side} chain", 0.2, 1 / LINKS, zero=LINKS, marked="chain"
        )
        for side in ("left", "right")
    }
    zero = {
        f"chain_zero.{side}": Reading(
            f"how far the {side} chain is out at 12 o'clock", 1.0, marked="chain"
        )
        for side in ("left", "right")
    }
    per_gram = 1 / (GRAMS * CHAIN * sled_weight / GRAVITY)
    weighed = Reading("3 m of chain on a scale", 10.0, per_gram**2 / 24, "g", "square", digits=0)
    longer = Reading(
        "how much longer 3 m of chain become under 10 kg", 0.2, 1 / (CHAIN * HUNG), digits=2
    )
    return {
        **pitch,
        **zero,
        "chain_sag.weight_ratio_squared": weighed,
        "chain_stretch.compliance": longer,
    }


def _of_frame_and_sled() -> dict[str, Reading]:
    return {
        "motor_level.height_difference": Reading("how much higher the right motor is", 1.0),
        "frame_flex.inward": Reading(
            "how far a motor moves inwards under 50 N", 0.1, 1 / PULL, digits=2
        ),
        "frame_flex.downward": Reading(
            "how far a motor moves down under 50 N", 0.1, 1 / PULL, digits=2
        ),
        "chain_plane.gap_squared": Reading(
            "how much farther from the sheet the sprockets are than the ring", 3.0, curve="square"
        ),
        "frame_lean.tangent_squared": Reading(
            "how far the frame leans", 0.5, unit="degrees", curve="tangent squared"
        ),
        "sled_swing.right": Reading("how far the bit is right of the ring's centre", 0.3),
        "sled_swing.up": Reading("how far the bit is above the ring's centre", 0.3),
    }


def _of_sheet_and_tape(settings: MachineSettings) -> dict[str, Reading]:
    width, height = settings.sheet
    # Of two diagonals that differ by little: their squares differ by twice a diagonal times that.
    per_mm = math.hypot(width, height) / (2 * width * height)
    return {
        "sheet_skew.angle": Reading(
            "how much longer the diagonal from the top left corner is", 1.0, per_mm
        ),
        "tape_scale.strain": Reading(
            "how much too much the tape reads over a metre", 0.1, 1 / METRE, digits=2
        ),
    }


def _root(number: float) -> float:
    return math.sqrt(max(number, 0.0))


# Each with its inverse, for readings from zero on.
CURVES: Mapping[str, tuple[Callable[[float], float], Callable[[float], float]]] = {
    "straight": (lambda read: read, lambda number: number),
    "square": (lambda read: read * read, _root),
    "tangent squared": (
        lambda read: math.tan(math.radians(read)) ** 2,
        lambda number: math.degrees(math.atan(_root(number))),
    ),
}
