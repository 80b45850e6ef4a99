"""Lengths as people are shown them: in mm, or in inches where they ask for or type those.

Files, JSON and pictures stay in mm. An inch gets a decimal more, so a size stays as fine as it was.
"""

from __future__ import annotations

import math
from collections.abc import Iterator
from contextlib import contextmanager
from contextvars import ContextVar

from plumb.text.lengths import UNITS

_FINER = {"mm": 0, "inch": 1}  # decimals more than in mm
_unit: ContextVar[str] = ContextVar("unit", default="mm")


@contextmanager
def shown_in(name: str) -> Iterator[None]:
    """Lengths are shown in a unit, until the end or until show_in names another."""
    token = _unit.set(name)
    try:
        yield
    finally:
        _unit.reset(token)


def show_in(name: str) -> None:
    """From now on lengths are shown in this unit."""
    _unit.set(name)


def unit() -> str:
    """The unit in which lengths are shown, of UNITS."""
    return _unit.get()


def in_unit(length: float) -> float:
    """A length [mm] in the unit in which lengths are shown."""
    return length / UNITS[unit()]


def bare(length: float | None, digits: int = 2) -> str:
    """A length [mm] without its unit, with this many decimals if it is in mm; a dash for none."""
    if length is None or not math.isfinite(length):
        return "-"
    # No zero has a sign: that of a rounded number is chance.
    return f"{in_unit(length):z.{digits + _FINER[unit()]}f}"


def signed(length: float | None, digits: int = 2) -> str:
    """The same with its sign."""
    if length is None:
        return "-"
    return f"{in_unit(length):+z.{digits + _FINER[unit()]}f}"


def worded(length: float | None, digits: int = 2) -> str:
    """A length [mm] with its unit."""
    return f"{bare(length, digits)} {unit()}"


def brief(length: float) -> str:
    """A length [mm] that somebody chose, with its unit and no more decimals than it needs."""
    return f"{round(in_unit(length), 2):g} {unit()}"
