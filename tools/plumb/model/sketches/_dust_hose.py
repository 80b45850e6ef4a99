"""Dust hose: it hangs from above and pulls the sled to the side.

Set aside by the underscore; as dust_hose.py it is ranked and fitted.
"""

import numpy as np

from plumb.model.sketches import Sketch, SketchParameter, Strands
from plumb.model.sketches.sketch import Array


def push(parameters: Array, strands: Strands) -> Array:
    """Force (n, 2) [N] on the sled: x to the right, y up the sheet."""
    return np.tile(parameters, (len(strands.places), 1))


SKETCH = Sketch(
    name="dust_hose",
    summary="the dust hose or the router's cord pulls the sled sideways or holds it up",
    pattern="all marks move towards the hose, by millimetres in the lower corners",
    look_alikes="sled_friction, chain_sag, frame_lean",
    remedy="mark again with the hose held by a helper, or hung from the middle of the beam",
    parameters=(
        SketchParameter("right", "N", -20.0, 20.0, 4.0, "pull of the hose to the right"),
        SketchParameter("up", "N", -20.0, 40.0, 4.0, "pull of the hose upwards"),
    ),
    push=push,
)
