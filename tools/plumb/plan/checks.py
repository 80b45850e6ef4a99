"""Numbers of the machine that its owner can measure directly, how well, and how long it takes.

The accuracies are what a careful owner gets with the tool that is named. Where a number needs a
dial that few have read right (the phase of a sprocket's runout), no check is offered.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class DirectCheck:
    """How a number is measured directly."""

    title: str
    do: str
    value: str  # how VALUE follows from what was measured
    sigmas: Mapping[str, float]  # of each parameter [its unit]
    minutes: float


CHECKS: Mapping[str, DirectCheck] = {
    "motor_level": DirectCheck(
        "a level over the motors",
        "Lay a spirit level on a straight edge, or a water hose, across both sprockets and measure "
        "how much higher the right one is, to 1 mm.",
        "mm, negative if the left one is higher",
        {"height_difference": 1.0},
        8.0,
    ),
    "frame_flex": DirectCheck(
        "a gauge at the motor arms",
        "Pull each motor inwards, then down, with 50 N (a luggage scale) and read on a dial gauge "
        "how far the sprocket moves, to 0.1 mm.",
        "mm moved over newtons pulled, inwards and downwards",
        {"inward": 0.002, "downward": 0.002},
        20.0,
    ),
    "sled_swing": DirectCheck(
        "the sled turned on its ring",
        "Turn the sled by hand on its ring and look how the bit wanders: it is off the ring's "
        "centre by half the circle that it draws. Measure to 0.3 mm.",
        "mm that the bit is right of, and above, the ring's centre on the upright sled",
        {"right": 0.3, "up": 0.3},
        12.0,
    ),
    "chain_plane": DirectCheck(
        "a ruler at sprocket and ring",
        "Measure how far sprockets and ring stand off the sheet, to 3 mm.",
        "the difference of both, squared",
        {"gap_squared": 250.0},
        6.0,
    ),
    "frame_lean": DirectCheck(
        "the angle of the frame",
        "Measure how far the frame leans from the vertical, to half a degree, with a plumb line or "
        "an angle gauge.",
        "the tangent of that angle, squared (a plumb line: distance over height, squared)",
        {"tangent_squared": 0.005},
        5.0,
    ),
    "chain_sag": DirectCheck(
        "sled and chain on a scale",
        "Weigh the sled with router and bricks to 0.2 kg, and 3 m of chain to 10 g.",
        "(kg of one mm of chain / kg of the sled) squared, / 24",
        {"weight_ratio_squared": 4e-13},
        12.0,
    ),
    "chain_stretch": DirectCheck(
        "a weight on a measured chain",
        "Hang 10 kg on 3 m of chain and measure how much longer it becomes, to 0.2 mm.",
        "mm longer / 3000 mm / 98 N",
        {"compliance": 7e-7},
        20.0,
    ),
    "chain_pitch": DirectCheck(
        "100 links of each chain",
        "Lay 100 links of each chain, pulled tight, along a steel rule: they should be 635 mm; "
        "read to 0.2 mm.",
        "(read - 635) / 635, of each chain",
        {"left": 0.0003, "right": 0.0003},
        15.0,
    ),
    "chain_zero": DirectCheck(
        "both chains at 12 o'clock",
        "Send both chains to the length that the machine calls zero and measure how far the marked "
        "links are past 12 o'clock, to 1 mm.",
        "mm of chain that are out at 12 o'clock",
        {"left": 1.0, "right": 1.0},
        8.0,
    ),
    "sheet_skew": DirectCheck(
        "both diagonals of the sheet",
        "Measure both diagonals of the sheet to 1 mm.",
        "(top left to bottom right squared - bottom left to top right squared) / (4 width height)",
        {"angle": 0.0005},
        5.0,
    ),
    "tape_scale": DirectCheck(
        "the tape against a certified length",
        "Hold the tape against a steel rule or a certified length of 1 m, or a second tape over "
        "2 m, and read the difference to 0.1 mm per metre.",
        "(what the tape reads - the true length) / the true length",
        {"strain": 0.0001},
        4.0,
    ),
}

FRAME_CHECKS: Mapping[str, DirectCheck] = {
    "motor_gap": DirectCheck(
        "the gap between the motors",
        "Measure between the sprocket centres to 1 mm, with a chain pulled tight or a steel tape.",
        "mm",
        {"motor_gap": 1.0},
        10.0,
    ),
    "motor_height": DirectCheck(
        "the height of the motors",
        "Measure from the sheet's top edge up to the sprocket centres to 1 mm, on both sides.",
        "the mean of both sides and half the sheet's height, mm",
        {"motor_height": 1.0},
        8.0,
    ),
    "rotation_radius": DirectCheck(
        "the rotation radius",
        "Measure from the bit to the first link pin of each chain to 0.5 mm.",
        "mm",
        {"rotation_radius": 0.5},
        5.0,
    ),
}
