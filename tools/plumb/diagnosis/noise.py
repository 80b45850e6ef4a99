"""The noise of one measured number."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy

from plumb.diagnosis.spread import NOTHING, Spread

_ORIGINS = {
    "stated": "as stated",
    "repeats": "from repeats",
    "stated and repeats": "as stated, and from repeats",
    "scatter": "from the scatter of the marks",
    "default": "usual for a tape",
    "residuals": "from what the fit leaves",
}


@dataclass(frozen=True)
class Noise:
    """Standard deviation of one coordinate or distance, and how well it is known."""

    sigma: float  # [mm]
    degrees: float  # of freedom; KNOWN if it was not estimated
    source: str  # "stated", "repeats", "stated and repeats", "scatter" or "default"
    notes: tuple[str, ...] = ()
    within: Spread = NOTHING  # of repeats, as far as sigma was made of it

    @property
    def quantile(self) -> float:
        """Half-width of a 95 % interval, in standard deviations."""
        return 1.96 if np.isinf(self.degrees) else float(scipy.special.stdtrit(self.degrees, 0.975))

    @property
    def upper_quantile(self) -> float:
        """Distance of a 95 % upper limit, in standard deviations."""
        return 1.645 if np.isinf(self.degrees) else float(scipy.special.stdtrit(self.degrees, 0.95))

    @property
    def testable(self) -> bool:
        """Whether it comes from elsewhere than the misfit, so that a misfit can be tested."""
        return self.source != "scatter"

    @property
    def origin(self) -> str:
        """Where it comes from, for people."""
        counted = f", {self.degrees:.0f} degrees of freedom" if self.within.degrees else ""
        return origin_words(self.source) + counted


def origin_words(source: str) -> str:
    """Where a sigma of this source comes from, for people."""
    return _ORIGINS[source]
