"""The max-gain test: whether any effect adds more to an explanation than noise would.

Each effect's gain (drop of chi-square when it is added and all is refitted) is turned into the
chance of as much from noise, given its number of parameters; the smallest chance is compared with
the smallest that pure noise reaches on this very layout, among these very effects. So neither
searching many effects nor having many parameters is an advantage. A simulated point for each effect
by itself would do the same; the chance scale needs no simulation for it, and it is exact here.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations

import numpy as np
import scipy

from plumb.diagnosis.explanation import Explanation, negative_log_p, negative_log_ps, span
from plumb.diagnosis.noise import LEVEL as MISFIT_LEVEL
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.sizes import possible_sizes
from plumb.model.plain import ranked

Array = np.ndarray
DRAWS = 4000  # of noise: its LEVEL is then right to about 0.3 % in chance
# With 1 % for outliers and 1.5 % for misfit, five in a hundred together.
LEVEL = 0.028
ROUNDING = 0.2  # of a limit that rests on draws
SEED = 20180902  # any number: the same marks shall always give the same answer


@dataclass(frozen=True)
class Gain:
    """What an effect adds to an explanation."""

    effect: str
    drop: float  # of chi-square
    visible: int  # parameters that the layout shows beyond what is fitted already
    negative_log_p: float  # -log of the chance of as much from noise


@dataclass(frozen=True)
class Search:
    """All that could be added to an explanation, and what noise alone would reach."""

    gains: tuple[Gain, ...]  # largest -log p first
    threshold: float  # of detection: -log p that the best of noise exceeds in LEVEL of all cases

    @property
    def proved(self) -> bool:
        """Whether something adds more than noise would."""
        return bool(self.gains) and self.gains[0].negative_log_p > self.threshold

    def of(self, effect: str) -> Gain:
        """Return the gain of an effect."""
        return next(gain for gain in self.gains if gain.effect == effect)


def search(explanation: Explanation, candidates: Sequence[str], noise: Noise) -> Search:
    """Return what each candidate outside the explanation would add to it."""
    bases = bases_beyond_fit(explanation, candidates)
    return Search(gains_of(explanation, bases, noise), detection_threshold(bases, noise))


def complete(explanation: Explanation, candidates: Sequence[str], noise: Noise) -> bool:
    """Return whether nothing adds more than noise would: not `search(...).proved`, and faster.

    The limit lies between that of a single candidate and Bonferroni's, so that noise need only be
    drawn for what falls between the two.
    """
    bases = bases_beyond_fit(explanation, candidates)
    gains = gains_of(explanation, bases, noise)
    if not gains or gains[0].negative_log_p < -np.log(LEVEL):
        return True
    if gains[0].negative_log_p > np.log(len(bases) / LEVEL) + ROUNDING:
        return False
    return not Search(gains, detection_threshold(bases, noise)).proved


def gains_of(
    explanation: Explanation, bases: Mapping[str, Array], noise: Noise
) -> tuple[Gain, ...]:
    """Return what each effect with a basis adds, largest -log p first."""
    gains = []
    for effect, basis in bases.items():
        drop = float(np.sum((basis.T @ explanation.residual) ** 2))
        visible = basis.shape[1]
        gains.append(Gain(effect, drop, visible, negative_log_p(drop, visible, noise.degrees)))
    return tuple(ranked(gains, lambda gain: -gain.negative_log_p))


def bases_beyond_fit(explanation: Explanation, candidates: Sequence[str]) -> dict[str, Array]:
    """Orthonormal columns of each candidate that the explanation cannot imitate."""
    fitted = explanation.basis
    others = [name for name in candidates if name not in explanation.effects]
    return {
        name: span(
            explanation.beyond_fit([name], fitted),
            against=explanation.slopes[:, explanation.board.columns([name])],
        )
        for name in others
    }


def detection_threshold(bases: Mapping[str, Array], noise: Noise) -> float:
    """Return the -log p that the best effect reaches on noise alone in LEVEL of all cases.

    Noise is drawn in the space of all bases together: outside of it no effect feels it.
    """
    seen = [basis for basis in bases.values() if basis.shape[1]]
    if not seen:
        return float("inf")
    together = span(np.hstack(seen))
    source = np.random.default_rng(SEED)
    drawn = source.standard_normal((DRAWS, together.shape[1]))
    scale = np.ones(DRAWS)
    if np.isfinite(noise.degrees):
        scale = source.chisquare(noise.degrees, DRAWS) / noise.degrees
    best = np.zeros(DRAWS)
    for basis in seen:
        gains = np.sum((drawn @ (together.T @ basis)) ** 2, axis=1) / scale
        best = np.maximum(best, negative_log_ps(gains, basis.shape[1], noise.degrees))
    return float(np.quantile(best, 1 - LEVEL))


# How easily several effects together draw what they have no part in.
#
# Enough effects draw anything on few marks. Before two or three are believed, draws of Gaussian
# processes that no mechanics made are laid on the same marks, as large as what is there to explain;
# the share of them that some combination would explain as well says how little its success means.

BELIEVABLE = 0.05  # share of draws beyond which a combination that fits proves nothing
WIDTHS = (0.35, 0.7, 1.4)  # length scales, in halves of what the marks span
DRAWN = 80  # draws of each width
SEED_OF_DRAWN = 20180903


def chance_of_imitation(
    frame: Explanation, felt: Sequence[str], size: int, noise: Noise, *, real: bool
) -> float:
    """Share of draws, as large as the misfit of the frame, that some `size` effects explain; with
    `real` only sizes that a real machine can have count."""
    count, basis = frame.board.rows.count, frame.basis
    spare = count - float(np.sum(basis[:count] ** 2))
    draws = _gaussian_processes(frame)
    draws -= basis @ (basis.T @ draws)
    lengths = np.linalg.norm(draws, axis=0)
    draws = draws[:, lengths > 1e-9] / lengths[lengths > 1e-9]
    # A draw of the misfit's length, less what noise has in it.
    draws *= np.sqrt(max(frame.cost - spare, 0.0))
    drawn = np.zeros_like(draws)
    drawn[:count] = np.random.default_rng(SEED_OF_DRAWN).standard_normal((count, draws.shape[1]))
    seen = draws + drawn - basis @ (basis.T @ drawn)
    explained = np.zeros(seen.shape[1], dtype=bool)
    for effects in combinations(felt, size):
        explained |= _explained(frame, effects, seen, noise, real=real)
    return float(explained.mean())


def _explained(
    frame: Explanation, effects: tuple[str, ...], seen: Array, noise: Noise, *, real: bool
) -> Array:
    """Return which columns these effects explain."""
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


def _gaussian_processes(frame: Explanation) -> Array:
    """Draws of Gaussian processes as they would be measured, whitened, in columns."""
    rows = frame.board.rows
    sighting, _ = frame.board.problem.predict(frame.unknowns)
    places = sighting.taped.where
    half = np.maximum(np.ptp(places, axis=0) / 2, 1.0)
    apart = (places[:, np.newaxis] - places[np.newaxis]) / half
    squares = np.sum(apart**2, axis=2)
    source = np.random.default_rng(SEED_OF_DRAWN + 1)
    draws = []
    for width in WIDTHS:
        values, axes = np.linalg.eigh(np.exp(-squares / (2 * width**2)))
        root = axes * np.sqrt(np.maximum(values, 0.0))
        moved = np.einsum("ij,jcd->icd", root, source.standard_normal((len(places), 2, DRAWN)))
        marks = moved[rows.mark_rows].reshape(-1, DRAWN)
        ends = moved[rows.distance_rows]
        along = places[rows.distance_rows]
        along = along[:, 1] - along[:, 0]
        along = along / np.maximum(np.linalg.norm(along, axis=1, keepdims=True), 1e-9)
        spans = np.einsum("mi,mid->md", along, ends[:, 1] - ends[:, 0])
        draws.append(np.vstack([marks, spans]))
    measured = np.hstack(draws) / frame.board.sigma
    priors = np.zeros((len(frame.residual) - rows.count, measured.shape[1]))
    return np.vstack([measured, priors])
