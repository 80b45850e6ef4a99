"""Rates of the gates, counted from records: each is a ratio of sums over boards.

An effect that was hidden is provable where it lowers chi-square by 9 and 2 for each parameter,
beyond the frame and all else that acts. Look-alikes of what is there count as it.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass
from itertools import pairwise
from typing import Any

import numpy as np
from gate_records import Record
from plumb.model.catalogue import EVERY_MACHINE

Array = np.ndarray
NAMED = ("one_suspect", "cannot_tell")
LARGE_SLIP = 10.0  # [mm]
Counted = Callable[[Record], "tuple[float, float]"]  # of a board: how much, of how much


def is_plain(record: Record) -> bool:
    """Return whether a board has neither a field nor a slip."""
    return not record.outside and not record.slipped


def listed(record: Record) -> list[set[str]]:
    """Return the effects of each explanation; nothing is an explanation where none is provable."""
    accounts = [set(account.effects) for account in record.accounts]
    return accounts or [set()] * (record.verdict == "nothing_provable")


def holds(record: Record, effects: set[str]) -> bool:
    """Return whether effects have all that is provable, or look-alikes of it."""
    return all(effects & {name, *record.alike[name]} for name in record.provable)


def is_exact(record: Record, effects: set[str]) -> bool:
    """Return whether they have that and nothing that is not there."""
    return holds(record, effects) and effects <= set(record.allowed)


def _best(record: Record) -> tuple[float, float]:
    accounts = listed(record)[:1]
    of = is_plain(record) and bool(record.provable)
    return float(of and any(holds(record, each) for each in accounts)), float(of)


def _exact(record: Record) -> tuple[float, float]:
    accounts = listed(record)[:1]
    of = is_plain(record) and bool(record.provable)
    return float(of and any(is_exact(record, each) for each in accounts)), float(of)


def _inside(record: Record) -> tuple[float, float]:
    """Where nothing is provable, an explanation must name nothing that is not there."""
    right = holds if record.provable else is_exact
    of = is_plain(record) and bool(record.effects)
    return float(of and any(right(record, each) for each in listed(record))), float(of)


def _first(record: Record) -> tuple[float, float]:
    """Of the causes in their order, but for what every machine has."""
    of = is_plain(record) and bool(record.provable)
    hidden = {*record.effects, *(name for each in record.effects for name in record.alike[each])}
    names = (name for account in record.accounts for name in account.effects)
    unusual = (name for name in names if name in hidden or name not in record.allowed)
    return float(of and next(unusual, "") in hidden), float(of)


def _invented(record: Record) -> tuple[float, float]:
    of, accounts = is_plain(record), listed(record)
    named = record.verdict in NAMED and bool(accounts)
    return float(of and named and not accounts[0] <= set(record.allowed)), float(of)


def _needless(record: Record) -> tuple[float, float]:
    of, accounts = is_plain(record), listed(record)
    return float(len(accounts[0] - set(record.allowed)) if of and accounts else 0), float(of)


def _named(record: Record) -> tuple[float, float]:
    of = is_plain(record) and bool(record.provable)
    return float(of and record.verdict in NAMED), float(of)


def _strange(record: Record) -> tuple[float, float]:
    of = is_plain(record)
    return float(of and record.verdict in ("not_in_library", "slip", "failed")), float(of)


def _verdict(*verdicts: str) -> Counted:
    """Return a count of fields that were called so."""
    return lambda record: (
        float(bool(record.outside) and not record.slipped and record.verdict in verdicts),
        float(bool(record.outside) and not record.slipped),
    )


def _slip_named(least: float, most: float) -> Counted:
    """Return a count of slips of some lengths [mm]: just the readings that slipped are named."""

    def counted(record: Record) -> tuple[float, float]:
        of = bool(record.slipped) and not record.outside and least <= record.slip_mm < most
        return float(of and set(record.outliers) == set(record.slipped)), float(of)

    return counted


def _false_slip(record: Record) -> tuple[float, float]:
    return float(bool(set(record.outliers) - set(record.slipped))), 1.0


def _sets(record: Record) -> tuple[float, float]:
    of = is_plain(record) and bool(record.accounts)
    return float(len(record.accounts) if of else 0), float(of)


def _causes(record: Record) -> tuple[float, float]:
    of = is_plain(record) and bool(record.accounts)
    names = {name for account in record.accounts for name in account.effects}
    return float(len(names) if of else 0), float(of)


def _intervals(record: Record) -> tuple[float, float]:
    """Of the first explanation that is just what was hidden, but for what is usual."""
    if not is_plain(record):
        return 0.0, 0.0
    for account in record.accounts:
        if set(account.effects) - set(record.usual) == set(record.effects) - set(record.usual):
            inside = [low <= truth <= high for _, truth, low, high in account.sizes]
            return float(sum(inside)), float(len(inside))
    return 0.0, 0.0


def _limits(record: Record) -> tuple[float, float]:
    of = is_plain(record) and record.verdict not in ("not_in_library", "slip")
    return float(sum(record.limits.values()) if of else 0), float(len(record.limits) if of else 0)


def _cure(after: str) -> Counted:
    return lambda record: (
        record.cure.get(after, 0.0),
        record.cure["known"] if after in record.cure else 0.0,
    )


@dataclass(frozen=True)
class Measure:
    """A rate, and whether more of it is better."""

    name: str
    counted: Counted
    better: int  # 1: more, -1: less, 0: neither
    is_share: bool = True  # shown in percent


_LONG = float("inf")
MEASURES = {
    measure.name: measure
    for measure in (
        Measure("invented", _invented, -1),
        Measure("named", _named, 0),
        Measure("best", _best, 1),
        Measure("exact", _exact, 1),
        Measure("first", _first, 1),
        Measure("inside", _inside, 1),
        Measure("sets", _sets, -1, is_share=False),
        Measure("causes", _causes, -1, is_share=False),
        Measure("needless", _needless, -1, is_share=False),
        Measure("strange", _strange, -1),
        Measure("flagged", _verdict("not_in_library", "slip"), 1),
        Measure("not in library", _verdict("not_in_library"), 1),
        Measure("slip named", _slip_named(0.0, _LONG), 1),
        Measure("small slip", _slip_named(0.0, LARGE_SLIP), 1),
        Measure("large slip", _slip_named(LARGE_SLIP, _LONG), 1),
        Measure("false slip", _false_slip, -1),
        Measure("interval", _intervals, 0),
        Measure("limit", _limits, 0),
        Measure("cure", _cure("after"), -1, is_share=False),
        Measure("auto", _cure("auto"), -1, is_share=False),
        Measure("failed", lambda record: (float(bool(record.failures)), 1.0), -1),
        Measure("CPU s", lambda record: (record.seconds, 1.0), -1, is_share=False),
    )
}


@dataclass(frozen=True)
class Rate:
    """A ratio of sums over boards, with its standard error."""

    value: float
    error: float
    count: float  # what it is a share of
    pulls: Mapping[tuple[str, int], float]  # how much each board moves it

    def difference(self, before: Rate) -> tuple[float, float]:
        """Return how much larger it is than before, with the error; boards of both are paired."""
        boards = {*self.pulls, *before.pulls}
        apart = [self.pulls.get(each, 0.0) - before.pulls.get(each, 0.0) for each in boards]
        return self.value - before.value, float(np.sqrt(np.sum(np.square(apart))))


def rate_of(measure: Measure, records: Iterable[Record]) -> Rate | None:
    """Return a rate over boards; None where nothing is counted. A share that was 0 or 1 throughout
    is given the error of one board.
    """
    boards = list(records)
    counted = np.array([measure.counted(record) for record in boards], dtype=float).reshape(-1, 2)
    of = float(counted[:, 1].sum())
    if not of:
        return None
    value = float(counted[:, 0].sum()) / of
    # Of a ratio of sums, since boards differ in how much they count.
    apart = (counted[:, 0] - value * counted[:, 1]) / of
    error = float(np.sqrt(np.sum(apart**2)))
    pulls = {
        (record.kind, record.index): float(pull)
        for record, pull in zip(boards, apart, strict=True)
        if pull
    }
    return Rate(value, max(error, 1 / of) if measure.is_share else error, of, pulls)


# Chances that were stated, and what came of them.

EDGES = (0.0, 0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.65, 0.8, 0.9, 0.95, 0.98, 1.0)
PRIOR = "prior"  # kinds that a posterior's prior draws


@dataclass(frozen=True)
class Stated:
    """A chance, and whether it came true."""

    chance: float
    is_true: bool


@dataclass(frozen=True)
class Bin:
    """Stated chances that are about as large."""

    low: float
    high: float
    stated: float  # on average
    seen: float
    count: int

    @property
    def error(self) -> float:
        """Standard error of the share that came true, if what was stated is right."""
        return float(np.sqrt(max(self.stated * (1 - self.stated), 1e-4) / self.count))


def bins_of(stated: Sequence[Stated]) -> list[Bin]:
    """Return stated chances in bins, those without any left out."""
    bins = []
    for low, high in pairwise(EDGES):
        last = high == EDGES[-1]
        inside = [
            each for each in stated if low <= each.chance < high or (last and each.chance >= high)
        ]
        if inside:
            chances, seen = (
                [getattr(each, name) for each in inside] for name in ("chance", "is_true")
            )
            bins.append(Bin(low, high, float(np.mean(chances)), float(np.mean(seen)), len(inside)))
    return bins


def brier(stated: Sequence[Stated]) -> float:
    """Return the mean square of what a chance is off."""
    return float(np.mean([(each.chance - each.is_true) ** 2 for each in stated]))


def effect_chances(record: Record) -> Mapping[str, float]:
    """Return how likely each effect is, by the engine or by the explanations that have it."""
    if record.effect_chances:
        return record.effect_chances
    chances: dict[str, float] = {}
    for account in record.accounts:
        if account.share is None:
            return {}
        for name in account.effects:
            chances[name] = chances.get(name, 0.0) + account.share
    return chances


def stated_of(what: str, records: Iterable[Record]) -> list[Stated]:
    """Return what was stated: of effects, of the first explanation, of a field, ..."""
    return [each for record in records for each in _STATED[what](record)]


def _of_effects(record: Record) -> list[Stated]:
    """Leave out what every machine has: it acts, and only its size may be unusual."""
    return [
        Stated(chance, name in (*record.effects, *record.usual))
        for name, chance in effect_chances(record).items()
        if name not in EVERY_MACHINE
    ]


def _of_first(record: Record) -> list[Stated]:
    if not is_plain(record) or not record.accounts or record.accounts[0].share is None:
        return []
    return [Stated(record.accounts[0].share, is_exact(record, set(record.accounts[0].effects)))]


def _of(name: str, is_true: Callable[[Record], bool]) -> Callable[[Record], list[Stated]]:
    def stated(record: Record) -> list[Stated]:
        chance: Any = getattr(record, name)
        return [] if chance is None else [Stated(float(chance), is_true(record))]

    return stated


_STATED: Mapping[str, Callable[[Record], list[Stated]]] = {
    "an effect acts": _of_effects,
    "the first explanation": _of_first,
    "a field": _of("field_chance", lambda record: bool(record.outside)),
    "nothing": _of("nothing_chance", lambda record: is_plain(record) and not record.effects),
    "an outlier": _of("outlier_chance", lambda record: bool(record.slipped)),
}
STATED = tuple(_STATED)
