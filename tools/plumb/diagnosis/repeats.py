"""The spread of repeated readings, without what moved a whole round against another.

Two rounds of the same marks repeat each other only if nothing changed in between. Where a later
round lies shifted, turned or stretched as a whole, that is no noise of reading: it is taken out.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Any

import numpy as np

from plumb.board.observations import Observations
from plumb.diagnosis.significance import tail
from plumb.diagnosis.spread import NOTHING, Spread

Array = np.ndarray
SURE = 0.0027  # chance at which noise alone would move a round as a whole as much: 3 sigma
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
        """What is left of each reading (n, 2) [mm], and the share (n,) that it keeps of a slip."""
        basis, sizes, _ = np.linalg.svd(self.columns, full_matrices=False)
        basis = basis[:, sizes > 1e-9 * sizes[0]]
        return self.off - basis @ (basis.T @ self.off), 1 - np.sum(basis**2, axis=1)


def mark_spread(rows: Observations) -> Spread:
    """The spread of marks made and read in the same way."""
    repeats = repeated_marks(rows)
    return repeats.spread if repeats else NOTHING


def repeated_marks(rows: Observations, *, in_a_round: bool = False) -> Repeats | None:
    """The marks that were read more than once, or more than once in a round; None without any."""
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
    """These readings, those of a round together."""
    rounds = rows.rounds[rows.mark_rows[repeats]].tolist()
    return [
        [index for index, number in zip(repeats, rounds, strict=True) if number == each]
        for each in sorted(set(rounds))
    ]


def repeated_distances(rows: Observations, *, in_a_round: bool = False) -> list[list[int]]:
    """Indices of distances between the same two marks, where there are several (in a round)."""
    spans: dict[tuple[frozenset[int], int], list[int]] = {}
    rounds = rows.distance_rounds if in_a_round else np.zeros(len(rows.distances), dtype=int)
    for i, ends in enumerate(rows.distance_rows.tolist()):
        spans.setdefault((frozenset(ends), int(rounds[i])), []).append(i)
    return [repeats for repeats in spans.values() if len(repeats) > 1]


def _alike(rows: Observations) -> list[list[int]]:
    """Marks of a name that were made alike: by the same chains, or close by in the same round."""
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
    """The same of distances between the same two marks."""
    squares, degrees = 0.0, 0.0
    for repeats in repeated_distances(rows):
        squares += float(np.sum((rows.distances[repeats] - rows.distances[repeats].mean()) ** 2))
        degrees += len(repeats) - 1
    return Spread(squares, degrees)


def rounding_sigma(rows: Observations) -> float:
    """Standard deviation [mm] of rounding to the step in which all numbers were written.

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
    """What columns leave of both coordinates, and its degrees of freedom."""
    fitted, _, rank, _ = np.linalg.lstsq(columns, readings, rcond=1e-9)
    squares = float(np.sum((readings - columns @ fitted) ** 2))
    return Spread(squares, 2.0 * (len(readings) - rank))


def _is_sure(plain: Spread, moved: Spread) -> bool:
    """Whether rounds moved as a whole, by the F-test."""
    more = plain.degrees - moved.degrees
    if more <= 0 or moved.squares <= 0:
        return more > 0 and plain.squares > 0
    gain = (plain.squares - moved.squares) / moved.sigma**2
    return bool(tail(gain, more, moved.degrees) < SURE)
