"""How numbers of the machine are measured by hand: what is read, and how the number follows.

A number is scale * curve(reading - zero). The steps and the accuracies are those of plumb next.
"""

from __future__ import annotations

import math
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from typing import Literal

from plumb.settings.machine import GRAVITY, MachineSettings
from plumb.text.values import INCH, in_inches, length_in, number_in, unit

Curve = Literal["straight", "square", "tangent squared"]  # of the tangent: degrees
Unit = Literal["mm", "kg", "g", "degrees"]

LINKS = 635.0  # [mm] of 100 links of a new chain
PULL = 50.0  # [N] at a motor arm
HUNG = 10 * GRAVITY  # [N] on a chain
CHAIN = 3000.0  # [mm] that is weighed, or stretched
METRE = 1000.0  # [mm]
WEIGHT = "sled_weight"
WEIGHED = 0.2  # [kg] to which a sled is weighed
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
        """Return the number that a reading says."""
        return self.scale * CURVES[self.curve][0](read - self.zero)

    def read(self, value: float) -> float:
        """Return what would be read for a number."""
        return self.zero + CURVES[self.curve][1](value / self.scale)


def readings(settings: MachineSettings, sled_weight: float) -> Mapping[str, Reading]:
    """Return the readings by the names of effects' numbers, for this sheet and this weight [N]."""
    return {
        **_of_chains(sled_weight),
        **_of_arms_and_sled(),
        **_of_sheet_and_tape(settings),
    }


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


def _of_arms_and_sled() -> dict[str, Reading]:
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


# What somebody types: a reading with the unit of the rule or scale that showed it.

VALUE = "VALUE"  # stands where the owner types his number
INCHES = ("inches", "inch", "in", '"')
UNITS = ("mm", *INCHES, "kg", "g", "degrees")


def to_fill_in(name: str, sigma: float, settings: MachineSettings) -> str:
    """Return the words of --checked for a number that is measured next: `motor_gap=VALUE+-1mm`.

    sigma: of a number that nobody reads off a rule or scale [its unit].
    """
    reading = _reading_of(name, settings)
    if reading is None:
        return f"{name}={VALUE}+-{sigma:g}"
    if reading.unit == "mm" and unit() == "inch":
        return f"{name}={VALUE}+-{reading.usual / INCH:.1g}in"
    return f"{name}={VALUE}+-{reading.usual:g}{reading.unit}"


def what_to_type(names: Iterable[str], settings: MachineSettings) -> str:
    """Return what stands for VALUE, for people; "" for numbers that nobody reads."""
    read = [reading for name in names if (reading := _reading_of(name, settings))]
    if not read:
        return ""
    shown = "inches" if read[0].unit == "mm" and unit() == "inch" else read[0].unit
    titles = "; then ".join(reading.title for reading in read)
    return in_inches(f"{VALUE}: {titles}, in {shown}.")


def number_read(
    name: str, value: str, sigma: str, typed: str, settings: MachineSettings
) -> tuple[float, float]:
    """Return a number and its error [its unit] by what was read, in a unit of UNITS.

    Raises ValueError for what is no number, and for a unit in which nobody reads it.
    """
    reading = _reading_of(name, settings)
    if reading is None:
        raise ValueError(f"nobody reads that in {typed}: write the number without a unit")
    is_length = typed == "mm" or typed in INCHES
    if reading.unit != ("mm" if is_length else typed):
        raise ValueError(f"it is read in {reading.unit}, not in {typed}")
    if is_length:
        size = INCH if typed in INCHES else 1.0
        read, off = length_in(value, unit=size), length_in(sigma, unit=size)
    else:
        read, off = number_in(value), number_in(sigma)
    number, more, less = map(reading.value, (read, read + off, read - off))
    return number, max(abs(more - number), abs(number - less))


def _reading_of(name: str, settings: MachineSettings) -> Reading | None:
    return {**_of_frame(settings), **readings(settings, settings.sled_weight)}.get(name)


def _of_frame(settings: MachineSettings) -> dict[str, Reading]:
    edge = settings.sheet_height / 2
    return {
        "motor_gap": Reading("the gap between the motors", 1.0),
        "motor_height": Reading(
            "how far the motors are above the sheet's top edge, the mean of both", 1.0, zero=-edge
        ),
        "rotation_radius": Reading("from the bit to the first link pin of a chain", 0.5),
        WEIGHT: Reading("the weight of the sled", WEIGHED, GRAVITY, "kg"),
    }
