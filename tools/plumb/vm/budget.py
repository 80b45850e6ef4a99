"""What measuring costs the owner of a machine: holes in a sheet, and minutes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

from plumb.plan.options import HANGING, MARK, READING, ROUND


@dataclass(frozen=True)
class Spent:
    """What was spent so far."""

    marks: int = 0  # cut
    minutes: float = 0.0

    def __add__(self, other: Spent) -> Spent:
        """Both together."""
        return Spent(self.marks + other.marks, self.minutes + other.minutes)


@dataclass(frozen=True)
class Budget:
    """How much an owner has the patience for."""

    marks: int = 45
    minutes: float = 150.0

    def allows(self, spent: Spent) -> bool:
        """Whether so much may be spent."""
        return spent.marks <= self.marks and spent.minutes <= self.minutes


def cutting(sled_weights: Sequence[float], usual: float) -> Spent:
    """A round of marks cut and read, each under a sled of some weight [N]."""
    hangs = any(abs(weight - usual) > 1e-6 for weight in sled_weights)
    count = len(sled_weights)
    return Spent(count, ROUND + MARK * count + HANGING * hangs)


def reading(count: int) -> Spent:
    """Marks that are there, read once more with a newly laid tape."""
    return Spent(0, READING * count)
