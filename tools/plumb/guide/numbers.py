"""What the owner knows of the machine, and how far each number may be wrong."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True)
class Known:
    """A number that a tape or a scale gives."""

    name: str  # of the frame
    question: str
    sigma: float  # [mm] how far it is usually wrong
    low: float  # [mm]
    high: float


LENGTHS = (
    Known(
        "motor_gap",
        "From the middle of the left motor's shaft to the middle of the right one's",
        3.0,
        1500.0,
        5000.0,
    ),
    Known(
        "motor_height",
        "From the sheet's top edge up to the line between the shafts",
        20.0,
        0.0,
        2000.0,
    ),
    Known(
        "rotation_radius",
        "From the bit to the end of a chain, along the chain's line (the ring's radius)",
        3.0,
        50.0,
        400.0,
    ),
)
LIGHTEST, HEAVIEST = 3.0, 40.0  # [kg] of a sled with its router
