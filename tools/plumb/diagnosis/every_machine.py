"""Sets of effects on a machine as every machine is: what the marks ask for beyond that.

Every chain stretches and sags, and half of all chains are a little long or short. So this is in
each account within what is usual, and is asked for only where the marks move it.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass
from functools import cache
from itertools import compress

import numpy as np
import scipy

from plumb.diagnosis.evidence import (
    AccountGroup,
    Accounts,
    Effects,
    Fitted,
    Noises,
    add_by_set,
    fitted,
)
from plumb.diagnosis.linear import Disturbance, LinearBoard, Metric
from plumb.diagnosis.priors import PITCH, PITCH_CHANCE

Array = np.ndarray
ONE_IN = 20.0  # times less likely after the marks than before: then what the settings say is wrong


@dataclass(frozen=True)
class Clean:
    """Log evidences (sets, boards) of all sets, and what hangs on them."""

    total: Array
    nominal: Array  # without what chains usually are longer or shorter
    at_settings: dict[int, Array]  # of each usual number: log ratio of its densities, after to
    # before the marks, where the settings have it
    by_noise: Array  # (m,) of the first board

    def on(self, board: int) -> Clean:
        """Return the same of one board, as arrays (sets,)."""
        ratios = {column: each[:, board] for column, each in self.at_settings.items()}
        return Clean(self.total[:, board], self.nominal[:, board], ratios, self.by_noise)


def clean_of(
    board: LinearBoard, accounts: Accounts, noises: Noises, other: Disturbance | None = None
) -> Clean:
    """Weigh all sets, with nominal chains and with chains as makers sell them; beside something
    else if it is given.
    """
    usual = [int(column) for column in np.flatnonzero(board.sizes.usual)]
    shape = (len(accounts.effects), board.read.shape[1])
    by_pitch, density = [], {column: np.full(shape, -np.inf) for column in usual}
    by_noise = np.full(len(noises.sigmas), -np.inf)
    for is_drifting, log_chance in pitches(board):
        total = np.full(shape, -np.inf)
        metric = Metric.of(board, noises.sigmas, other, pitch=is_drifting)
        for part in accounts.parts:
            fit = fitted(part, metric)
            weight = _by_noise(fit.evidence, part) + noises.log_prior + log_chance
            add_by_set(total, part, np.logaddexp.reduce(weight, axis=2).T)
            by_noise = np.logaddexp(by_noise, np.logaddexp.reduce(weight[0], axis=0))
            for column in usual:
                there = weight + _by_noise(_density_at_settings(board, part, fit, column), part)
                add_by_set(density[column], part, np.logaddexp.reduce(there, axis=2).T)
        by_pitch.append(total)
    whole = np.logaddexp.reduce(by_pitch)
    weighed = np.where(np.isfinite(whole), whole, 0.0)
    at_settings = {
        column: each - weighed - _prior_at_settings(board, column)
        for column, each in density.items()
    }
    return Clean(whole, by_pitch[0], at_settings, by_noise)


def _by_noise(values: Array, part: AccountGroup) -> Array:
    """Return values (boards, a * m) as (boards, a, m)."""
    return values.reshape(len(values), len(part.sets), -1)


def pitches(board: LinearBoard) -> list[tuple[bool, float]]:
    """Return whether chains are as makers sell them, with the logarithm of its chance."""
    if not board.sizes.pitch.any():
        return [(False, 0.0)]
    return [(False, float(np.log(1 - PITCH_CHANCE))), (True, float(np.log(PITCH_CHANCE)))]


def _density_at_settings(board: LinearBoard, part: AccountGroup, fit: Fitted, column: int) -> Array:
    """Return the log density (boards, a * m) of a size where the settings have it."""
    noises = fit.inverse.shape[2] // len(part.sets)
    place = np.repeat(np.argmax(part.index == column, axis=1), noises)
    each = np.arange(len(place))
    return _log_density(board, column, fit.mean[place, :, each].T, fit.inverse[place, place, each])


def _prior_at_settings(board: LinearBoard, column: int) -> float:
    spread = board.sizes.usual[column]
    return float(_log_density(board, column, np.zeros(1), np.full(1, spread**2))[0])


def _log_density(board: LinearBoard, column: int, mean: Array, variance: Array) -> Array:
    """Return the log density at the settings' value of normals without their impossible part."""
    at = -board.sizes.mean[column]
    edge = board.sizes.mean[column] - board.sizes.least[column]
    normal = -0.5 * (at - mean) ** 2 / variance - 0.5 * np.log(2 * np.pi * variance)
    density: Array = normal - scipy.special.log_ndtr((mean + edge) / np.sqrt(variance))
    return density


def asked_for(
    board: LinearBoard, accounts: Accounts, clean: Clean, sets: Iterable[int]
) -> list[Effects]:
    """Return what the marks ask for by each of some sets: its effects, and of what every machine
    has only what the settings cannot have right (its density there fell to a twentieth, Dickey
    1971). `clean` is of one board.
    """
    names, chosen = tuple(board.columns), np.array(list(sets), dtype=int)
    of_column = {int(column): name for name in names for column in board.columns[name]}
    every = tuple(of_column[column] for column in clean.at_settings)
    wrong = [ratio[chosen] < -np.log(ONE_IN) for ratio in clean.at_settings.values()]
    drifts = clean.nominal[chosen] < clean.total[chosen] - np.log(ONE_IN + 1)
    if not board.sizes.pitch.any():
        drifts[:] = False
    flags = np.stack([drifts, *wrong], axis=1).tolist()
    return [
        _asked(names, every, accounts.effects[i], tuple(each))
        for i, each in zip(chosen.tolist(), flags, strict=True)
    ]


@cache
def _asked(names: Effects, every: Effects, acting: Effects, flags: tuple[bool, ...]) -> Effects:
    """Return what a set asks for, in one order, so that the same effects are one account whichever
    set asks for them. flags: whether chains are longer or shorter than nominal, and which settings
    of what every machine has are wrong.
    """
    drifts, *wrong = flags
    wanted = {*acting, PITCH} if drifts else {*acting}
    only_some = (name for name in names if name in wanted and name not in every)
    return (*only_some, *compress(every, wrong))
