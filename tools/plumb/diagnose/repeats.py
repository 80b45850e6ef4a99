"""The spread of repeated readings, without what moved a whole round against another.

Two rounds of the same marks repeat each other only if nothing changed in between. Where a later
round lies shifted, turned or stretched as a whole, that is no noise of reading: it is taken out.
"""

from __future__ import annotations

from typing import Any

import numpy as np

from plumb.board.observations import Observations
from plumb.diagnose.significance import tail
from plumb.diagnose.spread import Spread

Array = np.ndarray
SURE = 0.0027  # chance at which noise alone would move a round as a whole as much: 3 sigma
STEPS = (1.0, 0.5, 0.25, 0.1)  # [mm] to which people read a tape, coarsest first
FEWEST_LEFT = 2.0  # degrees of freedom that must be left to judge by


def mark_spread(rows: Observations) -> Spread:
    """The spread of marks made and read in the same way."""
    repeated = [repeats for repeats in _alike(rows) if len(repeats) > 1]
    if not repeated:
        return Spread(0.0, 0.0)
    picked = np.concatenate(repeated)
    belongs = np.repeat(np.arange(len(repeated)), [len(repeats) for repeats in repeated])
    means = (belongs[:, np.newaxis] == np.arange(len(repeated))).astype(float)
    # Repeats may be made next to each other: what they share is how far they are off.
    readings = rows.measured[picked] - rows.targets[picked]
    plain = _left(means, readings)
    whole = _round_columns(rows, picked)
    moved = _left(np.hstack([means, whole]), readings)
    if whole.shape[1] and moved.degrees >= FEWEST_LEFT and _is_sure(plain, moved):
        return moved
    return plain


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
    spans: dict[frozenset[int], list[int]] = {}
    for i, ends in enumerate(rows.distance_rows.tolist()):
        spans.setdefault(frozenset(ends), []).append(i)
    squares, degrees = 0.0, 0.0
    for repeats in spans.values():
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
