"""A sum of squares with its degrees of freedom, which is what scatter comes as."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np


@dataclass(frozen=True)
class Spread:
    """A sum of squares [mm^2] and its degrees of freedom."""

    squares: float
    degrees: float

    @property
    def sigma(self) -> float:
        """Standard deviation [mm]."""
        return float(np.sqrt(self.squares / self.degrees)) if self.degrees else float("nan")

    def __add__(self, other: Spread) -> Spread:
        """Both together."""
        return Spread(self.squares + other.squares, self.degrees + other.degrees)


NOTHING = Spread(0.0, 0.0)
