"""Rates over many boards, with how far they may be off, next to the lines to be reached."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass

import numpy as np

from plumb.bench.outcome import NAMED, Outcome

SURE = 1.96  # standard deviations by which a rate must miss its line to be called missed


@dataclass(frozen=True)
class Rate:
    """A mean over boards."""

    name: str
    value: float
    error: float  # standard deviation of it, as another draw of boards would show
    count: int


@dataclass(frozen=True)
class Line:
    """What a rate should reach."""

    name: str  # of the rate
    least: float | None = None
    most: float | None = None

    def judge(self, rate: Rate) -> str:
        """`reached`, `missed`, or `open` where this many boards cannot tell."""
        low = -np.inf if self.least is None else self.least
        high = np.inf if self.most is None else self.most
        if low <= rate.value <= high:
            return "reached"
        apart = low - rate.value if rate.value < low else rate.value - high
        return "missed" if apart > SURE * rate.error else "open"

    @property
    def words(self) -> str:
        """The line for people."""
        if self.least is not None and self.most is not None:
            return f"{self.least:g} .. {self.most:g}"
        return f">= {self.least:g}" if self.least is not None else f"<= {self.most:g}"


Counted = Callable[[Outcome], "tuple[float, float]"]  # of a board: how much, of how much


def _share(of: Callable[[Outcome], bool]) -> Counted:
    return lambda outcome: (float(of(outcome)), 1.0)


def _among(of: Callable[[Outcome], bool], good: Callable[[Outcome], bool]) -> Counted:
    return lambda outcome: (float(of(outcome) and good(outcome)), float(of(outcome)))


def _has_small_slip(outcome: Outcome) -> bool:
    return outcome.small_slip


def _has_large_slip(outcome: Outcome) -> bool:
    return not outcome.small_slip


MEASURES: Mapping[str, Counted] = {
    "false naming": _share(lambda outcome: outcome.verdict in NAMED),
    "silent": _share(lambda outcome: outcome.verdict == "nothing_provable"),
    "named": _share(lambda outcome: outcome.verdict in NAMED),
    "right class first": _share(lambda outcome: outcome.right_first),
    "suspects": lambda outcome: (float(len(outcome.suspects)), float(bool(outcome.suspects))),
    "truth inside": _share(lambda outcome: outcome.inside),
    "truth covered": _share(lambda outcome: outcome.covered),
    "not in library": _share(lambda outcome: outcome.verdict == "not_in_library"),
    "invented": _share(lambda outcome: outcome.invented),
    "both": _share(lambda outcome: outcome.both),
    "flagged": _share(lambda outcome: outcome.verdict in ("not_in_library", "slip")),
    "slip named": _share(lambda outcome: outcome.slip_named),
    "large slip named": _among(_has_large_slip, lambda outcome: outcome.slip_named),
    "small slip named": _among(_has_small_slip, lambda outcome: outcome.slip_named),
    "false slip": _share(lambda outcome: outcome.false_slip),
    "effect named first": _share(lambda outcome: outcome.verdict in NAMED),
    "interval holds": lambda outcome: (float(outcome.intervals[0]), float(outcome.intervals[1])),
    "limit holds": lambda outcome: (float(outcome.limits[0]), float(outcome.limits[1])),
}


def rate_of(name: str, outcomes: Sequence[Outcome]) -> Rate:
    """One rate over boards; a share that was 0 or 1 throughout is given the error of one board."""
    counted = np.array([MEASURES[name](outcome) for outcome in outcomes], dtype=float).reshape(
        -1, 2
    )
    of = counted[:, 1].sum()
    if not of:
        return Rate(name, float("nan"), float("nan"), 0)
    value = counted[:, 0].sum() / of
    # Of a ratio of sums, since boards differ in how much they count.
    apart = counted[:, 0] - value * counted[:, 1]
    error = float(np.sqrt(np.sum(apart**2))) / of
    return Rate(name, float(value), max(error, 1 / of if name != "suspects" else 0.0), int(of))
