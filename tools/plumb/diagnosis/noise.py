"""The noise of one measured number."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np
import scipy

from plumb.diagnosis.explanation import (
    KNOWN,
    NOTHING,
    Board,
    Explanation,
    Spread,
    explain,
    span,
    tail,
)
from plumb.fit.inputs import Stated
from plumb.fit.observations import Observations
from plumb.fit.problem import USUAL_SIGMA
from plumb.text.errors import to_do
from plumb.text.values import worded

ORIGINS = {
    "stated": "as stated",
    "repeats": "from repeats",
    "stated and repeats": "as stated, and from repeats",
    "scatter": "from the scatter of the marks",
    "default": "usual for a tape",
    "residuals": "from what the fit leaves",
}


@dataclass(frozen=True)
class Noise:
    """Standard deviation of one coordinate or distance, and how well it is known."""

    sigma: float  # [mm]
    degrees: float  # of freedom; KNOWN if it was not estimated
    source: str  # one of ORIGINS
    notes: tuple[str, ...] = ()
    within: Spread = NOTHING  # of repeats, as far as sigma was made of it

    @property
    def quantile(self) -> float:
        """Half-width of a 95 % interval, in standard deviations."""
        return 1.96 if np.isinf(self.degrees) else float(scipy.special.stdtrit(self.degrees, 0.975))

    @property
    def upper_quantile(self) -> float:
        """Distance of a 95 % upper limit, in standard deviations."""
        return 1.645 if np.isinf(self.degrees) else float(scipy.special.stdtrit(self.degrees, 0.95))

    @property
    def testable(self) -> bool:
        """Whether it comes from elsewhere than the misfit, so that a misfit can be tested."""
        return self.source != "scatter"

    @property
    def origin(self) -> str:
        """Where it comes from, for people."""
        counted = f", {self.degrees:.0f} degrees of freedom" if self.within.degrees else ""
        return ORIGINS[self.source] + counted

    @property
    def sentence(self) -> str:
        """How far a reading may be off, for people."""
        return f"Noise of a reading: {worded(self.sigma)} ({self.origin}). Intervals: 95 %."


# Where the noise of a reading is taken from: the rule for every command.
#
# - `--sigma` is used as it is given. Where repeats contradict it, a note says so.
# - `tape_sigma_mm` of the marks and repeats count together, the statement as much as a spread of
# STATEMENT degrees of freedom. Where the two contradict each other beyond chance, the repeats
# are believed, and a note says so.
# - Without a statement repeats alone count; without repeats the statement alone.
# - With neither a diagnosis takes the usual sigma of a tape, or the scatter about everything that
# the library can draw if that is larger; `plumb add` takes what its fit leaves.

STATEMENT = 10.0  # degrees of freedom that a stated sigma is worth when it meets repeats
FEW_REPEATS = 6  # degrees of freedom below which repeats do not overrule a stated sigma
GOOD_REPEATS = 12  # three marks read three times
FEW_SCATTER = 8  # degrees of freedom below which the scatter tells nothing of the noise
LARGEST_SIGMA = 1.0  # [mm] nobody reads a tape worse: a larger scatter is no noise
SMALLEST_SIGMA = 0.01  # [mm] for repeats that agree to the last digit they were written with
DISAGREE = 0.01  # chance at which two numbers for the noise are said to disagree


def noise_on(board: Board, stated: Stated | None) -> Noise:
    """Return the noise of what was measured on a board."""
    repeats = repeats_of(board.rows)
    known = known_noise(repeats, stated)
    if known is not None:
        return known
    left, spare = beyond_library(explain(board))
    return guessed_noise(Spread(left * board.sigma**2, max(spare, 0.0)))


def repeats_of(rows: Observations) -> Spread:
    """Return the spread of readings of the same mark or distance, taken in the same way."""
    spread = mark_spread(rows) + distance_spread(rows)
    least = rounding_sigma(rows) ** 2 * spread.degrees if spread.degrees else 0.0
    return Spread(max(spread.squares, least), spread.degrees)


def known_noise(repeats: Spread, stated: Stated | None) -> Noise | None:
    """Return what statements and repeats say of the noise; None if there are neither."""
    if stated is not None and (stated.is_final or repeats.degrees < 1):
        return Noise(stated.sigma, KNOWN, "stated", _contradiction(repeats, stated))
    if stated is not None:
        return _together(repeats, stated)
    return _from_repeats(repeats) if repeats.degrees >= 2 else None


def guessed_noise(scatter: Spread) -> Noise:
    """Return the noise where nothing was stated or repeated.

    What is beyond LARGEST_SIGMA is not believed to be noise.
    """
    large = scatter.degrees >= FEW_SCATTER and _exceeds(scatter, USUAL_SIGMA)
    if large and scatter.sigma <= LARGEST_SIGMA:
        return Noise(scatter.sigma, scatter.degrees, "scatter", (_SCATTER, _ask()))
    return Noise(LARGEST_SIGMA if large else USUAL_SIGMA, KNOWN, "default", (_ask(),))


def _together(repeats: Spread, stated: Stated) -> Noise:
    """Return a statement that may be wrong, and repeats that are few."""
    notes = _contradiction(repeats, stated)
    if notes and repeats.degrees >= FEW_REPEATS:
        return _from_repeats(repeats, notes)
    pooled = repeats + Spread(STATEMENT * stated.sigma**2, STATEMENT)
    return Noise(pooled.sigma, pooled.degrees, "stated and repeats", notes, repeats)


def _from_repeats(repeats: Spread, notes: tuple[str, ...] = ()) -> Noise:
    if repeats.degrees < GOOD_REPEATS:
        notes += (
            f"the noise rests on {repeats.degrees:.0f} spare numbers, so only large effects can "
            "be proved; read three marks three times for sharper answers",
        )
    sigma = max(repeats.sigma, SMALLEST_SIGMA)
    within = Spread(sigma**2 * repeats.degrees, repeats.degrees)
    return Noise(sigma, float(repeats.degrees), "repeats", notes, within)


def _contradiction(repeats: Spread, stated: Stated) -> tuple[str, ...]:
    """Return a sentence if repeats and a statement differ by more than chance."""
    more = repeats.degrees > 0 and _exceeds(repeats, stated.sigma)
    less = repeats.degrees > 0 and _falls_below(repeats, stated.sigma)
    if not (more or less):
        return ()
    if stated.is_final:
        used = to_do(
            f"the {stated.sigma:g} mm of --sigma are used; leave it out to use the repeats",
            page=f"the stated {stated.sigma:g} mm are used",
        )
    elif repeats.degrees >= FEW_REPEATS:
        used = "the repeats are believed"
    else:
        used = "both are used, for the repeats are few; read three marks three times"
    than = "more" if more else "less"
    return (
        f"repeats differ by {worded(repeats.sigma)}, {than} than the stated "
        f"{worded(stated.sigma)}, and chance alone hardly does that: {used}",
    )


def _exceeds(spread: Spread, sigma: float) -> bool:
    """Return whether readings of this sigma hardly ever spread as much."""
    return bool(scipy.special.chdtrc(spread.degrees, spread.squares / sigma**2) < DISAGREE)


def _falls_below(spread: Spread, sigma: float) -> bool:
    """Return whether readings of this sigma hardly ever spread as little."""
    return bool(scipy.special.chdtr(spread.degrees, spread.squares / sigma**2) < DISAGREE)


def _ask() -> str:
    return (
        "no reading error is stated and no mark was read twice: a tape's usual error is taken, and "
        "what hangs on it may be wrong; read three marks three times, or "
        + to_do("give --sigma", page="choose the finest lines of your tape under Readings")
    )


_SCATTER = (
    "the marks scatter more than a tape usually does about everything the library can draw: that "
    "scatter is taken for noise, and an unknown effect would hide in it"
)


# The spread of repeated readings, without what moved a whole round against another.
#
# Two rounds of the same marks repeat each other only if nothing changed in between. Where a later
# round lies shifted, turned or stretched as a whole, that is no noise of reading: it is taken out.

Array = np.ndarray
THREE_SIGMA = 0.0027  # chance at which noise alone would move a round as a whole as much: 3 sigma
STEPS = (1.0, 0.5, 0.25, 0.1)  # [mm] to which people read a tape, coarsest first
FEWEST_LEFT = 2.0  # degrees of freedom that must be left to judge by


@dataclass(frozen=True)
class Repeats:
    """Marks that were read more than once, and what their readings have in common."""

    picked: Array  # (n,) readings, by their indices among the marks
    off: Array  # (n, 2) [mm] of each from its target
    columns: Array  # (n, c) a mean for each mark, and what moved whole rounds
    groups: tuple[tuple[int, ...], ...]  # readings of the same mark, made in the same way

    @property
    def spread(self) -> Spread:
        """What the columns leave of both coordinates."""
        return _left(self.columns, self.off)

    def apart(self) -> tuple[Array, Array]:
        """Return what is left of each reading (n, 2) [mm], and its share (n,) of an outlier."""
        basis, sizes, _ = np.linalg.svd(self.columns, full_matrices=False)
        basis = basis[:, sizes > 1e-9 * sizes[0]]
        return self.off - basis @ (basis.T @ self.off), 1 - np.sum(basis**2, axis=1)


def mark_spread(rows: Observations) -> Spread:
    """Return the spread of marks made and read in the same way."""
    repeats = repeated_marks(rows)
    return repeats.spread if repeats else NOTHING


def repeated_marks(rows: Observations, *, in_a_round: bool = False) -> Repeats | None:
    """Return the marks that were read more than once, or more than once in a round, or None."""
    alike = _alike(rows)
    if in_a_round:
        alike = [part for repeats in alike for part in _by_round(rows, repeats)]
    repeated = [repeats for repeats in alike if len(repeats) > 1]
    if not repeated:
        return None
    picked = np.concatenate(repeated)
    belongs = np.repeat(np.arange(len(repeated)), [len(repeats) for repeats in repeated])
    means = (belongs[:, np.newaxis] == np.arange(len(repeated))).astype(float)
    # Repeats may be made next to each other: what they share is how far they are off.
    readings = rows.measured[picked] - rows.targets[picked]
    plain = _left(means, readings)
    whole = _round_columns(rows, picked)
    moved = _left(np.hstack([means, whole]), readings)
    are_moved = whole.shape[1] and moved.degrees >= FEWEST_LEFT and _is_sure(plain, moved)
    columns = np.hstack([means, whole]) if are_moved else means
    return Repeats(picked, readings, columns, tuple(tuple(repeats) for repeats in repeated))


def _by_round(rows: Observations, repeats: list[int]) -> list[list[int]]:
    """Return these readings, those of a round together."""
    rounds = rows.rounds[rows.mark_rows[repeats]].tolist()
    return [
        [index for index, number in zip(repeats, rounds, strict=True) if number == each]
        for each in sorted(set(rounds))
    ]


def repeated_distances(rows: Observations, *, in_a_round: bool = False) -> list[list[int]]:
    """Return indices of distances between the same two marks, where there are several."""
    spans: dict[tuple[frozenset[int], int], list[int]] = {}
    rounds = rows.distance_rounds if in_a_round else np.zeros(len(rows.distances), dtype=int)
    for i, ends in enumerate(rows.distance_rows.tolist()):
        spans.setdefault((frozenset(ends), int(rounds[i])), []).append(i)
    return [repeats for repeats in spans.values() if len(repeats) > 1]


def _alike(rows: Observations) -> list[list[int]]:
    """Return marks of a name made by the same chains, or close by in the same round."""
    made: dict[tuple[Any, ...], dict[tuple[float, ...], list[int]]] = {}
    for i, row in enumerate(rows.mark_rows):
        side = (*rows.approaches[row], rows.swapped[row])
        way = (rows.names[i], rows.sled_weights[row], *side)
        made.setdefault(way, {}).setdefault(tuple(rows.chains[row]), []).append(i)
    alike = []
    for by_chains in made.values():
        groups: list[list[int]] = []
        for repeats in by_chains.values():
            rounds = set(rows.rounds[rows.mark_rows[repeats]].tolist())
            joined = [
                group
                for group in groups
                if rounds & set(rows.rounds[rows.mark_rows[group]].tolist())
            ]
            groups = [group for group in groups if group not in joined]
            groups.append([*(i for group in joined for i in group), *repeats])
        alike += groups
    return alike


def distance_spread(rows: Observations) -> Spread:
    """Return the same of distances between the same two marks."""
    squares, degrees = 0.0, 0.0
    for repeats in repeated_distances(rows):
        squares += float(np.sum((rows.distances[repeats] - rows.distances[repeats].mean()) ** 2))
        degrees += len(repeats) - 1
    return Spread(squares, degrees)


def rounding_sigma(rows: Observations) -> float:
    """Return standard deviation [mm] of rounding to the step in which all numbers were written.

    Readings to whole millimetres that agree exactly say no more than that.
    """
    whole = [rows.measured - rows.measured[:1]] if len(rows.measured) else []
    whole += [rows.distances - rows.distances[:1]] if len(rows.distances) else []
    numbers = np.concatenate([part.ravel() for part in whole])
    for step in STEPS:
        if np.allclose(numbers, step * np.round(numbers / step), atol=1e-6, rtol=0):
            return float(step / np.sqrt(12))
    return 0.0


def _round_columns(rows: Observations, picked: Array) -> Array:
    """Columns that move each later round as a whole: 1, x and y of the target (metres)."""
    number = rows.rounds[rows.mark_rows[picked]]
    linear = np.column_stack([np.ones(len(picked)), rows.targets[picked] / 1000])
    later = sorted(set(number.tolist()))[1:]
    if not later:
        return np.zeros((len(picked), 0))
    return np.hstack([linear * (number == later_round)[:, np.newaxis] for later_round in later])


def _left(columns: Array, readings: Array) -> Spread:
    """Return what columns leave of both coordinates, and its degrees of freedom."""
    fitted, _, rank, _ = np.linalg.lstsq(columns, readings, rcond=1e-9)
    squares = float(np.sum((readings - columns @ fitted) ** 2))
    return Spread(squares, 2.0 * (len(readings) - rank))


def _is_sure(plain: Spread, moved: Spread) -> bool:
    """Return whether rounds moved as a whole, by the F-test."""
    more = plain.degrees - moved.degrees
    if more <= 0 or moved.squares <= 0:
        return more > 0 and plain.squares > 0
    gain = (plain.squares - moved.squares) / moved.sigma**2
    return bool(tail(gain, more, moved.degrees) < THREE_SIGMA)


# Lack of fit: whether an explanation leaves more of the measured numbers than noise would.

LEVEL = 0.015  # chance at which noise alone is called a misfit


def misfit_chance(explanation: Explanation, noise: Noise) -> float:
    """Chance that noise alone leaves as much as this explanation does; 1 if nothing can tell.

    Chi-square for a known sigma. With repeats in sigma, F of what is left between places over
    sigma, and what is left within repeats does not count: sigma was made of it.
    """
    left, spare = _left_over(explanation, explanation.basis, explanation.residual)
    return _chance(explanation, left, spare, noise)


def spare_numbers(explanation: Explanation) -> float:
    """Return how many measured numbers the fit left over."""
    return _left_over(explanation, explanation.basis, explanation.residual)[1]


def library_misfit_chance(explanation: Explanation, noise: Noise) -> float:
    """Return the same beyond everything that all effects of the library could draw at once."""
    return _chance(explanation, *beyond_library(explanation), noise)


def beyond_library(explanation: Explanation) -> tuple[float, float]:
    """Chi-square that no combination of effects takes away, and its degrees of freedom."""
    basis = library_basis(explanation)
    rest = explanation.residual - basis @ (basis.T @ explanation.residual)
    return _left_over(explanation, basis, rest)


def library_basis(explanation: Explanation) -> Array:
    """Orthonormal columns of what was fitted and of every effect of the library."""
    raw = explanation.slopes[:, explanation.board.columns(explanation.board.effect_columns)]
    fitted = explanation.basis
    return np.hstack([fitted, span(raw - fitted @ (fitted.T @ raw), against=raw)])


def _left_over(explanation: Explanation, basis: Array, residual: Array) -> tuple[float, float]:
    """Chi-square of the measured numbers alone, and the numbers less those that the fit took.

    The rows of the priors do not count: how near the frame is to what was stated says nothing of
    how well the marks are explained.
    """
    count = explanation.board.rows.count
    return float(residual[:count] @ residual[:count]), count - float(np.sum(basis[:count] ** 2))


def _chance(explanation: Explanation, left: float, spare: float, noise: Noise) -> float:
    within = noise.within
    spare, left = spare - within.degrees, left - within.squares / explanation.board.sigma**2
    if spare < 0.5 or not noise.testable:
        return 1.0
    return float(tail(left, spare, noise.degrees))
