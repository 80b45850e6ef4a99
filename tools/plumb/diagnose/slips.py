"""Slips: single readings that disagree with every explanation, looked for before any effect.

A reading is free to be shifted (two numbers for a mark, one for a distance). It is named when that
adds more than noise would to the frame and to each effect by itself, and when the rest then fits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.board.observations import Observations
from plumb.diagnose.explanation import Board, Explanation, explain
from plumb.diagnose.misfit import LEVEL as MISFIT_LEVEL
from plumb.diagnose.misfit import library_basis, misfit_chance
from plumb.diagnose.noise import Noise
from plumb.diagnose.noise_sources import noise_on
from plumb.diagnose.readings import Shift, readings_of, without
from plumb.diagnose.significance import tail
from plumb.diagnose.sizes import possible
from plumb.diagnose.slips_in_repeats import clear_repeats, twins_that_agree
from plumb.fit.inputs import Stated

Array = np.ndarray
LEVEL = 0.01  # chance at which noise alone makes a slip of one of all readings
READINGS_PER_SLIP = 12  # with more slips than one in this many readings the slips are not the story


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
    """Set slips aside one after the other, worst first, if the rest then fits; before all else
    those that disagree with their repeats."""
    repeats = clear_repeats(board, stated)
    rows, indices = repeats.rows, list(repeats.indices)
    start = noise = noise_on(board.with_rows(rows), stated)
    slips: list[Shift] = []
    most = max(1, len(indices) // READINGS_PER_SLIP)
    whole = fitted = _single(board.with_rows(rows, sigma=noise.sigma), candidates)
    while len(slips) <= most:
        worst = _worst(fitted, stated, noise)
        if worst is None:
            break
        slips.append(replace(worst, reading=indices.pop(worst.reading.place(rows))))
        rows = without(rows, worst.reading)
        noise = noise_on(board.with_rows(rows, sigma=noise.sigma), stated)
        fitted = _single(board.with_rows(rows, sigma=noise.sigma), candidates)
    if slips and len(slips) <= most and _fits(fitted, noise):
        all_slips = (*repeats.slips, *slips)
        return Cleared(all_slips, rows, noise, fitted[0], tuple(fitted[1:]))
    return Cleared(repeats.slips, repeats.rows, start, whole[0], tuple(whole[1:]))


def _worst(fitted: Sequence[Explanation], stated: Stated | None, noise: Noise) -> Shift | None:
    """The reading that no single effect explains, with its shift by the frame alone or the best
    effect; None if there is none.

    An effect that would need a size that no real machine has explains nothing here. The noise is
    that of all others: a slip must not hide in what it makes of the noise.
    """
    explanations, board = _possible(fitted, noise), fitted[0].board
    by_explanation = [shifts(explanation) for explanation in explanations]
    twins = twins_that_agree(board.rows)
    drops = np.array([[shift.drop for shift in of_each] for of_each in by_explanation])
    if drops.shape[1] < 4:
        return None
    # A reading that its repeats confirm is no slip, whatever explanations say of it.
    confirmed = np.array([shift.reading in twins for shift in by_explanation[0]])
    everything = _drops_beyond_library(explanations[0])
    # What remains by the explanation that needs the slip least, or by all effects at once.
    least = np.maximum(drops.min(axis=0), everything)
    sizes = np.array([shift.reading.size for shift in by_explanation[0]])
    chances = np.array([tail(g, s, np.inf) for g, s in zip(least, sizes, strict=True)])
    chances[confirmed] = 1.0
    if confirmed.all():
        return None
    worst = int(np.lexsort((-least, chances))[0])
    reading = by_explanation[0][worst].reading
    others = noise_on(board.with_rows(without(board.rows, reading), sigma=board.sigma), stated)
    drop = least[worst] * (board.sigma / others.sigma) ** 2
    if tail(drop, reading.size, others.degrees) * len(least) > LEVEL:
        return None
    costs = [
        explanation.cost - of_each[worst].drop
        for explanation, of_each in zip(explanations, by_explanation, strict=True)
    ]
    return by_explanation[int(np.argmin(costs))][worst]


def _drops_beyond_library(explanation: Explanation) -> Array:
    """Each reading's drop of chi-square beyond all effects of the library at once."""
    basis = library_basis(explanation)
    left = explanation.residual - basis @ (basis.T @ explanation.residual)
    drops = []
    for reading in readings_of(explanation.board.rows):
        numbers = reading.numbers(explanation.board.rows)
        kept = np.eye(reading.size) - basis[numbers] @ basis[numbers].T
        drops.append(
            left[numbers] @ np.linalg.pinv(kept, rcond=1e-3, hermitian=True) @ left[numbers]
        )
    return np.array(drops)


def _single(board: Board, candidates: Sequence[str]) -> list[Explanation]:
    """The frame alone, then with each effect."""
    frame = explain(board)
    return [frame, *(explain(board, (name,), start=frame) for name in candidates)]


def _possible(fitted: Sequence[Explanation], noise: Noise) -> list[Explanation]:
    """Those of sizes that a real machine can have; the frame alone is the first."""
    return [explanation for explanation in fitted if possible(explanation, noise)]


def _fits(fitted: Sequence[Explanation], noise: Noise) -> bool:
    """Whether the frame alone or with one effect leaves no more than noise."""
    return any(
        misfit_chance(explanation, noise) > MISFIT_LEVEL for explanation in _possible(fitted, noise)
    )
