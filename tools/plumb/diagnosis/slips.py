"""Slips: single readings that disagree with every explanation, looked for before any effect.

A reading is named where the marks make it far more likely that this reading is off than that all
readings are right: whatever effects act, up to all of them, and whatever smooth field does. So two
hidden effects hide no slip, and a bump, which moves several marks alike, is none.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.board.observations import Observations
from plumb.diagnosis.explanation import Board, Explanation, explain
from plumb.diagnosis.misfit import LEVEL as MISFIT_LEVEL
from plumb.diagnosis.misfit import misfit_chance
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.noise_sources import noise_on
from plumb.diagnosis.readings import Reading, Shift, readings_of, without
from plumb.diagnosis.slips_in_repeats import clear_repeats, twins_that_agree
from plumb.diagnosis.weighing import weigh
from plumb.fit.inputs import Stated
from plumb.model.ranks import greatest

Array = np.ndarray
SURE = 0.7  # how likely a slip must be to be named; without one it is hardly ever above 0.1
SAME = 0.01  # share of sigma by which a change of it is no matter
MANY = 15  # readings of which no single effect explains one that is off
FEWEST = 4  # readings below which none can be distinguished from the others
SHARE_OF_SLIPS = 12  # with more slips than one in this many readings the slips are not the story


@dataclass(frozen=True)
class Cleared:
    """The readings to look at again, and what is left without them."""

    slips: tuple[Shift, ...]  # their readings counted among all
    rows: Observations
    noise: Noise
    frame: Explanation  # of what is left
    singles: tuple[Explanation, ...]  # the same with each candidate


def shifts(explanation: Explanation) -> list[Shift]:
    """What each reading is off by when it takes no part in the fit.

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


def clear_slips(board: Board, candidates: Sequence[str], *, stated: Stated | None) -> Cleared:
    """Set slips aside one after the other, worst first; before all else those that disagree with
    their repeats."""
    repeats = clear_repeats(board, stated)
    board = _with_noise(board, repeats.rows, stated)
    whole, indices = board, list(repeats.indices)
    most = max(1, len(indices) // SHARE_OF_SLIPS)
    slips: list[Shift] = []
    while len(slips) <= most:
        reading = _slip_of(board, candidates, stated)
        if reading is None:
            break
        rest = _with_noise(board, without(board.rows, reading), stated)
        shift = _shift_of(board, rest, reading, candidates, stated)
        slips.append(replace(shift, reading=indices.pop(reading.place(board.rows))))
        board = rest
    if len(slips) > most:
        slips, board = [], whole
    frame = explain(board)
    singles = tuple(explain(board, (name,), start=frame) for name in candidates)
    noise = noise_on(board, stated)
    return Cleared((*repeats.slips, *slips), board.rows, noise, frame, singles)


def _with_noise(board: Board, rows: Observations, stated: Stated | None) -> Board:
    """The board with these rows, whitened by their noise."""
    noise = noise_on(board.with_rows(rows), stated)
    return board.with_rows(rows, sigma=noise.sigma)


def _slip_of(board: Board, candidates: Sequence[str], stated: Stated | None) -> Reading | None:
    """The reading that is surely off; None if there is none.

    The noise is that of all others: a slip must not hide in what it makes of the noise.
    """
    readings = readings_of(board.rows)
    # A reading that its repeats confirm is no slip, whatever explanations say of it.
    confirmed = twins_that_agree(board.rows, board.sigma)
    allowed = np.array([reading not in confirmed for reading in readings], dtype=bool)
    if len(readings) < FEWEST or not allowed.any():
        return None
    chances = _chances(board, candidates, stated, allowed)
    worst = greatest(chances)
    rest = _with_noise(board, without(board.rows, readings[worst]), stated)
    if rest.sigma < board.sigma * (1 - SAME):
        chances = _chances(
            board.with_rows(board.rows, sigma=rest.sigma), candidates, stated, allowed
        )
        worst = greatest(chances)
    if chances[worst] <= SURE or _is_explained(board, candidates, stated):
        return None
    return readings[worst]


def _is_explained(board: Board, candidates: Sequence[str], stated: Stated | None) -> bool:
    """Whether a single effect, refitted in full, explains all of many readings.

    Accounts are weighed by slopes, which an effect beyond all sizes that were met outruns.
    """
    if len(readings_of(board.rows)) < MANY:
        return False
    noise = noise_on(board, stated)
    frame = explain(board)
    singles = (explain(board, (name,), start=frame) for name in candidates)
    return any(misfit_chance(single, noise) > MISFIT_LEVEL for single in singles)


def _chances(
    board: Board, candidates: Sequence[str], stated: Stated | None, allowed: Array
) -> Array:
    """How likely each reading is off."""
    noise = noise_on(board, stated)
    return weigh(explain(board), candidates, replace(noise, sigma=board.sigma)).slip_chances(
        allowed
    )


def _shift_of(
    board: Board,
    rest: Board,
    reading: Reading,
    candidates: Sequence[str],
    stated: Stated | None,
) -> Shift:
    """How far a reading is off by the likeliest account of all others."""
    effects = weigh(explain(rest), candidates, noise_on(rest, stated), with_slips=False).best
    by_rest = explain(board.with_rows(board.rows, sigma=rest.sigma), effects)
    return shifts(by_rest)[reading.place(board.rows)]
