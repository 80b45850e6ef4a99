"""How easily several effects together draw what they have no part in.

Enough effects draw anything on few marks. Before two or three are believed, smooth fields that no
mechanics made are laid on the same marks, as large as what is there to explain; the share of them
that some combination would explain as well says how little its success means.
"""

from __future__ import annotations

from collections.abc import Sequence
from itertools import combinations

import numpy as np
import scipy

from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.misfit import LEVEL as MISFIT_LEVEL
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.sizes import possible_sizes

Array = np.ndarray
BELIEVABLE = 0.05  # share of fields beyond which a combination that fits proves nothing
WIDTHS = (0.35, 0.7, 1.4)  # of the fields' details, in halves of what the marks span
DRAWS = 80  # fields of each width
SEED = 20180903


def chance_of_imitation(
    frame: Explanation, felt: Sequence[str], size: int, noise: Noise, *, real: bool
) -> float:
    """Share of fields, as large as the misfit of the frame, that some `size` effects explain; with
    `real` only sizes that a real machine can have count."""
    count, basis = frame.board.rows.count, frame.basis
    spare = count - float(np.sum(basis[:count] ** 2))
    fields = _fields(frame)
    fields -= basis @ (basis.T @ fields)
    lengths = np.linalg.norm(fields, axis=0)
    fields = fields[:, lengths > 1e-9] / lengths[lengths > 1e-9]
    # A field of the misfit's length, less what noise has in it.
    fields *= np.sqrt(max(frame.cost - spare, 0.0))
    drawn = np.zeros_like(fields)
    drawn[:count] = np.random.default_rng(SEED).standard_normal((count, fields.shape[1]))
    seen = fields + drawn - basis @ (basis.T @ drawn)
    explained = np.zeros(seen.shape[1], dtype=bool)
    for effects in combinations(felt, size):
        explained |= _explained(frame, effects, seen, noise, real=real)
    return float(explained.mean())


def _explained(
    frame: Explanation, effects: tuple[str, ...], seen: Array, noise: Noise, *, real: bool
) -> Array:
    """Which columns these effects explain."""
    board = frame.board
    columns = board.columns(effects)
    drawn = frame.beyond_fit(effects)
    inverse = np.linalg.pinv(drawn, rcond=1e-6)
    sizes = inverse @ seen
    left = seen - drawn @ sizes
    count = board.rows.count
    spare = count - len(columns) - float(np.sum(frame.basis[:count] ** 2))
    if spare < 1:
        return np.ones(seen.shape[1], dtype=bool)
    fits: Array = np.sum(left[:count] ** 2, axis=0) <= scipy.special.chdtri(spare, MISFIT_LEVEL)
    if not real:
        return fits
    half = noise.quantile * np.sqrt(np.sum(inverse**2, axis=1))
    explained: Array = fits & possible_sizes(board, columns, sizes, half)
    return explained


def _fields(frame: Explanation) -> Array:
    """Smooth random fields as they would be measured, whitened, in columns."""
    rows = frame.board.rows
    sighting, _ = frame.board.problem.predict(frame.unknowns)
    places = sighting.taped.where
    half = np.maximum(np.ptp(places, axis=0) / 2, 1.0)
    apart = (places[:, np.newaxis] - places[np.newaxis]) / half
    squares = np.sum(apart**2, axis=2)
    source = np.random.default_rng(SEED + 1)
    fields = []
    for width in WIDTHS:
        values, axes = np.linalg.eigh(np.exp(-squares / (2 * width**2)))
        root = axes * np.sqrt(np.maximum(values, 0.0))
        moved = np.einsum("ij,jcd->icd", root, source.standard_normal((len(places), 2, DRAWS)))
        marks = moved[rows.mark_rows].reshape(-1, DRAWS)
        ends = moved[rows.distance_rows]
        along = places[rows.distance_rows]
        along = along[:, 1] - along[:, 0]
        along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
        spans = np.einsum("mi,mid->md", along, ends[:, 1] - ends[:, 0])
        fields.append(np.vstack([marks, spans]))
    measured = np.hstack(fields) / frame.board.sigma
    priors = np.zeros((len(frame.residual) - rows.count, measured.shape[1]))
    return np.vstack([measured, priors])
