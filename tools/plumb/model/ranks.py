"""The order of computed numbers, the same on every processor.

Rounding differs between processors. So numbers that are equal but for rounding tie, and what ties
keeps the order in which it came: give it in an order that means something.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable
from typing import TypeVar

import numpy as np
from numpy.typing import ArrayLike, NDArray

Item = TypeVar("Item")
# Of chi-squares, logarithms, mm or shares: above the rounding of a fit, and nothing to anybody.
TIE = 1e-7  # as a difference, and as a share of numbers above 1


def ranked(items: Iterable[Item], key: Callable[[Item], float]) -> list[Item]:
    """The items, that with the least number first."""
    each = list(items)
    return [each[i] for i in ascending([key(item) for item in each])]


def ascending(numbers: ArrayLike) -> NDArray[np.int_]:
    """The places of the numbers, the least first."""
    flat = np.asarray(numbers, dtype=float).ravel()
    order = np.argsort(flat, kind="stable")
    low, high = flat[order][:-1], flat[order][1:]
    with np.errstate(invalid="ignore"):  # infinite numbers tie
        apart = high - low > TIE * np.maximum(1.0, np.minimum(np.abs(low), np.abs(high)))
    if apart.all():
        return order
    ties = np.zeros(len(flat), dtype=int)
    np.cumsum(apart, out=ties[1:])
    return order[np.lexsort((order, ties))]


def least(numbers: ArrayLike) -> int:
    """The place of the least number, counted through the rows of a table."""
    return int(ascending(numbers)[0])


def greatest(numbers: ArrayLike) -> int:
    """The place of the greatest number, counted likewise."""
    return least(-np.asarray(numbers, dtype=float))
