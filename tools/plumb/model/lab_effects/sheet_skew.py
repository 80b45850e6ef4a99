"""Sheet skew: places are read from edges of the sheet that are not square to each other."""

from __future__ import annotations

import numpy as np

from plumb.model.lab_effects.lab_effect import EDGES, Array, Change, LabEffect, LabParameter, Seen
from plumb.model.python_effect import DirectCheck, Example, Plain


def change(parameters: Array, seen: Seen) -> Change:
    """Return the reading x grows by angle * y: a positive angle reads too far right at the top.

    That is a left edge whose top leans out to the left. Distances between marks do not feel it.
    """
    angle = parameters[0]
    moved = np.zeros_like(seen.places)
    moved[:, 0] = angle * seen.places[:, 1]
    by_parameter = np.zeros((*moved.shape, 1))
    by_parameter[:, 0, 0] = seen.places[:, 1]
    by_place = np.zeros((len(moved), 2, 2))
    by_place[:, 0, 1] = angle
    return Change(moved, by_parameter, by_place)


EFFECT = LabEffect(
    name="sheet_skew",
    noun="sheet edges that are not square",
    summary="the edges from which marks are measured are not square to each other",
    pattern="the top row lies to one side of the bottom row; each row by itself is right",
    look_alikes="sled_swing, sheet_rotation in part",
    remedy="measure both diagonals of the sheet, or distances between marks instead of to edges",
    needs="marks measured from the sheet's edges, not distances alone",
    acts_on=EDGES,
    parameters=(
        LabParameter(
            "angle",
            "rad",
            -0.01,
            0.01,
            0.001,
            "by which the reading x grows for each mm up",
            0.0005,
            Plain("sheet edges # out of square for each metre", "", "mm", 1000.0),
        ),
    ),
    check=DirectCheck(
        "both diagonals of the sheet",
        "Measure both diagonals of the sheet to 1 mm.",
        "(top left to bottom right squared - bottom left to top right squared) / (4 width height)",
        5.0,
    ),
    hidden_as="skew",
    examples=(Example("skew", {"angle": 0.001}, most=4.0),),
    change=change,
)
