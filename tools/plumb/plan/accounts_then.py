"""The accounts that the diagnosis would list after a planned measurement.

The diagnosis weighs them by the slopes at the fit of the frame, whatever is true; so the readings
that a hypothesis predicts are written as what is left of that fit. How likely a field of no effect
is stays as it is: the hypotheses know of none.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import pairwise

import numpy as np

from plumb.diagnosis.likeliest import listing
from plumb.diagnosis.linear_board import LinearBoard, Metric
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.weighing import accounts
from plumb.plan.ahead import Planned
from plumb.plan.case import Case, Hypothesis

Array = np.ndarray
Effects = tuple[str, ...]


def accounts_then(
    case: Case, planned: Planned, noise: Noise, trials: Sequence[tuple[Hypothesis, Array]]
) -> list[list[tuple[Effects, ...]]]:
    """The accounts listed on each board of each trial: a hypothesis, and boards (rows, count) drawn
    from it, relative to what it predicts of the frame alone."""
    rows, board = planned.ahead(case.frame), case.board
    felt = [name for name in board.effect_columns if rows.slopes[:, board.columns([name])].any()]
    new = [
        boards[rows.so_far :] + _apart(case, planned, hypothesis)[:, np.newaxis]
        for hypothesis, boards in trials
    ]
    linear = LinearBoard.of(case.frame, felt, noise).with_more(
        board, rows.slopes[rows.so_far :], np.hstack(new), noise
    )
    sets, before = accounts(case.frame, felt)
    evidences = before[:, np.newaxis] + Metric.of(linear).evidences(linear.parts(sets))
    listed = [tuple(each.effects for each in listing(sets, column)) for column in evidences.T]
    ends = np.cumsum([0, *(boards.shape[1] for _, boards in trials)])
    return [listed[start:end] for start, end in pairwise(ends)]


def _apart(case: Case, planned: Planned, hypothesis: Hypothesis) -> Array:
    """What planned readings (rows,) have beyond those of a hypothesis's boards when they are
    counted from the start of the frame's fit, as slopes have it."""
    board, truth, frame = case.board, planned.ahead(hypothesis.at), planned.ahead(case.frame)
    unknowns, of_effects = hypothesis.at.unknowns, board.columns(hypothesis.at.effects)
    apart: Array = truth.slopes[truth.so_far :, board.frame] @ unknowns[board.frame]
    between = truth.where - frame.where
    by_effects = truth.slopes[truth.so_far :, of_effects] @ unknowns[of_effects]
    by_frame = frame.slopes[frame.so_far :, board.frame] @ case.frame.unknowns[board.frame]
    seen = np.flatnonzero(np.isfinite(between))
    apart[seen] = between[seen] - by_effects[seen] + by_frame[seen]
    return apart
