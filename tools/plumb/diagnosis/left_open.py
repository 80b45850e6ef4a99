"""How much of a machine's errors the marks leave open, all over its sheet.

Before anything is measured, each number of the frame is wrong by its stated error, and each effect
that the library knows may be there in its typical size, all independent of each other. Marks close
a part of that, provable or not: a row of marks closes little, however well its few errors are
fitted. Where the sheet lies is left out, for that is no error among the holes of a job.
"""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.expected_error import hung
from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.suspect_curves import model_by
from plumb.fit.expected import places_over
from plumb.model.predict import FOUND, NAMES, Array, lengths

MOST_OPEN = 0.3  # share: marks on both edges of the sheet leave less, a row of marks leaves more


@dataclass(frozen=True)
class LeftOpen:
    """Errors to expect, RMS over the sheet when it is laid at its best [mm]."""

    before: float  # anything was measured
    now: float

    @property
    def is_too_much(self) -> bool:
        """Whether settings by these marks would be a guess over most of the sheet."""
        return self.now > MOST_OPEN * self.before


def left_open(explanation: Explanation) -> LeftOpen:
    """What the marks of an explanation leave open, by its slopes."""
    board = explanation.board
    machine = [i for i, name in enumerate(board.problem.names) if name in NAMES]
    moved = _among_each_other(explanation, machine)
    measured, known = np.split(explanation.slopes, [board.rows.count])
    typical = np.ones(len(board.problem.names))
    typical[board.frame] = 0.0  # its priors are among what is known
    before = known.T @ known + np.diag(typical)

    def rms(precision: Array) -> float:
        covariance = np.linalg.inv(precision)[np.ix_(machine, machine)]
        variance = np.einsum("rij,jk,rik->", moved, covariance, moved)
        return float(np.sqrt(variance / len(moved)))

    return LeftOpen(rms(before), rms(before + measured.T @ measured))


def _among_each_other(explanation: Explanation, columns: list[int]) -> Array:
    """How places (n, 2, u) [mm] move by these unknowns, the sheet shifted and turned back."""
    problem = explanation.board.problem
    targets = places_over(model_by(explanation).sheet)
    chains, outcome = lengths(model_by(explanation), targets)
    where, slopes, hanging = hung(explanation, chains)
    good = (outcome == FOUND) & (hanging == FOUND)
    where, slopes = where[good], slopes[good]
    by_name = slopes[:, :, [NAMES.index(problem.names[i]) for i in columns]]
    moved = (by_name * problem.scale[columns]).reshape(-1, len(columns))
    turned = np.stack([-where[:, 1], where[:, 0]], axis=1).reshape(-1, 1)
    shifted = np.tile(np.eye(2), (len(where), 1))
    pose, _ = np.linalg.qr(np.hstack([shifted, turned]))
    apart: Array = (moved - pose @ (pose.T @ moved)).reshape(len(where), 2, len(columns))
    return apart
