"""Whether the sled can take the way to planned marks, as heavy as it is on each part of it."""

from __future__ import annotations

import math
from collections.abc import Iterator, Sequence

import numpy as np

from plumb.grid.way import WAY_STEP
from plumb.marks.model import Mark
from plumb.plan.sites import usable
from plumb.plan.visits_program import way_into
from plumb.settings.machine import MachineSettings
from plumb.text.errors import InputError

Place = tuple[float, float]


def refuse_way(settings: MachineSettings, marks: Sequence[Mark]) -> None:
    """Raise InputError for the first mark whose way leaves the sheet or what the sled can reach."""
    here: Place = (0.0, 0.0)
    half = settings.sheet_width / 2, settings.sheet_height / 2
    for mark in marks:
        weight = mark.sled_weight or settings.sled_weight
        for end in (way_into(mark), mark.target):
            passed = np.array(list(_between(here, end)))
            is_off = bool((np.abs(passed) > np.array(half) + 1e-6).any())
            if is_off or not usable(settings, passed, weight).all():
                where = "leaves the sheet" if is_off else "passes where the sled cannot hang well"
                raise InputError(
                    f"the way to mark {mark.name} {where}: take another measurement of the verdict"
                )
            here = end


def _between(start: Place, end: Place) -> Iterator[Place]:
    """Places on a straight way, with its end."""
    steps = max(math.ceil(math.dist(start, end) / WAY_STEP), 1)
    for step in range(1, steps + 1):
        share = step / steps
        yield (
            start[0] + share * (end[0] - start[0]),
            start[1] + share * (end[1] - start[1]),
        )
