"""Rates of many games: how often the lab was right, and what was left against what is possible."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy
from game import Played

SURE = 0.95


@dataclass(frozen=True)
class Row:
    """The games of a row of the table, or of several rows together."""

    name: str
    games: int
    solved: tuple[float, float, float]  # share, and its 95 % interval (Clopper and Pearson)
    false: int  # claims of what is not there, in all games
    marks: float  # mean of the first sheet
    minutes: float  # mean
    before: float  # [mm] of the sled all over the sheet, without noise: root of the mean square
    after: float
    known: float
    sled_ratio: tuple[float, float]  # after over known, and its standard deviation
    cut_ratio: tuple[float, float]  # the same of the second sheet as a tape reads it


def row_of(name: str, games: Sequence[Played]) -> Row:
    """Return the rates of some games."""
    solved = sum(game.solved for game in games)
    return Row(
        name,
        len(games),
        (solved / len(games), *_interval(solved, len(games))),
        sum(game.false for game in games),
        float(np.mean([game.marks for game in games])),
        float(np.mean([game.minutes for game in games])),
        _mean_square([game.sled_before for game in games]),
        _mean_square([game.sled_after for game in games]),
        _mean_square([game.sled_known for game in games]),
        _ratio([game.sled_after for game in games], [game.sled_known for game in games]),
        _ratio([game.cut_after for game in games], [game.cut_known for game in games]),
    )


def rows_of(games: Sequence[Played]) -> list[Row]:
    """Return a row for each level or cell, in the order in which they came first."""
    names = dict.fromkeys(game.row for game in games)
    return [row_of(name, [game for game in games if game.row == name]) for name in names]


def _interval(good: int, count: int) -> tuple[float, float]:
    """Return the interval of a share that holds whatever the share is."""
    tail = (1 - SURE) / 2
    low = scipy.special.betaincinv(good, count - good + 1, tail) if good else 0.0
    high = scipy.special.betaincinv(good + 1, count - good, 1 - tail) if good < count else 1.0
    return float(low), float(high)


def _mean_square(errors: Sequence[float]) -> float:
    return float(np.sqrt(np.mean(np.square(errors))))


def _ratio(errors: Sequence[float], floors: Sequence[float]) -> tuple[float, float]:
    """Return the ratio of both means, and its standard deviation as another draw of games would
    show.
    """
    after, known = np.array(errors), np.array(floors)
    value = float(after.sum() / known.sum())
    if len(after) < 2:
        return value, float("nan")
    apart = after - value * known
    return value, float(np.sqrt(len(after) * apart.var(ddof=1)) / known.sum())
