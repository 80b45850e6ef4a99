"""Times of `plumb next` and of what a plan could tell, without printing, on marks made up."""

from collections.abc import Callable
from dataclasses import replace
from functools import partial

import numpy as np
from plumb.bench.causes import BARE
from plumb.diagnosis import diagnose
from plumb.fit.inputs import Inputs
from plumb.marks.read import Mark, Measurements
from plumb.model.predict import lengths, places
from plumb.plan import propose
from plumb.plan.preview import preview

# [mm/N] arms that give enough to be proved, but leave many suspects: the slowest cases there are.
GIVES = {3: 0.006, 6: 0.008}  # by the marks in a row
SIGMA, SEED = 0.5, 1


def plan_times(best: Callable[[Callable[[], object]], float]) -> dict[str, float]:
    """Return times [ns] by name; `best` takes the time of some work."""
    times = {}
    for side, gives in GIVES.items():
        marks = board(side, gives)
        diagnosis = diagnose(Inputs(BARE, marks, sigma=SIGMA))
        left = len(diagnosis.explanations)
        name = f"lab: next after {side * side} marks, {left} suspects left"
        times[name] = best(partial(propose, diagnosis, Inputs(BARE, marks)))
    plan = board(6, 0.0)
    times["lab: preview of 36 marks"] = best(partial(preview, BARE, plan, sigma=SIGMA))
    return times


def board(side: int, gives: float) -> Measurements:
    """Return marks of a square grid, read with noise, on a frame whose arms give [mm/N]."""
    x, y = np.meshgrid(np.linspace(-1100, 1100, side), np.linspace(500, -500, side))
    targets = np.stack([x.ravel(), y.ravel()], axis=1)
    true = replace(BARE, effects={"frame_flex": {"inward": gives, "downward": gives}})
    where, _ = places(true, lengths(BARE, targets)[0])
    read = where + SIGMA * np.random.default_rng(SEED).standard_normal(where.shape)
    marks = [
        Mark(str(i), tuple(at), tuple(measured))
        for i, (at, measured) in enumerate(zip(targets.tolist(), read.tolist(), strict=True))
    ]
    return Measurements(tuple(marks), controller="plumb", source="made up")
