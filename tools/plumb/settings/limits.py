"""What a setting can sensibly be, and the sentence for a value that it cannot be."""

from __future__ import annotations

import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from plumb.settings.controllers import CONTROLLERS
from plumb.settings.machine import FEEDS, MachineSettings
from plumb.text.errors import refusal
from plumb.text.values import refuse_unknown

_INCH = "looks like inches; write millimetres (1 inch = 25.4 mm)"
_NEWTON = "looks like kilograms or pounds; newtons are 9.81 times kilograms, 4.448 times pounds"


@dataclass(frozen=True)
class Limit:
    """The range of a setting, and what a value beyond it looks like."""

    low: float
    high: float
    unit: str
    below: str = ""
    above: str = ""
    zero: bool = False  # exactly zero is allowed too

    def fault(self, value: float) -> str | None:
        """The sentence for a value out of range, or None."""
        if not math.isfinite(value):
            return f"{value} is not a usable number"
        if self.low <= value <= self.high or (self.zero and value == 0):
            return None
        looks = self.below if 0 < value < self.low else self.above if value > self.high else ""
        hint = looks or f"{self.low:g} to {self.high:g} {self.unit} is possible".rstrip()
        return f"{value:g} {self.unit} is out of range; {hint}"


FRAME_LIMITS = {
    "sheet_width": Limit(200, 20000, "mm", below=_INCH),
    "sheet_height": Limit(100, 20000, "mm", below=_INCH),
    "motor_gap": Limit(400, 20000, "mm", below=_INCH),
    "motor_offset": Limit(50, 20000, "mm above the sheet's top edge", below=_INCH),
    "motor_center_x": Limit(-5000, 5000, "mm"),
    "rotation_radius": Limit(20, 1000, "mm", below=_INCH, zero=True),
    "sprocket_radius": Limit(2, 100, "mm", below=_INCH),
    "sled_weight": Limit(30, 1000, "N", below=_NEWTON),
    "chain_weight": Limit(
        1e-5,
        0.02,
        "N/mm",
        above="newtons for each millimetre are needed, 0.00981 times kg/m",
        zero=True,
    ),
}
PUBLISHED_LIMITS = {
    "chain_sag_correction": Limit(-1e5, 1e5, ""),
    "left_tolerance": Limit(-5, 5, "percent"),
    "right_tolerance": Limit(-5, 5, "percent"),
    "chain_elasticity": Limit(0, 1e-3, "1/N"),
    "holey_sled_weight": Limit(30, 1000, "N", below=_NEWTON),
    "chain_length": Limit(500, 65535, "mm", below=_INCH),
    "top_beam_tilt": Limit(-45, 45, "degrees"),
}


def find_fault(settings: MachineSettings) -> tuple[str, str] | None:
    """The name of the first impossible setting and a sentence about it, or None."""
    for name, limit in FRAME_LIMITS.items():
        fault = limit.fault(getattr(settings, name))
        if fault:
            return name, fault
    for name, limit in PUBLISHED_LIMITS.items():
        value = getattr(settings.published, name)
        # The published firmware takes a sled weight of zero or less as a switch.
        if value is None or (name == "holey_sled_weight" and value <= 0):
            continue
        fault = limit.fault(value)
        if fault:
            return name, fault
    for name, value, allowed in (
        ("feed", settings.feed, FEEDS),
        ("controller", settings.controller, CONTROLLERS),
    ):
        if value not in allowed:
            return name, f"'{value}' is not known; write one of {', '.join(allowed)}"
    return None


def check_effects(
    source: str,
    effects: Mapping[str, Mapping[str, float]],
    *,
    known: Mapping[str, Sequence[str]] | None,
) -> None:
    """Refuse effects and parameters that are not in the list of those known (None: no list)."""
    for name, parameters in effects.items():
        place = f"[effects.{name}]"
        try:
            if known is not None:
                refuse_unknown([name], known)
                refuse_unknown(parameters, known[name])
        except ValueError as error:
            raise refusal(source, str(error), place=place) from None
        for parameter, value in parameters.items():
            if not math.isfinite(value):
                raise refusal(
                    source,
                    f"{value} is not a usable number",
                    place=f"{place} {parameter}",
                    remedy="write a finite number",
                )
