"""The readings that can be trusted: mix-ups put right, outliers set aside, the noise known."""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from plumb.diagnosis.explanation import Board, Explanation, explain
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.outliers import (
    EXPLANATIONS,
    REPEATS,
    Outlier,
    Reading,
    Shift,
    described,
    find_mixed_up,
    mixed_up_outliers,
    readings_of,
    without,
)
from plumb.diagnosis.posterior import Posterior, explain_account, posterior_of
from plumb.fit.inputs import Inputs, Stated
from plumb.model.plain import greatest

DOUBTED = 1 / 3  # chance from which on a reading is read again: that costs a minute
SHARE_OF_OUTLIERS = 12  # with more than one in this many readings outliers are not the story


@dataclass(frozen=True)
class CleanReadings:
    """What is left without outliers, and what it says."""

    outliers: tuple[Outlier, ...]  # readings to look at again
    posterior: Posterior  # of what is left
    frame: Explanation  # of what is left, whitened by its noise

    @property
    def noise(self) -> Noise:
        """That of what is left."""
        return self.posterior.noise


def clean_readings(board: Board, inputs: Inputs) -> CleanReadings:
    """Set the readings aside that are so likely off that they are read again."""
    mixed_up = find_mixed_up(board)
    shifts, posterior = clear_outliers(mixed_up.board, inputs.stated)
    measurements = inputs.measurements
    outliers = (
        *mixed_up_outliers(mixed_up, measurements),
        *(described(shift, measurements, inputs.settings.sheet) for shift in shifts),
    )
    left = posterior.frame.board
    frame = explain(left.with_rows(left.rows, sigma=posterior.noise.sigma), start=posterior.frame)
    return CleanReadings(outliers, posterior, frame)


def clear_outliers(board: Board, stated: Stated | None) -> tuple[tuple[Shift, ...], Posterior]:
    """Set outliers aside one after the other, the likeliest first, and return how far each is off
    by all others; its reading is counted among all.
    """
    whole = posterior = posterior_of(board, stated)
    indices = readings_of(board.rows)
    most = max(1, len(indices) // SHARE_OF_OUTLIERS)
    outliers: list[Shift] = []
    while len(outliers) <= most:
        reading = outlier_of(posterior)
        if reading is None:
            return tuple(outliers), posterior
        before = posterior.frame.board
        posterior = posterior_of(before.with_rows(without(before.rows, reading)), stated)
        shift = _shift_by_rest(before, posterior, reading)
        outliers.append(replace(shift, reading=indices.pop(reading.place(before.rows))))
    return (), whole


def outlier_of(posterior: Posterior) -> Reading | None:
    """Return the reading that is so likely off that it is read again; of several readings of the
    same mark the likeliest, if one of them is.
    """
    rows, chances = posterior.frame.board.rows, posterior.outlier_chances
    readings = readings_of(rows)
    together: dict[object, float] = {}
    for reading, chance in zip(readings, chances, strict=True):
        what = _what(posterior.frame.board, reading)
        together[what] = together.get(what, 0.0) + float(chance)
    worst = readings[greatest(chances)]
    return worst if together[_what(posterior.frame.board, worst)] > DOUBTED else None


def _what(board: Board, reading: Reading) -> object:
    """Return what was read: a mark's name, or both ends of a distance."""
    rows = board.rows
    if reading.is_mark:
        return rows.names[reading.index]
    return frozenset(rows.distance_rows[reading.index].tolist())


def _shift_by_rest(before: Board, rest: Posterior, reading: Reading) -> Shift:
    """Return how far a reading is off by the likeliest account of all others."""
    board = before.with_rows(before.rows, sigma=rest.noise.sigma)
    account = rest.accounts[0]
    fitted = explain_account(explain(board), account.effects, account.acting)
    shift = shifts(fitted)[reading.place(board.rows)]
    others = [
        other
        for other in readings_of(board.rows)
        if other != reading and _what(board, other) == _what(board, reading)
    ]
    return replace(
        shift,
        against=REPEATS if others else EXPLANATIONS,
        is_one_of_two=len(others) == 1,
    )


def shifts(explanation: Explanation) -> list[Shift]:
    """Return what each reading is off by when it takes no part in the fit.

    With P = 1 - basis basis^T and r = P y, setting the numbers b free lowers chi-square by
    r_b^T (P_bb)^-1 r_b and moves them by (P_bb)^-1 r_b.
    """
    board, basis = explanation.board, explanation.basis
    of_readings = []
    for reading in readings_of(board.rows):
        numbers = reading.numbers(board.rows)
        kept = np.eye(reading.size) - basis[numbers] @ basis[numbers].T
        inverse = np.linalg.pinv(kept, rcond=1e-6, hermitian=True)
        offset = inverse @ explanation.residual[numbers]
        drop = float(explanation.residual[numbers] @ offset)
        sigma = np.sqrt(np.diag(inverse))
        of_readings.append(Shift(reading, offset * board.sigma, sigma * board.sigma, drop))
    return of_readings
