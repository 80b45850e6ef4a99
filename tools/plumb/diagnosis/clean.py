"""The readings that can be trusted: mix-ups put right, outliers set aside, the noise known."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.diagnosis.explanation import Board, Explanation, Spread, explain, tail
from plumb.diagnosis.noise import LEVEL as MISFIT_LEVEL
from plumb.diagnosis.noise import (
    STATEMENT,
    Noise,
    misfit_chance,
    noise_on,
    repeated_distances,
    repeated_marks,
    repeats_of,
)
from plumb.diagnosis.outliers import (
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
from plumb.diagnosis.weighing import weigh
from plumb.fit.inputs import Inputs, Stated
from plumb.fit.observations import Observations
from plumb.fit.problem import USUAL_SIGMA
from plumb.model.catalogue import effect_names
from plumb.model.plain import greatest, ranked


@dataclass(frozen=True)
class CleanReadings:
    """What is left without outliers, and how the frame and each effect by itself explain it."""

    outliers: tuple[Outlier, ...]  # readings to look at again
    noise: Noise
    frame: Explanation
    felt: tuple[str, ...]  # effects that change any of the measured numbers
    singles: Mapping[str, Explanation]  # by effect, those that nothing feels too


def clean_readings(board: Board, inputs: Inputs) -> CleanReadings:
    """Look for mixed-up readings and outliers before any effect is suspected."""
    felt = felt_effects(explain(board))
    mixed_up = find_mixed_up(board)
    cleared = clear_outliers(mixed_up.board, felt, stated=inputs.stated)
    frame = cleared.frame
    singles = {single.effects[0]: single for single in cleared.singles}
    for name in effect_names():
        # What the marks do not feel needs no search, but is listed too.
        if name not in singles:
            singles[name] = explain(frame.board, (name,), start=frame)
    measurements = inputs.measurements
    outliers = (
        *mixed_up_outliers(mixed_up, measurements),
        *(described(shift, measurements, inputs.settings.sheet) for shift in cleared.outliers),
    )
    return CleanReadings(outliers, cleared.noise, frame, felt, singles)


def felt_effects(frame: Explanation) -> tuple[str, ...]:
    """Effects that change any of the measured numbers."""
    board = frame.board
    return tuple(name for name in effect_names() if np.any(frame.slopes[:, board.columns([name])]))


# Outliers: single readings that disagree with every explanation, looked for before any effect.
#
# A reading is named where the marks make it far more likely that this reading is off than that all
# readings are right: whatever effects act, up to all of them, and whatever Gaussian process does.
# So two hidden effects hide no outlier, and a bump, which moves several marks alike, is none.

Array = np.ndarray
SURE = 0.7  # how likely an outlier must be to be named; without one it is hardly ever above 0.1
SAME = 0.01  # share of sigma by which a change of it is no matter
MANY = 15  # readings of which no single effect explains one that is off
FEWEST = 4  # readings below which none can be distinguished from the others
SHARE_OF_OUTLIERS = 12  # with more than one in this many readings outliers are not the story


@dataclass(frozen=True)
class Cleared:
    """The readings to look at again, and what is left without them."""

    outliers: tuple[Shift, ...]  # their readings counted among all
    rows: Observations
    noise: Noise
    frame: Explanation  # of what is left
    singles: tuple[Explanation, ...]  # the same with each candidate


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


def clear_outliers(board: Board, candidates: Sequence[str], *, stated: Stated | None) -> Cleared:
    """Set outliers aside one after the other, worst first; before all else those that disagree with
    their repeats."""
    repeats = clear_repeats(board, stated)
    board = _with_noise(board, repeats.rows, stated)
    whole, indices = board, list(repeats.indices)
    most = max(1, len(indices) // SHARE_OF_OUTLIERS)
    outliers: list[Shift] = []
    while len(outliers) <= most:
        reading = _outlier_of(board, candidates, stated)
        if reading is None:
            break
        rest = _with_noise(board, without(board.rows, reading), stated)
        shift = _shift_of(board, rest, reading, candidates, stated)
        outliers.append(replace(shift, reading=indices.pop(reading.place(board.rows))))
        board = rest
    if len(outliers) > most:
        outliers, board = [], whole
    frame = explain(board)
    singles = tuple(explain(board, (name,), start=frame) for name in candidates)
    noise = noise_on(board, stated)
    return Cleared((*repeats.outliers, *outliers), board.rows, noise, frame, singles)


def _with_noise(board: Board, rows: Observations, stated: Stated | None) -> Board:
    """Return the board with these rows, whitened by their noise."""
    noise = noise_on(board.with_rows(rows), stated)
    return board.with_rows(rows, sigma=noise.sigma)


def _outlier_of(board: Board, candidates: Sequence[str], stated: Stated | None) -> Reading | None:
    """Return the reading that is surely off; None if there is none.

    The noise is that of all others: an outlier must not hide in what it makes of the noise.
    """
    readings = readings_of(board.rows)
    # A reading that its repeats confirm is no outlier, whatever explanations say of it.
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
    """Return whether a single effect, refitted in full, explains all of many readings.

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
    """Return how likely each reading is off."""
    noise = noise_on(board, stated)
    return weigh(explain(board), candidates, replace(noise, sigma=board.sigma)).outlier_chances(
        allowed
    )


def _shift_of(
    board: Board,
    rest: Board,
    reading: Reading,
    candidates: Sequence[str],
    stated: Stated | None,
) -> Shift:
    """Return how far a reading is off by the likeliest account of all others."""
    effects = weigh(explain(rest), candidates, noise_on(rest, stated), with_outliers=False).best
    by_rest = explain(board.with_rows(board.rows, sigma=rest.sigma), effects)
    return shifts(by_rest)[reading.place(board.rows)]


# Outliers among readings of the same mark: a reading that disagrees with its repeats.
#
# No model is asked, so nothing that is hidden in the machine can hide such an outlier, or look like
# it. The worst reading is set aside, then the worst of the rest, and so on; as many are outliers as
# stand out from what all after them leave. So two outliers do not hide each other. Readings of
# another round do not count: what changed between rounds is no outlier.

LEVEL = 0.002  # chance at which noise alone makes an outlier of one of all repeats
READINGS_PER_OUTLIER = 6  # with more outliers than one in this many repeats, repeats are no help
AGREE = 0.01  # chance from which on readings of two rounds agree
TAPE = 4.0  # degrees of freedom that the usual sigma of a tape is worth where none is stated
KEPT = 1e-6  # share of an outlier that a reading must keep to show it


@dataclass(frozen=True)
class RepeatsCleared:
    """The readings that disagree with their repeats, and what is left without them."""

    outliers: tuple[Shift, ...]  # their readings counted among all
    rows: Observations
    indices: tuple[Reading, ...]  # of the readings still there, among all


@dataclass(frozen=True)
class _Apart:
    """How far a reading is from its repeats."""

    reading: Reading
    offset: Array  # (2,) or (1,) [mm] from what the others say
    kept: float  # share of an outlier that shows
    twins: tuple[int, ...]  # all readings of this mark or distance, by their indices

    @property
    def drop(self) -> float:
        """Of the sum of squares [mm^2] when the reading is set aside."""
        return float(self.offset @ self.offset) * self.kept


def clear_repeats(board: Board, stated: Stated | None) -> RepeatsCleared:
    """Set aside the readings that disagree with their repeats."""
    rows, indices = board.rows, readings_of(board.rows)
    states = [RepeatsCleared((), rows, tuple(indices))]
    count = len(_all_apart(rows))
    outliers, surely = [], 0
    for number in range(1, 1 + max(1, count // READINGS_PER_OUTLIER)):
        apart = _all_apart(rows)
        if not apart:
            break
        worst = ranked(apart, lambda other: -other.drop)[0]
        if len(worst.twins) == 2:
            worst = _worse_of_two(board.with_rows(rows), worst, apart)
        rows = without(rows, worst.reading)
        sigma, degrees = _sigma(rows, stated)
        if tail(worst.drop / sigma**2, worst.reading.size, degrees) * count < LEVEL:
            surely = number
        index = indices.pop(worst.reading.place(states[-1].rows))
        outliers.append(replace(_shift(worst, sigma), reading=index))
        states.append(RepeatsCleared(tuple(outliers), rows, tuple(indices)))
    return states[surely]


def twins_that_agree(rows: Observations, sigma: float) -> frozenset[Reading]:
    """Return readings that repeats confirm, of another round too; sigma [mm].

    What stood out among the repeats of a round has been set aside before.
    """
    confirmed = {apart.reading for apart in _all_apart(rows)}
    for apart in _all_apart(rows, in_a_round=False):
        if tail(apart.drop / sigma**2, apart.reading.size, np.inf) > AGREE:
            confirmed.add(apart.reading)
    return frozenset(confirmed)


def _all_apart(rows: Observations, *, in_a_round: bool = True) -> list[_Apart]:
    """Return every reading that was repeated, in its round or in any."""
    readings: list[_Apart] = []
    repeats = repeated_marks(rows, in_a_round=in_a_round)
    if repeats:
        left, kept = repeats.apart()
        groups = {index: group for group in repeats.groups for index in group}
        readings += [
            _Apart(Reading(index, True), left[i] / kept[i], float(kept[i]), groups[index])
            for i, index in enumerate(repeats.picked.tolist())
            if kept[i] > KEPT
        ]
    for group in repeated_distances(rows, in_a_round=in_a_round):
        lengths, share = rows.distances[group], 1 - 1 / len(group)
        readings += [
            _Apart(Reading(index, False), (lengths[[i]] - lengths.mean()) / share, share, (*group,))
            for i, index in enumerate(group)
        ]
    return readings


def _worse_of_two(board: Board, worst: _Apart, apart: list[_Apart]) -> _Apart:
    """Return that of two readings of a mark which is farther from the fit of the frame."""
    frame = explain(board)

    def error(reading: Reading) -> float:
        return float(np.linalg.norm(frame.residual[reading.numbers(board.rows)]))

    both = [
        other
        for other in apart
        if other.reading.is_mark == worst.reading.is_mark and other.reading.index in worst.twins
    ]
    return ranked(both, lambda other: -error(other.reading))[0]


def _sigma(rows: Observations, stated: Stated | None) -> tuple[float, float]:
    """Return the noise [mm] by what was said and by the repeats that are left, and its degrees."""
    said = (
        Spread(STATEMENT * stated.sigma**2, STATEMENT)
        if stated
        else Spread(TAPE * USUAL_SIGMA**2, TAPE)
    )
    pooled = repeats_of(rows) + said
    return pooled.sigma, pooled.degrees


def _shift(apart: _Apart, sigma: float) -> Shift:
    return Shift(
        reading=apart.reading,
        offset=apart.offset,
        sigma=np.full(apart.reading.size, sigma / np.sqrt(apart.kept)),
        drop=apart.drop / sigma**2,
        against=REPEATS,
        is_one_of_two=len(apart.twins) == 2,
    )
