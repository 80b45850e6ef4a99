"""Boards with a hidden effect for tests, by the names of effects; made by plumb.bench."""

from __future__ import annotations

from collections.abc import Mapping

import numpy as np
from plumb.bench import boards
from plumb.bench.boards import (
    GAP_SIGMA,
    POSE_SIGMA,
    TURN_SIGMA,
    TrueMachine,
    chains_for,
    cut,
    joined,
    plan,
)
from plumb.bench.causes import CAUSES, MAKER, SLED, Cause, Hidden, Plan
from plumb.marks.read import Measurements

__all__ = [
    "COMPLIANCE",
    "GAP_SIGMA",
    "HIDDEN",
    "MAKER",
    "POSE_SIGMA",
    "SLED",
    "TURN_SIGMA",
    "WEIGHT",
    "Plan",
    "ask_judge",
    "board",
    "joined",
    "places_with",
    "plan",
    "size_for",
]

WEIGHT, COMPLIANCE = MAKER.chain_weight, MAKER.effect("chain_stretch", "compliance")
# One cause of each effect; the chains' pitch and the sprockets differ from side to side.
_CAUSES = {cause.effect: cause for cause in reversed(CAUSES)}
_CAUSES["chain_pitch"] = next(cause for cause in CAUSES if cause.label == "left more")
_CAUSES["sprocket_runout"] = Cause(
    "sprocket_runout",
    "left more",
    lambda s: {"left.eccentric_x": 0.2 * s, "right.eccentric_y": 0.1 * s},
)
# The judge's numbers for an effect of this many typical sizes; empty where the judge has no part.
HIDDEN = {
    name: lambda size, cause=cause: Hidden(((cause, size),)).numbers
    for name, cause in _CAUSES.items()
}


def size_for(effect: str, layout: Plan, millimetres: float) -> float:
    """How many typical sizes move the marks by so much RMS, before anything is refitted."""
    return boards.size_for(_CAUSES[effect], layout, millimetres)


def board(
    effects: Mapping[str, float],
    layout: Plan,
    *,
    seed: int,
    noise: float = 0.5,
    tape_sigma: float | None = 0.5,
    bump: float = 0.0,
) -> Measurements:
    """A board as measured, by sizes of effects in typical sizes; bump [mm] RMS of no effect."""
    hidden = Hidden(
        tuple((_CAUSES[name], size) for name, size in effects.items()),
        outside="bump" if bump else "",
        outside_mm=bump,
    )
    return cut(hidden, layout, seed=seed, noise=noise, tape_sigma=tape_sigma).measurements


def ask_judge(numbers: Mapping[str, float], layout: Plan) -> np.ndarray:
    """Places (n, 2) [mm] of the sled of a machine with these numbers, sent by the maker's."""
    cause = Cause("", "", lambda _: dict(numbers))
    machine = TrueMachine(Hidden(((cause, 1.0),)))
    return machine.sleds(chains_for(layout), weights=layout.sled_weights)


def places_with(
    effect: str | None, size: float, layout: Plan, frame: Mapping[str, float]
) -> np.ndarray:
    """Where marks are read (n, 2) [mm] with an effect of this many typical sizes."""
    hidden = Hidden(((_CAUSES[effect], size),)) if effect else Hidden()
    machine = TrueMachine(hidden, **frame)
    chains = chains_for(layout)
    where = machine.sleds(chains, approaches=layout.approaches, weights=layout.sled_weights)
    return hidden.read(where)
