"""Boards with a hidden effect for tests, by the names of effects; made by plumb.bench."""

from __future__ import annotations

from collections.abc import Mapping

from plumb.bench import boards
from plumb.bench.boards import cut, joined, plan
from plumb.bench.causes import CAUSES, MAKER, Hidden, Plan
from plumb.bench.judge import build
from plumb.measurements import Measurements

__all__ = ["HIDDEN", "MAKER", "board", "build", "joined", "plan", "size_for"]

# The usual cause of each effect; the chains' pitch differs from side to side.
HIDDEN = {one.effect: one for one in reversed(CAUSES)}
HIDDEN["chain_pitch"] = next(one for one in CAUSES if one.label == "left more")


def size_for(effect: str, own: Plan, millimetres: float) -> float:
    """How many typical sizes move the marks by so much RMS, before anything is refitted."""
    return boards.size_for(HIDDEN[effect], own, millimetres)


def board(
    effects: Mapping[str, float],
    own: Plan,
    *,
    seed: int,
    noise: float = 0.5,
    tape_sigma: float | None = 0.5,
    bump: float = 0.0,
) -> Measurements:
    """A board as measured, by sizes of effects in typical ones; bump [mm] RMS of no effect."""
    hidden = Hidden(
        tuple((HIDDEN[name], size) for name, size in effects.items()),
        outside="bump" if bump else "",
        outside_mm=bump,
    )
    return cut(hidden, own, seed=seed, noise=noise, tape_sigma=tape_sigma).measurements
