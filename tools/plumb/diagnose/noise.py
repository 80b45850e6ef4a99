"""The noise of one measured number."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
import scipy


@dataclass(frozen=True)
class Noise:
    """Standard deviation of one coordinate or distance, and how well it is known."""

    sigma: float  # [mm]
    degrees: float  # of freedom; KNOWN if it was not estimated
    source: str  # "stated", "repeats", "scatter" or "default"
    notes: tuple[str, ...] = ()

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
