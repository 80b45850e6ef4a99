"""Which sizes a real machine can have: one rule for the fit, the diagnosis and the proposals.

The catalogue's range is what was met in workshops. A value in it is plausible. What was met is no
wall, so an interval is refused only where all of it lies beyond MARGIN times the range: of 18
made-up boards with a size 1.25 times the largest, the range itself refused the truth in 11.
"""

from __future__ import annotations

from dataclasses import dataclass
from functools import cache
from typing import Any

import numpy as np

from plumb.model.catalogue import parameter_words
from plumb.model.predict import Array, frame_words

MARGIN = 1.5


@dataclass(frozen=True)
class PlausibleRange:
    """From the smallest to the largest value that was met; infinite where no limit is known."""

    low: float = -np.inf
    high: float = np.inf

    @property
    def limits(self) -> list[float | None]:
        """Both ends; None where no limit is known."""
        return [end if np.isfinite(end) else None for end in (self.low, self.high)]

    def holds(self, value: float) -> bool:
        """Whether a value is plausible."""
        return bool(self.low <= value <= self.high)

    def is_near(self, low: float | Array, high: float | Array) -> Any:
        """Whether an interval (or each of many) reaches what a real machine may have."""
        least = self.low * MARGIN if self.low < 0 else self.low / MARGIN
        most = self.high / MARGIN if self.high < 0 else self.high * MARGIN
        return (np.asarray(high) >= least) & (np.asarray(low) <= most)


@cache
def plausible_range(name: str) -> PlausibleRange:
    """The range of a parameter, or of a number of the frame, by its full name."""
    words = {frame["name"]: frame for frame in frame_words()} | parameter_words()
    if name not in words:
        return PlausibleRange()
    return PlausibleRange(words[name]["low"], words[name]["high"])
