"""Readings that were written down for each other: two marks, or two distances, mixed up.

Either of the two looks like a slip, and one slip at a time does not clear both. To undo it is
one guess without a free number, so a large drop of chi-square is hardly ever luck.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.misfit import library_basis
from plumb.diagnosis.slip_cause import Slip
from plumb.marks.read import Measurements
from plumb.model.ranks import greatest

Array = np.ndarray
LUCK = 0.001  # chance that noise alone makes any pair look mixed up
APART = 6.0  # [sigma] readings closer than this are not worth a thought
SHARE = 0.8  # of what setting both readings free would gain: then it was no two separate slips
MOST = 3  # pairs; with more the list is in disorder


@dataclass(frozen=True)
class MixedPair:
    """Two readings of one kind, by their indices among the marks or the distances."""

    first: int
    second: int
    is_mark: bool


@dataclass(frozen=True)
class MixedUp:
    """The pairs that were mixed up, and the board with their readings put right."""

    pairs: tuple[MixedPair, ...]
    board: Board


def find_mixed_up(board: Board) -> MixedUp:
    """Put pairs right, one after the other, the surest first."""
    pairs: list[MixedPair] = []
    while len(pairs) < MOST:
        best = _best(board)
        if best is None:
            break
        pairs.append(best)
        board = _undone(board, best)
    return MixedUp(tuple(pairs), board)


def mixed_up_slips(mixed_up: MixedUp, measurements: Measurements) -> list[Slip]:
    """Both readings of every exchange, each to be looked at again."""
    slips = []
    for pair in mixed_up.pairs:
        for index, other in ((pair.first, pair.second), (pair.second, pair.first)):
            slips.append(_slip(mixed_up, measurements, pair.is_mark, index, other))
    return slips


def _slip(
    mixed_up: MixedUp, measurements: Measurements, is_mark: bool, index: int, other: int
) -> Slip:
    if is_mark:
        marks = measurements.measured_marks
        names = [marks[i].name for i in (index, other)]
        read, expected = (measurements.measured[i] for i in (index, other))
    else:
        names = [" - ".join(measurements.distances[i].between) for i in (index, other)]
        read, expected = (measurements.distance_lengths[[i]] for i in (index, other))
    sigma = mixed_up.board.sigma
    both = f"its reading and that of {names[1]}" if names[0] != names[1] else "its two readings"
    return Slip(
        name=names[0],
        offset=tuple((read - expected).tolist()),
        sigma=(sigma,) * len(read),
        read=tuple(read.tolist()),
        expected=tuple(expected.tolist()),
        guess=f"{both} may be exchanged",
        corrected=tuple(expected.tolist()),
    )


def _best(board: Board) -> MixedPair | None:
    """The pair whose mix-up explains most of what the library cannot draw."""
    frame, rows = explain(board), board.rows
    basis = library_basis(frame)
    left = frame.residual - basis @ (basis.T @ frame.residual)
    marks = np.arange(rows.measured.size).reshape(-1, 2)
    spans = rows.measured.size + np.arange(len(rows.distances)).reshape(-1, 1)
    best, most, tried = None, 0.0, 0
    for numbers, readings, rounds, is_mark in (
        (marks, rows.measured, rows.rounds[rows.mark_rows], True),
        (spans, rows.distances.reshape(-1, 1), rows.distance_rounds, False),
    ):
        drops = _drops(basis, left, numbers, readings / board.sigma)
        # Nobody writes a reading into another file; what changed between them is no exchange.
        drops[rounds[:, np.newaxis] != rounds] = -np.inf
        tried += int(np.sum(drops > -np.inf))
        if drops.size and drops.max() > most:
            i, j = (int(at) for at in np.unravel_index(greatest(drops), drops.shape))
            if drops[i, j] > _needed(basis, left, numbers[[i, j]]):
                best, most = MixedPair(i, j, is_mark), float(drops[i, j])
    # exp(-drop / 2) is the ratio of likelihoods of a guess that has no free number.
    return best if best and tried * np.exp(-most / 2) < LUCK else None


def _drops(basis: Array, left: Array, numbers: Array, readings: Array) -> Array:
    """Drop of chi-square (n, n) when two readings change places; -inf where it is no question.

    With P = 1 - basis basis^T and c = +-(read_j - read_i) on the numbers of both, it is
    -(2 c . left + c^T P c).
    """
    apart = readings[np.newaxis] - readings[:, np.newaxis]
    kept = np.eye(numbers.size) - basis[numbers.ravel()] @ basis[numbers.ravel()].T
    kept = kept.reshape(*numbers.shape, *numbers.shape)
    alone = np.einsum("iaib->iab", kept)
    both = np.einsum("iajb->ijab", kept)
    bent = alone[:, np.newaxis] + alone[np.newaxis] - both - both.transpose(0, 1, 3, 2)
    pull = left[numbers][:, np.newaxis] - left[numbers][np.newaxis]
    drops = -2 * np.sum(apart * pull, axis=-1) - np.einsum("ija,ijab,ijb->ij", apart, bent, apart)
    question = np.triu(np.abs(apart).max(axis=-1, initial=0.0) > APART, 1)
    return np.where(question, drops, -np.inf)


def _needed(basis: Array, left: Array, pair: Array) -> float:
    """The drop from which on two readings were mixed up, and neither both nor one of them misread.

    The library can bend much of the board to two neighbours that are off alike. So a misread repeat
    of a mark gains by an exchange too, but less than by setting it alone free.
    """
    alone = max(_free(basis, left, numbers) for numbers in pair)
    return max(SHARE * _free(basis, left, pair.ravel()), alone)


def _free(basis: Array, left: Array, numbers: Array) -> float:
    """Drop of chi-square when these numbers are set free."""
    kept = np.eye(len(numbers)) - basis[numbers] @ basis[numbers].T
    return float(left[numbers] @ np.linalg.pinv(kept, rcond=1e-6, hermitian=True) @ left[numbers])


def _undone(board: Board, pair: MixedPair) -> Board:
    rows, order = board.rows, [pair.second, pair.first]
    measured, distances = rows.measured.copy(), rows.distances.copy()
    if pair.is_mark:
        measured[[pair.first, pair.second]] = measured[order]
    else:
        distances[[pair.first, pair.second]] = distances[order]
    return board.with_rows(replace(rows, measured=measured, distances=distances))
