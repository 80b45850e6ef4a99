"""The residual patch: a smooth map of what no known effect explains, chosen knowingly, not physics.

Its terms are held near zero by one common size, and that size is chosen by the error of marks left
out: where the patch follows noise alone, none is as good as any.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

from plumb.fit.fit import Fit
from plumb.model.catalogue import empirical_effects, parameter_names
from plumb.model.ranks import ranked

PATCH = empirical_effects()[0]["name"]
SIZES = (0.2, 0.4, 0.8, 1.6, 3.2, 6.4)  # [mm] of one term, one standard deviation
WORTH = 0.9  # a patch must bring the left-out error below this share of what it was


@dataclass(frozen=True)
class Patched:
    """A fit with the patch."""

    fit: Fit
    size: float  # [mm] to which its terms were held


def best_patch(
    weighted: Callable[..., Fit],
    *,
    effects: Sequence[str],
    priors: Mapping[str, float],
    without: Fit,
) -> Patched | None:
    """The patch with the frame and these effects; None if it buys nothing.

    `weighted` is fit() with all but effects and priors; `without` is the fit without a patch.
    """
    tried = []
    for size in SIZES:
        held = {**priors, **dict.fromkeys(parameter_names(PATCH), size)}
        tried.append(Patched(weighted(effects=effects, priors=held), size))
    best = ranked(tried, lambda patched: patched.fit.left_out_rms)[0]
    return best if best.fit.left_out_rms < WORTH * without.left_out_rms else None
