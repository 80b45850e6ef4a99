"""A board made linear about a fit, and what is left of it once noise and frame are allowed for.

What is measured is then a sum of normals: noise, the frame within its priors, effects, and perhaps
a smooth field or a round that moved. With Z = [frame, effects, readings] as columns, all that any
account needs is the Gram matrix Z' C^-1 Z, where C holds noise and field. The frame is integrated
out by a Schur complement. A field is written in few orthonormal columns U with variances l, so
Woodbury's identity gives C^-1 for each noise s and each field without another factorization:

    C^-1 = (1 - U diag(l / (s^2 + l)) U') / s^2
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.diagnosis.explanation import Board, Explanation, gaussian_process_columns
from plumb.diagnosis.priors import (
    FIELD_SPREADS,
    FIELD_WIDTHS,
    ROUND_SPREAD,
    SizePriors,
    size_priors,
    turned,
)
from plumb.model.catalogue import ZEROING_NAMES

Array = np.ndarray
ROUNDING = 1e-9  # [mm] less than that moves nothing
LEFT_OUT = 1e-3  # share of the noise's variance to which a field is described


@dataclass(frozen=True)
class LinearBoard:
    """Readings and slopes about a fit. Measured numbers come first, then direct checks.

    Rows of measured numbers are in mm, those of checks in their standard deviations; effects are
    in typical sizes (pitches as `turned` has them), the frame in standard deviations of its priors.
    """

    measured: int  # rows of measured numbers
    frame: Array  # (n, f)
    effects: Array  # (n, p)
    read: Array  # (n, boards) less what the settings predict with usual sizes
    columns: dict[str, Array]  # of each effect that is felt, among the p
    sizes: SizePriors

    @staticmethod
    def of(at: Explanation, felt: Sequence[str]) -> LinearBoard:
        """Make the board of an explanation linear about its fit, with the effects that are felt."""
        board = at.board
        count, held = board.rows.count, int(board.problem.held.sum())
        kept = np.r_[0:count, count + held : len(at.residual) - board.usual]
        slopes = _unwhitened(at.slopes[kept], count, board.sigma)
        read = at.residual[kept] + at.slopes[kept] @ at.unknowns
        columns = board.columns(felt)
        sizes = size_priors(board, columns)
        read = _unwhitened(read[:, np.newaxis], count, board.sigma)
        starts = np.cumsum([0, *(len(board.columns([name])) for name in felt)])
        return LinearBoard(
            measured=count,
            frame=slopes[:, board.frame],
            effects=turned(board, columns, slopes[:, columns]),
            read=read - slopes[:, columns] @ sizes.mean[:, np.newaxis],
            columns={
                name: np.arange(low, high)
                for name, low, high in zip(felt, starts[:-1], starts[1:], strict=True)
            },
            sizes=sizes,
        )


def _unwhitened(rows: Array, measured: int, sigma: float) -> Array:
    return np.vstack([rows[:measured] * sigma, rows[measured:]])


# What else may move readings: a smooth field, and a round that was moved.


@dataclass(frozen=True)
class Disturbance:
    """Something that moves the measured numbers as independent normals do."""

    axes: Array  # (n, r) orthonormal
    variances: Array  # (r,) [mm^2]

    @staticmethod
    def of(columns: Array) -> Disturbance:
        """Return what columns (n, c) [mm] of independent normals move."""
        left, sizes, _ = np.linalg.svd(columns, full_matrices=False)
        seen = sizes > 1e-6 * max(sizes.max(initial=0.0), 1e-9)
        return Disturbance(left[:, seen], sizes[seen] ** 2)

    def times(self, length: float) -> Disturbance:
        """Return the same, larger by a factor."""
        return replace(self, variances=self.variances * length**2)


def smooth_fields(frame: Explanation, sigma: float) -> list[Disturbance]:
    """Return smooth fields that no effect draws, of all usual widths and spreads; sigma [mm]."""
    least = LEFT_OUT * sigma**2 / max(FIELD_SPREADS) ** 2
    return [
        unit.times(spread)
        for columns in gaussian_process_columns(frame, FIELD_WIDTHS, least)
        for unit in [Disturbance.of(columns)]
        for spread in FIELD_SPREADS
    ]


@dataclass(frozen=True, eq=False)
class MovedRound:
    """A later round that does not go with the others, and what would make it so."""

    number: int
    cause: str  # "new_sheet", "chains_rezeroed", or "" for another machine
    other: Disturbance


def moved_rounds(frame: Explanation) -> list[MovedRound]:
    """Return how each later round may have been moved; none if all marks are of one round."""
    board, rows = frame.board, frame.board.rows
    number = np.concatenate([np.repeat(rows.rounds[rows.mark_rows], 2), rows.distance_rounds])
    slopes = frame.slopes[: rows.count] * board.sigma
    by_cause = _causes_of_moves(board, slopes)
    return [
        MovedRound(int(later), cause, Disturbance.of(columns[:, moved] * mine[:, np.newaxis]))
        for later in np.unique(number)[1:]
        for mine in [number == later]
        for cause, columns in by_cause.items()
        for moved in [np.any(np.abs(columns[mine]) > ROUNDING, axis=0)]
        if moved.any()
    ]


def _causes_of_moves(board: Board, slopes: Array) -> dict[str, Array]:
    """Columns (n, c) [mm] of what may change from one round to the next."""
    names, scale, marks = board.problem.names, board.problem.scale, board.rows.measured.size
    shifts = np.zeros((len(slopes), 2))
    for axis in (0, 1):
        shifts[axis:marks:2, axis] = ROUND_SPREAD
    zeros = [names.index(name) for name in ZEROING_NAMES]
    hung = slopes[:, zeros] * ROUND_SPREAD / scale[zeros]
    turned = slopes[:, [i for i in board.frame if names[i] == "sheet_rotation"]]
    everything = np.hstack([shifts, hung, slopes[:, board.frame]])
    return {"new_sheet": np.hstack([shifts, turned]), "chains_rezeroed": hung, "": everything}


# Gram matrices of readings and effects, for each noise, with the frame integrated out.


@dataclass(frozen=True)
class Metric:
    """Distances between readings: for each of m noises, with noise, frame and one other thing."""

    sigmas: Array  # (m,) [mm] of the noise
    gram: Array  # (m, p, p) of the effects
    along: Array  # (m, p, boards) of effects and readings
    square: Array  # (m, boards) of the readings
    log_determinant: Array  # (m,) of the covariance of the readings

    @staticmethod
    def of(
        board: LinearBoard, sigmas: Array, other: Disturbance | None = None, *, pitch: bool = False
    ) -> Metric:
        """Return the metrics for noises (m,) [mm]; `pitch`: with chains as makers sell them."""
        columns = np.hstack([board.frame, board.effects, board.read])
        inside, beyond = np.split(columns, [board.measured])
        precision = 1 / sigmas**2
        whole = precision[:, np.newaxis, np.newaxis] * (inside.T @ inside) + beyond.T @ beyond
        log_determinant = board.measured * 2 * np.log(sigmas)
        if other is not None:
            seen = other.axes.T @ inside
            taken = other.variances / (sigmas[:, np.newaxis] ** 2 + other.variances)
            weights = precision[:, np.newaxis] * taken
            whole = whole - np.einsum("ri,mr,rj->mij", seen, weights, seen, optimize=True)
            log_determinant = log_determinant - np.sum(np.log1p(-taken), axis=1)
        return _without_frame(board, sigmas, whole, log_determinant, pitch=pitch)


def _without_frame(
    board: LinearBoard, sigmas: Array, whole: Array, log_determinant: Array, *, pitch: bool
) -> Metric:
    """Integrate the frame out of Gram matrices (m, z, z), and usual pitch if asked."""
    frame, effects = board.frame.shape[1], board.effects.shape[1]
    drifting = np.flatnonzero(board.sizes.pitch) if pitch else np.zeros(0, dtype=int)
    loose = np.concatenate([np.arange(frame), frame + drifting])
    spread = np.concatenate([np.ones(frame), board.sizes.pitch[drifting]])
    kept = np.arange(frame, whole.shape[1])
    inner = whole[:, loose[:, np.newaxis], loose] * np.outer(spread, spread) + np.eye(len(loose))
    mixed = whole[:, loose[:, np.newaxis], kept] * spread[:, np.newaxis]
    rest = whole[:, frame:, frame:] - np.swapaxes(mixed, 1, 2) @ np.linalg.solve(inner, mixed)
    return Metric(
        sigmas=sigmas,
        gram=rest[:, :effects, :effects],
        along=rest[:, :effects, effects:],
        square=np.diagonal(rest[:, effects:, effects:], axis1=1, axis2=2),
        log_determinant=log_determinant + np.linalg.slogdet(inner)[1],
    )


def rows_in_metric(board: LinearBoard, sigma: float) -> tuple[Array, Array]:
    """Return C^-1 [effects, first readings] (n, p + 1), and C^-1 among the two numbers of each
    mark or the number of each distance, with noise and frame in C.
    """
    weight = np.r_[
        np.full(board.measured, 1 / sigma**2), np.ones(len(board.frame) - board.measured)
    ]
    weighted = weight[:, np.newaxis] * board.frame
    inner = np.eye(board.frame.shape[1]) + board.frame.T @ weighted
    root = np.linalg.solve(np.linalg.cholesky(inner), weighted.T).T
    drawn = np.hstack([board.effects, board.read[:, :1]])
    return weight[:, np.newaxis] * drawn - root @ (root.T @ drawn), root
