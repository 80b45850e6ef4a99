"""Boards with a hidden effect for tests, by the names of effects, as tools/rates cuts them."""

from __future__ import annotations

from collections.abc import Mapping

import plumb.hidden
from boards import BoardCut, cut
from plumb.hidden import CAUSES, Cause, Hidden, Plan
from plumb.marks.read import Measurements

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
    return plumb.hidden.size_for(_CAUSES[effect], layout, millimetres)


def board_cut(
    effects: Mapping[str, float],
    layout: Plan,
    *,
    seed: int,
    noise: float = 0.5,
    tape_sigma: float | None = 0.5,
    bump: float = 0.0,
) -> BoardCut:
    """A board and its machine, by sizes of effects in typical sizes; bump [mm] RMS of no effect."""
    hidden = Hidden(
        tuple((_CAUSES[name], size) for name, size in effects.items()),
        outside="bump" if bump else "",
        outside_mm=bump,
    )
    return cut(hidden, layout, seed=seed, noise=noise, tape_sigma=tape_sigma)


def board(effects: Mapping[str, float], layout: Plan, **how: float | None) -> Measurements:
    """The board as measured."""
    return board_cut(effects, layout, **how).measurements
