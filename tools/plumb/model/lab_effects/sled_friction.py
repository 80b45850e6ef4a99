"""Sled friction: the sled rubs on the sheet and stops short of where its chains let it hang."""

from __future__ import annotations

import numpy as np

from plumb.model.lab_effects.lab_effect import SLED, Array, Change, LabEffect, LabParameter, Seen
from plumb.model.python_effect import Example, Plain


def change(parameters: Array, seen: Seen) -> Change:
    """Displacement = -compliance * drag * unit approach.

    Friction pulls against the last motion; a side force changes both tensions, so sag and stretch,
    so the place (see plumb.model.compliance). Marks whose approach is not known do not move. How
    the compliance itself changes from place to place is left to who worked it out.
    """
    per_newton = -np.einsum("nij,nj->ni", seen.compliance, seen.approaches)
    return Change(
        moved=parameters[0] * per_newton,
        by_parameter=per_newton[:, :, np.newaxis],
        by_place=np.zeros((len(per_newton), 2, 2)),
    )


EFFECT = LabEffect(
    name="sled_friction",
    noun="a sled that rubs",
    summary="the sled rubs on the sheet and stops short of where it would hang freely",
    pattern="marks lag behind their approach: millimetres in the lower corners, little elsewhere",
    look_alikes="chain_sag, frame_lean, noise if the approaches differ",
    remedy="approach every mark from the same side, keep marks out of the lowest corners, wax the "
    "sled; touch some marks from both sides to see how much it is",
    needs="marks with an approach",
    acts_on=SLED,
    parameters=(
        LabParameter(
            "drag",
            "N",
            0.0,
            40.0,
            6.0,
            "force of friction against the last motion",
            plain=Plain("sled held back by #", "", "N"),
        ),
    ),
    hidden_as="drag",
    examples=(Example("drag", {"drag": 6.0}, most=20.0),),
    change=change,
)
