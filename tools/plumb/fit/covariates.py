"""Covariates of a chain's error: its tension, length, angle, wrap, phase, place and way.

Each covariate has a number for each visit and chain, by a model of the machine.
"""

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from plumb.fit.compare import hung_places
from plumb.fit.fit import Fit
from plumb.fit.observations import Observations, strands_at
from plumb.model.catalogue import empirical_effects, parameter_names
from plumb.model.plain import ranked
from plumb.model.predict import Array, values_of
from plumb.settings.machine import MachineSettings


@dataclass(frozen=True)
class Covariate:
    """A quantity against which errors of the chains are drawn."""

    name: str
    unit: str
    values: Array  # (n, 2) of left and right chain; nan where it is not known


def covariates(model: MachineSettings, rows: Observations) -> tuple[Covariate, ...]:
    """Return all covariates of every visit of `rows` (r,), by our model of the machine.

    The phase counts as the effect sprocket_runout does: free length over the sprocket's radius.
    The wrap is the chain on the sprocket, from 12 o'clock to the tangent point. The order is that
    of the file. An approach is the direction of the last move.
    """
    places = hung_places(model, rows)
    strands = strands_at(
        values_of(model),
        rows,
        places,
        over_top=model.feed == "top",
        usual_weight=model.sled_weight,
    )
    turned = np.mod(strands.length / model.sprocket_radius, 2 * np.pi)
    angle = np.arctan2(strands.down, strands.across)
    past_noon = angle if model.feed == "top" else np.pi - angle
    # Left and right have the same of these; a direction is nan where it is not known.
    heading = np.arctan2(rows.approaches[:, 1], rows.approaches[:, 0])
    heading = np.where(rows.approaches.any(axis=1), heading, np.nan)
    order = np.arange(1.0, len(places) + 1)
    x, y, order, heading = (np.stack([each, each], 1) for each in (*places.T, order, heading))
    return (
        Covariate("tension", "N", strands.tension),
        Covariate("length", "mm", strands.span),
        Covariate("angle", "rad", angle),
        Covariate("wrap", "mm", model.sprocket_radius * past_noon),
        Covariate("phase", "rad", turned),
        Covariate("x", "mm", x),
        Covariate("y", "mm", y),
        Covariate("order", "", order),
        Covariate("approach", "rad", heading),
    )


# The residual patch: a smooth map of what no known effect explains, chosen knowingly, not physics.
#
# Its terms are held near zero by one common size, and that size is chosen by the error of marks
# left out: where the patch follows noise alone, none is as good as any.

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
    """Return the patch with the frame and these effects; None if it buys nothing.

    `weighted` is fit() with all but effects and priors; `without` is the fit without a patch.
    """
    tried = []
    for size in SIZES:
        held = {**priors, **dict.fromkeys(parameter_names(PATCH), size)}
        tried.append(Patched(weighted(effects=effects, priors=held), size))
    best = ranked(tried, lambda patched: patched.fit.left_out_rms)[0]
    return best if best.fit.left_out_rms < WORTH * without.left_out_rms else None
