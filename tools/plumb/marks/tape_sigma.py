"""How well somebody reads a tape, by how fine its lines are."""

from __future__ import annotations

import math

# What the hand adds, whatever the tape: hook, parallax, the middle of a hole. A tape with
# millimetre lines then gives the usual 0.5 mm (USUAL_SIGMA of the fit).
HAND = 0.4  # [mm]


def tape_sigma(finest: float) -> float:
    """Standard deviation of a coordinate [mm] by the finest division of the tape [mm]."""
    return round(math.hypot(HAND, finest / math.sqrt(12)), 2)
