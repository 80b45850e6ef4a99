"""Slips among readings of the same mark: a reading that disagrees with its repeats.

No model is asked, so nothing that is hidden in the machine can hide such a slip, or look like it.
The worst reading is set aside, then the worst of the rest, and so on; as many are slips as stand
out from what all after them leave. So two slips do not hide each other. Readings of another round
do not count: what changed between rounds is no slip.
"""

from __future__ import annotations

from dataclasses import dataclass, replace

import numpy as np

from plumb.board.observations import Observations
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.noise_sources import STATEMENT, repeats_of
from plumb.diagnosis.readings import REPEATS, Reading, Shift, readings_of, without
from plumb.diagnosis.repeats import repeated_distances, repeated_marks
from plumb.diagnosis.significance import tail
from plumb.diagnosis.spread import Spread
from plumb.fit.inputs import Stated
from plumb.fit.problem import USUAL_SIGMA
from plumb.model.ranks import ranked

Array = np.ndarray
LEVEL = 0.002  # chance at which noise alone makes a slip of one of all repeats
READINGS_PER_SLIP = 6  # with more slips than one in this many repeats, repeats are no help
AGREE = 0.01  # chance from which on readings of two rounds agree
TAPE = 4.0  # degrees of freedom that the usual sigma of a tape is worth where none is stated
KEPT = 1e-6  # share of a slip that a reading must keep to show it


@dataclass(frozen=True)
class RepeatsCleared:
    """The readings that disagree with their repeats, and what is left without them."""

    slips: tuple[Shift, ...]  # their readings counted among all
    rows: Observations
    indices: tuple[Reading, ...]  # of the readings still there, among all


@dataclass(frozen=True)
class _Apart:
    """How far a reading is from its repeats."""

    reading: Reading
    offset: Array  # (2,) or (1,) [mm] from what the others say
    kept: float  # share of a slip that shows
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
    slips, surely = [], 0
    for number in range(1, 1 + max(1, count // READINGS_PER_SLIP)):
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
        slips.append(replace(_shift(worst, sigma), reading=index))
        states.append(RepeatsCleared(tuple(slips), rows, tuple(indices)))
    return states[surely]


def twins_that_agree(rows: Observations, sigma: float) -> frozenset[Reading]:
    """Readings that repeats confirm, of another round too; sigma [mm].

    What stood out among the repeats of a round has been set aside before.
    """
    confirmed = {apart.reading for apart in _all_apart(rows)}
    for apart in _all_apart(rows, in_a_round=False):
        if tail(apart.drop / sigma**2, apart.reading.size, np.inf) > AGREE:
            confirmed.add(apart.reading)
    return frozenset(confirmed)


def _all_apart(rows: Observations, *, in_a_round: bool = True) -> list[_Apart]:
    """Every reading that was repeated, in its round or in any."""
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
    """Of two readings of a mark, that which is farther from the fit of the frame."""
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
    """The noise [mm] by what was said and by the repeats that are left, and its degrees."""
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
