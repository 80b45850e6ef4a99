"""The judge: where a sled with hidden faults comes to rest.

It shares no formula with the laws that the lab fits, so a slip in a law cannot hide the same slip
in the data.
"""

from collections.abc import Mapping

import numpy as np

from plumb import _judge

Array = np.ndarray
Numbers = Mapping[str, float]


def places(numbers: Numbers, chains: Array, *, pushes: Array, weights: Array) -> Array:
    """Return places (n, 2) [mm] of the sled of a machine with these numbers; NaN where it cannot
    hang.

    chains (n, 2) [mm] paid out, pushes (n, 2) [N] on the sled, weights (n,) [N] of it. A number
    that is not named is the judge's default. ValueError for a name that the judge does not know.
    """
    return _judge.places(
        {name: float(value) for name, value in numbers.items()},
        np.ascontiguousarray(chains, dtype=float),
        pushes=np.ascontiguousarray(pushes, dtype=float),
        weights=np.ascontiguousarray(weights, dtype=float),
    )
