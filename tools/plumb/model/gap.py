"""The motor gap from the length of a chain that is pulled tight from motor to motor."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot, sqrt

PULL, PULL_SHARE = 80.0, 0.15  # [N] of B11, and how well it is known without the chain's drop
STRETCH, STRETCH_SIGMA = 5.17e-6, 1.0e-6  # [1/N] of a No. 25 chain
FLEX, FLEX_SIGMA = 0.5, 0.5  # [mm per 100 N] of a frame that nobody measured
FLEX_SHARE = 0.1  # how well a flex is measured
DROP_SIGMA, READING_SIGMA = 1.0, 0.05  # [mm] of a ruler; of a chain's length
BEYOND = 12.7  # [mm] of links past the other sprocket, as the clients count them
TWO_SIGMA = 1.96


@dataclass(frozen=True)
class MotorGap:
    """A motor gap and what was taken off the chain for it."""

    gap: float  # [mm]
    interval: float  # [mm] half of the 95 % interval, for a chain of true pitch
    pull: float  # [N]
    sag: float  # [mm] by which the chain is longer than the gap
    stretch: float  # [mm] by which it is stretched
    flex: float  # [mm] by which the motors came closer
    spread: float  # [mm] of the lengths


def motor_gap(
    lengths: Sequence[float],
    *,
    chain_weight: float,
    pull: float = PULL,
    drop: float | None = None,
    flex: float | None = None,
) -> MotorGap:
    """The gap [mm] from lengths of the chain [mm] as B10 says them.

    `chain_weight` [N/mm]; `drop` [mm] of the chain's middle below a string between its ends, which
    says the pull; `flex` [mm] by which the motors come closer for 100 N.
    """
    length = sum(lengths) / len(lengths) - BEYOND
    share = PULL_SHARE
    if drop is not None:
        pull, share = chain_weight * length**2 / (8 * drop), DROP_SIGMA / drop
    give = FLEX if flex is None else flex
    sag = chain_weight**2 * length**3 / (24 * pull**2)
    stretch, closer = STRETCH * pull * length, give * pull / 100
    give_sigma = FLEX_SIGMA if flex is None else FLEX_SHARE * flex
    sigma = hypot(
        share * (2 * sag + stretch + closer),
        STRETCH_SIGMA * pull * length,
        give_sigma * pull / 100,
        READING_SIGMA / sqrt(len(lengths)),
    )
    spread = max(lengths) - min(lengths)
    gap = length - sag + stretch + closer
    return MotorGap(gap, TWO_SIGMA * sigma, pull, sag, stretch, closer, spread)
