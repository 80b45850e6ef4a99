"""Tape scale: the tape's millimetres are not millimetres, so everything measured is too long."""

from __future__ import annotations

import numpy as np

from plumb.model.lab_effects.lab_effect import TAPE, Array, Change, LabEffect, LabParameter, Seen
from plumb.model.python_effect import DirectCheck, Example, Plain


def change(parameters: Array, seen: Seen) -> Change:
    """Measured = true * (1 + strain), about the middle of the sheet: positive reads too long.

    (A tape that reads too long is itself too short. Where its hook sits only shifts all marks.)
    """
    strain = parameters[0]
    by_place = np.broadcast_to(strain * np.eye(2), (len(seen.places), 2, 2))
    return Change(strain * seen.places, seen.places[:, :, np.newaxis], by_place)


EFFECT = LabEffect(
    name="tape_scale",
    noun="a tape that reads wrong",
    summary="the tape reads too long (positive) or too short, by the same share everywhere",
    pattern="all marks lie farther from the middle, in x and y alike, by the same share",
    look_alikes="chain_pitch of both chains, sled_swing, frame_flex",
    remedy="hold the tape against a length that you trust, like a steel rule or another tape",
    needs="measured places or distances",
    acts_on=TAPE,
    parameters=(
        LabParameter(
            "strain",
            "1",
            -0.003,
            0.003,
            0.0003,
            "share by which readings are too long",
            0.0001,
            Plain("tape reads # too long", "tape reads # too short", "%", 100.0),
        ),
    ),
    check=DirectCheck(
        "the tape against a certified length",
        "Hold the tape against a steel rule or a certified length of 1 m, or a second tape over "
        "2 m, and read the difference to 0.1 mm per metre.",
        "(what the tape reads - the true length) / the true length",
        4.0,
    ),
    hidden_as="strain",
    examples=(Example("long", {"strain": 0.0003}, most=4.0),),
    change=change,
)
