"""The readings that can be trusted: mix-ups put right, slips set aside, the noise known."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.explanation import Board, Explanation, explain
from plumb.diagnosis.mixed_up import find_mixed_up, mixed_up_slips
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.slip_cause import Slip, described
from plumb.diagnosis.slips import clear_slips
from plumb.fit.inputs import Inputs
from plumb.model.catalogue import effect_names


@dataclass(frozen=True)
class CleanReadings:
    """What is left without slips, and how the frame and each effect by itself explain it."""

    slips: tuple[Slip, ...]  # readings to look at again
    noise: Noise
    frame: Explanation
    felt: tuple[str, ...]  # effects that change any of the measured numbers
    singles: Mapping[str, Explanation]  # by effect, those that nothing feels too


def clean_readings(board: Board, inputs: Inputs) -> CleanReadings:
    """Look for mixed-up readings and slips before any effect is suspected."""
    felt = felt_effects(explain(board))
    mixed_up = find_mixed_up(board)
    cleared = clear_slips(mixed_up.board, felt, stated=inputs.stated)
    frame = cleared.frame
    singles = {single.effects[0]: single for single in cleared.singles}
    for name in effect_names():
        # What the marks do not feel needs no search, but is listed too.
        if name not in singles:
            singles[name] = explain(frame.board, (name,), start=frame)
    measurements = inputs.measurements
    slips = (
        *mixed_up_slips(mixed_up, measurements),
        *(described(shift, measurements, inputs.settings.sheet) for shift in cleared.slips),
    )
    return CleanReadings(slips, cleared.noise, frame, felt, singles)


def felt_effects(frame: Explanation) -> tuple[str, ...]:
    """Effects that change any of the measured numbers."""
    board = frame.board
    return tuple(name for name in effect_names() if np.any(frame.slopes[:, board.columns([name])]))
