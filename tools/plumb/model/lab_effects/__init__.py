"""Lab effects: they act on what is measured and never on what is sent to the machine.

To add an effect, write it here and give it a line in LAB_EFFECTS.
"""

from __future__ import annotations

import math
from collections.abc import Callable
from dataclasses import dataclass
from typing import ClassVar

import numpy as np
from numpy.typing import NDArray

from plumb.model.python_effect import (
    DirectCheck,
    Example,
    Plain,
    PythonEffect,
    PythonParameter,
    Reading,
)

Array = NDArray[np.float64]
SLED = "sled"  # the sled comes to rest elsewhere, before the turn of the sheet
EDGES = "edges"  # what is read from the sheet's edges; distances between marks are as before
TAPE = "tape"  # everything that is read from a tape, distances too


@dataclass(frozen=True)
class Seen:
    """Places before an effect acts, and what else it may read."""

    places: Array  # (n, 2) [mm]
    approaches: Array  # (n, 2) unit vectors of the last move; zero where it is not known
    compliance: Array  # (n, 2, 2) [mm/N] of the hanging sled; zero for effects not on the sled


@dataclass(frozen=True)
class Change:
    """What an effect does to places, and its slopes with everything else held."""

    moved: Array  # (n, 2) [mm] to be added to the places
    by_parameter: Array  # (n, 2, p) [mm per unit]
    by_place: Array  # (n, 2, 2) of `moved` by the places themselves


LabParameter = PythonParameter


@dataclass(frozen=True, kw_only=True)
class LabEffect(PythonEffect):
    """One physical cause that lies in what is measured and never in what the machine is sent."""

    where: ClassVar[str] = "lab"

    needs: str  # what measurements must hold to feel it
    acts_on: str  # SLED, EDGES or TAPE
    change: Callable[[Array, Seen], Change]  # of parameters (p,) and what is seen
    hidden_as: str  # what the bench does to a board by the first parameter: drag, skew or strain


# Sled friction: the sled rubs on the sheet and stops short of where its chains let it hang.


def _friction(parameters: Array, seen: Seen) -> Change:
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


SLED_FRICTION = LabEffect(
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
    change=_friction,
)


# Sheet skew: places are read from edges of the sheet that are not square to each other.


def _skew(parameters: Array, seen: Seen) -> Change:
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


def _of_diagonals(width: float, height: float) -> float:
    """Return the skew [rad] for each mm by which the diagonals differ: their squares differ by
    about twice a diagonal times that.
    """
    return math.hypot(width, height) / (2 * width * height)


SHEET_SKEW = LabEffect(
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
            Reading(
                "how much longer the diagonal from the top left corner is",
                1.0,
                by_sheet=_of_diagonals,
            ),
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
    change=_skew,
)


# Tape scale: the tape's millimetres are not millimetres, so everything measured is too long.


def _scale(parameters: Array, seen: Seen) -> Change:
    """Measured = true * (1 + strain), about the middle of the sheet: positive reads too long.

    (A tape that reads too long is itself too short. Where its hook sits only shifts all marks.)
    """
    strain = parameters[0]
    by_place = np.broadcast_to(strain * np.eye(2), (len(seen.places), 2, 2))
    return Change(strain * seen.places, seen.places[:, :, np.newaxis], by_place)


TAPE_SCALE = LabEffect(
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
            Reading("how much too much the tape reads over a metre", 0.1, 1 / 1000, digits=2),
        ),
    ),
    check=DirectCheck(
        "the tape against a certified length",
        "Hold the tape against a steel rule or a certified length of 1 m, or a second tape over "
        "2 m, and read the difference to 0.1 mm per metre.",
        "mm that the tape reads too much over a metre, / 1000",
        4.0,
    ),
    hidden_as="strain",
    examples=(Example("long", {"strain": 0.0003}, most=4.0),),
    change=_scale,
)


# From the sled over the sheet to the tape: where the sled stops, what the edges say of it, and
# what the tape reads.
LAB_EFFECTS: tuple[LabEffect, ...] = (SLED_FRICTION, SHEET_SKEW, TAPE_SCALE)
