"""The fingerprint of an effect on a board: what it does to places, and what the marks can show."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plumb.board.observations import Observations
from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.suspect_curves import model_by, seen_by, visits_all_over
from plumb.model.predict import Array

COUNTS = (9, 5)  # places across and up
SHARE = 0.88  # of the sheet


@dataclass(frozen=True)
class Fingerprint:
    """An effect in the size of an explanation, on places all over the sheet."""

    places: Array  # (n, 2) [mm]
    alone: Array  # (n, 2) [mm] by how much it moves what is measured there
    beyond: Array  # (n, 2) [mm] what is left of that when the frame is refitted to the marks
    alone_rms: float  # [mm] of the readings, as vectors if they are marks
    beyond_rms: float  # [mm]


def fingerprint_of(explanation: Explanation, effect: str, rows: Observations) -> Fingerprint:
    """The fingerprint of one of the explanation's effects; the sled goes to each place in the way
    of the nearest visit in `rows`."""
    sheet = visits_all_over(model_by(explanation), rows, counts=COUNTS, share=SHARE)
    columns, frame = explanation.board.columns([effect]), explanation.board.frame
    whole = _sizes(explanation, columns)
    without = explanation.unknowns.copy()
    without[columns] -= whole
    drawn = explanation.slopes[:, columns] @ whole
    fitting = np.linalg.lstsq(explanation.slopes[:, frame], drawn, rcond=1e-10)[0]
    refitted = without.copy()
    refitted[frame] += fitting
    there = seen_by(explanation, sheet).read.where
    return Fingerprint(
        places=sheet.targets,
        alone=there - seen_by(explanation, sheet, unknowns=without).read.where,
        beyond=there - seen_by(explanation, sheet, unknowns=refitted).read.where,
        alone_rms=_rms(explanation, drawn),
        beyond_rms=_rms(explanation, drawn - explanation.slopes[:, frame] @ fitting),
    )


def _sizes(explanation: Explanation, columns: Array) -> Array:
    """How large the parameters are in all, in typical sizes: what the settings have, too."""
    problem = explanation.board.problem
    whole: Array = problem.start[columns] / problem.scale[columns] + explanation.unknowns[columns]
    return whole


def _rms(explanation: Explanation, whitened: Array) -> float:
    """Over the marks as vectors, or over distances where no mark was measured [mm]."""
    rows = explanation.board.rows
    counted = whitened[: rows.measured.size] if len(rows.measured) else whitened[: rows.count]
    count = len(rows.measured) or rows.count
    return float(np.linalg.norm(counted) * explanation.board.sigma / np.sqrt(count))
