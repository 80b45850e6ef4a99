"""A fault tried on a machine, and what came of it."""

from __future__ import annotations

import re
from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np
import scipy
from fault_stories import Fault, mend
from scene import Scene
from strike import Strike

Array = np.ndarray
BELIEVED = 0.3  # [mm] of the bit beyond which a place that the machine is sure of is false
SPACING = 0.02  # [mm] of the places by which a way is compared
# What the machine says when it has noticed something.
TROUBLE = re.compile(
    r"ALARM|error|Lost|not known|falls behind|is low|missed|hung|brown-out|soft reset|refused"
)


@dataclass(frozen=True)
class Outcome:
    """What came of a fault."""

    fault: str
    seed: int
    struck: bool  # the job lasted until the fault struck
    noticed: bool  # the machine said so
    stopped: bool  # the job did not go to its end
    went_on: float  # [mm] of the bit's way after the fault
    off: float  # [mm] at most from the way of the same job without the fault
    astray: float  # [mm] of the place that the machine is sure of; 0 where it is not sure
    lost: bool  # the machine says that it does not know its place
    settings_kept: bool
    said: tuple[str, ...]

    @property
    def is_false(self) -> bool:
        """Whether the machine is sure of a place where it is not."""
        return self.astray > BELIEVED


def tried(fault: Fault, seed: int, *, elf: str | None = None) -> Outcome:
    """Let a fault strike in the middle of a job, and ask the machine what it knows."""
    scene = Scene(seed, elf=elf, shield=fault.shield)
    before, lines = scene.settings(), fault.job(scene)
    way = way_without_fault(seed, tuple(lines))
    if fault.before:
        fault.before(scene)
    start, lasts = scene.machine.seconds, way[-1, 0] - way[0, 0]
    strike = Strike(fault.story(scene), start + lasts * scene.source.uniform(*fault.when))
    ended = scene.send(lines, strike)
    scene.settle()
    went = np.array([row for row in scene.wire.way if row[0] >= start])
    sure, astray = asked(scene)
    return Outcome(
        fault.name,
        seed,
        struck=strike.struck_at is not None,
        noticed=any(TROUBLE.search(line) for line in scene.heard),
        stopped=not ended,
        went_on=length_of(went[went[:, 0] >= (strike.struck_at or np.inf), 1:]),
        off=farthest_from(way[:, 1:], went[:, 1:]),
        astray=astray,
        lost=not sure,
        settings_kept=are_kept(before, scene.settings(), lines),
        said=tuple(scene.heard),
    )


def asked(scene: Scene) -> tuple[bool, float]:
    """Return whether the machine is sure of its place, now and after a restart, and how far that is
    off.

    Wires and supplies are put right first, as somebody would before going on.
    """
    mend(scene)
    was_sure = scene.is_sure_when_stopped()
    astray = scene.astray() if was_sure else 0.0
    is_sure = scene.is_sure_after_restart()
    return is_sure, max(astray, scene.astray()) if is_sure else astray


@lru_cache(maxsize=512)
def way_without_fault(seed: int, lines: tuple[str, ...]) -> Array:
    """[s, mm, mm] Where the sled goes if all is well."""
    scene = Scene(seed)
    start = scene.machine.seconds
    scene.send(lines)
    return np.array([row for row in scene.wire.way if row[0] >= start])


def length_of(way: Array) -> float:
    """[mm]"""
    return float(np.hypot(*np.diff(way, axis=0).T).sum())


def farthest_from(way: Array, went: Array) -> float:
    """[mm] The place farthest from all places of a way."""
    along = np.concatenate([[0], np.hypot(*np.diff(way, axis=0).T).cumsum()])
    dense = np.arange(0, along[-1] + SPACING, SPACING)
    places = np.column_stack([np.interp(dense, along, column) for column in way.T])
    return float(np.max(scipy.spatial.cKDTree(places).query(went)[0]))


def are_kept(before: dict[str, str], after: dict[str, str], lines: Sequence[str]) -> bool:
    """Return whether each setting has its value, or the value that a line of the job gave it."""
    written = {line for line in lines if line.startswith("$")}
    return before.keys() == after.keys() and all(
        value == before[number] or f"${number}={value}" in written
        for number, value in after.items()
    )
