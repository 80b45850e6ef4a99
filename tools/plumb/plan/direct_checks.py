"""Numbers of the machine that its owner can measure directly, how well, and how long it takes.

Effects bring their checks along. The accuracies are what a careful owner gets with the tool that is
named.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from plumb.model.catalogue import every_effect
from plumb.model.python_effect import DirectCheck


@dataclass(frozen=True)
class NumberCheck:
    """How numbers of the machine are measured directly."""

    direct: DirectCheck
    sigmas: Mapping[str, float]  # of each parameter, or number of the frame [its unit]


def effect_checks() -> dict[str, NumberCheck]:
    """The checks of all effects that have any."""
    return {
        effect["name"]: NumberCheck(
            DirectCheck(**effect["check"]),
            {
                parameter["name"]: parameter["sigma"]
                for parameter in effect["parameters"]
                if parameter["sigma"]
            },
        )
        for effect in every_effect()
        if effect["check"]
    }


FRAME_CHECKS: Mapping[str, NumberCheck] = {
    "motor_gap": NumberCheck(
        DirectCheck(
            "the gap between the motors",
            "Measure between the sprocket centres to 1 mm, with a chain pulled tight or a steel "
            "tape.",
            "mm",
            10.0,
        ),
        {"motor_gap": 1.0},
    ),
    "motor_height": NumberCheck(
        DirectCheck(
            "the height of the motors",
            "Measure from the sheet's top edge up to the sprocket centres to 1 mm, on both sides.",
            "the mean of both sides and half the sheet's height, mm",
            8.0,
        ),
        {"motor_height": 1.0},
    ),
    "rotation_radius": NumberCheck(
        DirectCheck(
            "the rotation radius",
            "Measure from the bit to the first link pin of each chain to 0.5 mm.",
            "mm",
            5.0,
        ),
        {"rotation_radius": 0.5},
    ),
}
