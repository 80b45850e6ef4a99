"""A fitted machine as the numbers that the firmware keeps, read back by the firmware."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import inf, tau

import numpy as np

from plumb.firmware.settings import every_setting, format_value, machine_of
from plumb.model.predict import FOUND, lengths, library
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

RING, OVER_TOP, OFF_BOTTOM = 2, 1, 2  # what $7 and $38 say
# What a client sends in addition to the numbers of the frame: without it z stands still.
CLIENT_NUMBERS: Mapping[int, float] = {29: 1300, 15: 1000, 18: 18}
WORST = 0.01  # [mm] of chain by which rounding to the firmware's floats may move a place


@dataclass(frozen=True)
class Number:
    """A setting as it is sent."""

    number: int
    name: str
    text: str
    unit: str

    @property
    def line(self) -> str:
        """The line that sets it."""
        return f"${self.number}={self.text}"


def firmware_numbers(settings: MachineSettings) -> tuple[Number, ...]:
    """Every number that says where the sled of this machine hangs, in the order of the dump.

    The published corrections are zero, as the effects hold all there is. Raises InputError if the
    firmware would refuse a number, or would compute chains that differ by more than WORST.
    """
    values = values_of(settings)
    rows = {setting.number: setting for setting in every_setting()}
    numbers = tuple(
        Number(number, rows[number].name, format_value(value).strip(), rows[number].unit)
        for number, value in sorted(values.items())
    )
    _refuse_what_differs(settings, {row.number: float(row.text) for row in numbers})
    return numbers


def values_of(settings: MachineSettings) -> dict[int, float]:
    numbers = {
        0: settings.sheet_width,
        1: settings.sheet_height,
        2: settings.motor_gap,
        3: settings.motor_offset,
        7: RING,
        8: settings.rotation_radius,
        13: tau * settings.sprocket_radius,
        37: 0.0,
        38: OVER_TOP if settings.feed == "top" else OFF_BOTTOM,
        40: 0.0,
        41: 0.0,
        62: settings.sled_weight,
        63: settings.chain_weight,
        64: settings.motor_center_x,
    }
    for effect in library():
        for parameter in effect["parameters"]:
            if parameter["setting"] is not None:
                size = settings.effect(effect["name"], parameter["name"])
                numbers[parameter["setting"]] = size
    return numbers


def _refuse_what_differs(settings: MachineSettings, numbers: dict[int, float]) -> None:
    try:
        apart = chains_apart(settings, numbers)
    except ValueError as error:
        raise InputError(f"the firmware refuses these settings: {error}") from None
    if apart > WORST:
        raise InputError(
            f"the firmware would pay out chain that differs by {apart:.3f} mm from this machine's: "
            "check its numbers for sizes that no real machine has"
        )


def chains_apart(settings: MachineSettings, numbers: Mapping[int, float]) -> float:
    """By how much the firmware's chains with these numbers differ from the machine's, over its
    sheet [mm]; infinite where the sled hangs nowhere.

    Raises ValueError in the firmware's words for a number that it refuses.
    """
    theirs = machine_of(numbers, sheet=settings.sheet)
    half = np.array(settings.sheet) / 2 - 50
    places = half * np.array([(x, y) for x in (-1, 0, 1) for y in (-1, 0, 1)])
    ours, outcome = lengths(settings, places)
    kept, kept_outcome = lengths(theirs, places)
    reached = (outcome == FOUND) & (kept_outcome == FOUND)
    return float(np.abs(ours - kept)[reached].max()) if reached.any() else inf
