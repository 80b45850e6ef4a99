"""Errors that an explanation draws, mark by mark.

An explanation refits the frame, so it changes what the frame alone leaves. That change is what the
marks can show of it.
"""

from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.explanation import Explanation
from plumb.fit.compare import chain_errors, hung_places
from plumb.fit.observations import Observations
from plumb.fit.sighting import Sighting, sighted
from plumb.model.predict import Array, settings_of
from plumb.settings.machine import MachineSettings


@dataclass(frozen=True)
class Drawn:
    """Chain that an explanation adds to the frame's fit."""

    moved: Array  # (k, 2) [mm] of the marks on the sheet
    chains: Array  # (k, 2) [mm] at the marks, left and right


def drawn_by(frame: Explanation, explanation: Explanation, rows: Observations) -> Drawn:
    """Return what an explanation adds to the frame's fit at the marks of `rows`."""
    model = model_by(frame)
    moved = _moved(frame, explanation, rows)
    chains = chain_errors(model, hung_places(model, rows), moved, rows.sled_weights)
    return Drawn(moved[rows.mark_rows], chains[rows.mark_rows])


def _moved(frame: Explanation, explanation: Explanation, rows: Observations) -> Array:
    """Return the same on the sheet (r, 2) [mm]."""
    return np.asarray(seen_by(explanation, rows).read.where - seen_by(frame, rows).read.where)


def model_by(explanation: Explanation) -> MachineSettings:
    """Return the machine as an explanation has it."""
    problem = explanation.board.problem
    values, _ = problem.values(explanation.unknowns)
    return settings_of(values, like=problem.settings)


def seen_by(explanation: Explanation, rows: Observations) -> Sighting:
    """Return what an explanation says is measured on each visit."""
    problem = explanation.board.problem
    values, outside = problem.values(explanation.unknowns)
    return sighted(
        values,
        outside,
        rows,
        over_top=problem.settings.feed == "top",
        usual_weight=problem.settings.sled_weight,
        names=(),
    )
