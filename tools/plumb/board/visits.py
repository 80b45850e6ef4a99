"""Where the sled went on each visit: our model under the sled's weight on that visit."""

from __future__ import annotations

import numpy as np

from plumb.board.observations import Observations
from plumb.model.catalogue import OTHER_CHAIN, WEIGHT_POWERS, ZEROING_NAMES
from plumb.model.predict import NAMES, Array, lengths, places_with_slopes, settings_of, values_of
from plumb.settings.machine import MachineSettings

# Left and right: what each zeroing of the chains sets again.
ZERO_COLUMNS = tuple(NAMES.index(name) for name in ZEROING_NAMES)
# What goes with a chain to the other sprocket.
SWAPPED = np.array([NAMES.index(OTHER_CHAIN.get(name, name)) for name in NAMES])


def loaded(values: Array, weight: float, usual: float) -> tuple[Array, Array]:
    """The values for a sled of another weight [N], and each value's slope by the usual weight's.

    Some parameters are ratios to the sled's weight, so they follow a power of it.
    """
    loaded_values, factors = values.copy(), np.ones(len(values))
    if weight == usual:
        return loaded_values, factors
    loaded_values[NAMES.index("sled_weight")] = weight
    factors[NAMES.index("sled_weight")] = 0.0
    for name, power in WEIGHT_POWERS.items():
        column = NAMES.index(name)
        factors[column] = (weight / usual) ** power
        loaded_values[column] *= factors[column]
    return loaded_values, factors


def visited(
    values: Array,
    rows: Observations,
    *,
    over_top: bool,
    usual_weight: float,
    zeros: Array | None = None,
) -> tuple[Array, Array, Array]:
    """Places (r, 2) [mm] of all visits, their slopes by the values (r, 2, v), and FOUND (r,).

    zeros (groups, 2) [mm] is what each zero group adds to ZEROING_NAMES, left and right.
    """
    where = np.zeros((len(rows.chains), 2))
    slopes = np.zeros((len(rows.chains), 2, len(NAMES)))
    outcome = np.zeros(len(rows.chains), dtype=int)
    alike = {*zip(rows.sled_weights, rows.zero_groups, rows.swapped, strict=True)}
    for weight, group, swapped in alike:
        mine = (
            (rows.sled_weights == weight) & (rows.zero_groups == group) & (rows.swapped == swapped)
        )
        loaded_values, factors = loaded(values, weight, usual_weight)
        if zeros is not None:
            loaded_values[list(ZERO_COLUMNS)] += zeros[group]
        order = SWAPPED if swapped else slice(None)
        where[mine], of_mine, outcome[mine] = places_with_slopes(
            loaded_values[order], over_top=over_top, chains=rows.chains[mine]
        )
        slopes[mine] = of_mine[:, :, order] * factors
    return where, slopes, outcome


def chains_to(model: MachineSettings, points: Array, weights: Array) -> tuple[Array, Array]:
    """Chain (n, 2) [mm] to places (n, 2) [mm] for sleds of these weights (n,) [N], and FOUND."""
    chains, outcome = np.zeros((len(points), 2)), np.zeros(len(points), dtype=int)
    for weight in np.unique(weights):
        mine = weights == weight
        loaded_values, _ = loaded(values_of(model), weight, model.sled_weight)
        chains[mine], outcome[mine] = lengths(settings_of(loaded_values, like=model), points[mine])
    return chains, outcome
