"""Numbers of the machine that its owner can measure directly, how well, and how long it takes.

The accuracies are what a careful owner gets with the tool that is named.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass


@dataclass(frozen=True)
class DirectCheck:
    """How a number is measured directly."""

    title: str
    do: str
    sigmas: Mapping[str, float]  # of each parameter [its unit]
    minutes: float


CHECKS: Mapping[str, DirectCheck] = {
    "motor_level": DirectCheck(
        "a level over the motors",
        "Lay a spirit level on a straight edge, or a water hose, across both sprockets and measure "
        "how much higher the right one is, to 1 mm.",
        {"height_difference": 1.0},
        8.0,
    ),
    "frame_flex": DirectCheck(
        "a gauge at the motor arms",
        "Pull each motor along its chain and straight down with 50 N (a luggage scale) and read on "
        "a dial gauge how far the sprocket moves, to 0.1 mm.",
        {"inward": 0.002, "downward": 0.002},
        20.0,
    ),
    "sled_swing": DirectCheck(
        "the sled turned on its ring",
        "Turn the sled by hand on its ring and measure the circle that the bit draws: half of it is "
        "how far the bit is off the middle, to 0.3 mm to the right and up.",
        {"right": 0.3, "up": 0.3},
        12.0,
    ),
    "chain_plane": DirectCheck(
        "a ruler at sprocket and ring",
        "Measure how far sprockets and ring stand off the sheet, to 3 mm; the difference squared is "
        "the number.",
        {"gap_squared": 250.0},
        6.0,
    ),
    "frame_lean": DirectCheck(
        "the angle of the frame",
        "Measure the frame's angle from the vertical to half a degree, with a plumb line or an "
        "angle gauge; its tangent squared is the number.",
        {"tangent_squared": 0.005},
        5.0,
    ),
    "chain_sag": DirectCheck(
        "sled and chain on a scale",
        "Weigh the sled to 0.2 kg and 3 m of chain to 10 g; the size of the sag follows.",
        {"weight_ratio_squared": 4e-13},
        12.0,
    ),
    "chain_stretch": DirectCheck(
        "a weight on a measured chain",
        "Hang 10 kg on 3 m of chain and measure how much longer it becomes, to 0.2 mm.",
        {"compliance": 7e-7},
        20.0,
    ),
    "chain_pitch": DirectCheck(
        "100 links of each chain",
        "Lay 100 links of each chain, pulled tight, along a steel rule: they should be 635 mm; read "
        "to 0.2 mm.",
        {"left": 0.0003, "right": 0.0003},
        15.0,
    ),
    "sprocket_runout": DirectCheck(
        "a gauge at the sprockets' rims",
        "Turn each sprocket under a dial gauge and read how its rim moves in and out, to 0.05 mm.",
        {name: 0.05 for name in ("left_sine", "left_cosine", "right_sine", "right_cosine")},
        15.0,
    ),
    "chain_zero": DirectCheck(
        "both chains at 12 o'clock",
        "Bring both sprockets to 12 o'clock and measure how far the marked links are off, to 1 mm.",
        {"left": 1.0, "right": 1.0},
        8.0,
    ),
    "sheet_skew": DirectCheck(
        "both diagonals of the sheet",
        "Measure both diagonals of the sheet to 1 mm; their difference is the skew.",
        {"angle": 0.0005},
        5.0,
    ),
    "tape_scale": DirectCheck(
        "the tape against a certified length",
        "Hold the tape against a steel rule or a certified length of 1 m, or a second tape over "
        "2 m, and read the difference to 0.1 mm per metre.",
        {"strain": 0.0001},
        4.0,
    ),
}

FRAME_CHECKS: Mapping[str, DirectCheck] = {
    "motor_gap": DirectCheck(
        "the gap between the motors",
        "Measure between the sprocket centres to 1 mm, with a chain pulled tight or a steel tape.",
        {"motor_gap": 1.0},
        10.0,
    ),
    "motor_height": DirectCheck(
        "the height of the motors",
        "Measure from the sheet's top edge up to the sprocket centres to 1 mm, on both sides.",
        {"motor_height": 1.0},
        8.0,
    ),
    "rotation_radius": DirectCheck(
        "the rotation radius",
        "Measure from the bit to the first link pin of each chain to 0.5 mm.",
        {"rotation_radius": 0.5},
        5.0,
    ),
}
