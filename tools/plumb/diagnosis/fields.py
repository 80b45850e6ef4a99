"""Accounts in which the machine also does what no effect of the library draws.

That is a smooth field all over the sheet, or a spot of it. It adds to effects: sets of up to
three are weighed beside it, and the likeliest are made linear about the fit of each.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.diagnosis.every_machine import Clean, clean_of, pitches
from plumb.diagnosis.evidence import Accounts, Effects, Noises, weights_of
from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.linear import Disturbance, LinearBoard, Metric
from plumb.diagnosis.priors import FIELD, LIKELIER, TOGETHER
from plumb.diagnosis.refit import about, explain_account
from plumb.diagnosis.spots import Spot, likely_spots
from plumb.model.plain import ascending, greatest

Array = np.ndarray
NEGLIGIBLE = 0.02  # chance of a field below which its accounts are not looked at more closely
NEAR = 5.0  # nats below the best within which a field, and a set beside it, count
MOST_FIELDS = 6  # that are weighed with sets of three
BEAM = 12  # sets of two that are tried with a third effect
REFITTED = 6  # likeliest sets that are made linear about the fit of each


@dataclass(frozen=True)
class Fields:
    """Fields that may act, and the logarithm of the chance of each."""

    each: tuple[Disturbance, ...]
    log_chances: Array  # (fields,)
    spots: tuple[Spot, ...] = ()  # the last of `each`

    @staticmethod
    def of(
        frame: Explanation, board: LinearBoard, noises: Noises, smooth: Sequence[Disturbance]
    ) -> Fields:
        """Return these smooth fields, and the spots that are worth a look."""
        spots = likely_spots(frame, board, noises.sigmas)
        chances = [FIELD / 2 / len(smooth)] * len(smooth)
        chances += [FIELD / 2 * spot.share for spot in spots]
        others = (*smooth, *(spot.other for spot in spots))
        return Fields(others, np.log(chances), tuple(spots))

    def among(self, kept: Sequence[int]) -> Fields:
        """Return some of them; the places rise."""
        first = len(self.each) - len(self.spots)
        return Fields(
            tuple(self.each[i] for i in kept),
            self.log_chances[kept],
            tuple(self.spots[i - first] for i in kept if i >= first),
        )

    def weights(self, board: LinearBoard, accounts: Accounts, noises: Noises) -> Array:
        """Return the log weights (fields, sets, m) of sets with each field."""
        return np.stack(
            [
                weights_with(board, accounts, noises, other) + log
                for other, log in zip(self.each, self.log_chances, strict=True)
            ]
        )

    def weight_about(self, at: Explanation, effects: Effects, noises: Noises) -> float:
        """Return the log weight of a set with any of the fields, linear about a fit."""
        return float(np.logaddexp.reduce(self.weights(*about(at, effects), noises), axis=None))


@dataclass(frozen=True)
class WithFields:
    """Log weights of accounts with a field."""

    fields: Fields  # that are worth a look
    total: Array  # (sets,)
    by_noise: Array  # (m,)
    beside: Clean | None  # of the same sets beside the likeliest field; None: no field is likely
    spots: Array  # (spots,) share of all these weights that each has

    @property
    def spot(self) -> Spot | None:
        """Spot that acts, where one is likelier than a field all over the sheet."""
        if not np.sum(self.spots) > LIKELIER:
            return None
        return self.fields.spots[greatest(self.spots)]


def weights_with(
    board: LinearBoard, accounts: Accounts, noises: Noises, other: Disturbance
) -> Array:
    """Return the log weights (sets, m) with something else too, as likely as that is itself."""
    weights: Array = np.logaddexp.reduce(
        [
            weights_of(accounts, Metric.of(board, noises.sigmas, other, pitch=is_drifting), noises)
            + log
            for is_drifting, log in pitches(board)
        ]
    )
    return weights


def weigh_fields(
    frame: Explanation,
    board: LinearBoard,
    accounts: Accounts,
    noises: Noises,
    every: Fields,
    clean: float,
) -> WithFields:
    """Weigh all sets of up to two effects with each field; sets of three and what is likeliest more
    closely, where a field is likely at all. clean: log weight of all sets without any.
    """
    weights = every.weights(board, accounts.up_to(2), noises)
    of_field = np.logaddexp.reduce(weights, axis=(1, 2))
    if np.logaddexp.reduce(of_field) < clean + np.log(NEGLIGIBLE):
        return _summed(every, weights)
    order = ascending(-of_field)[:MOST_FIELDS]
    near = sorted(i for i in order.tolist() if of_field[i] > of_field.max() - NEAR)
    kept = every.among(near)
    closer = kept.weights(board, accounts.among(_worth_a_look(accounts, weights)), noises)
    found = _summed(kept, np.logaddexp(weights[near], closer))
    weighed = accounts.among(np.isfinite(found.total))
    beside = clean_of(board, weighed, noises, kept.each[greatest(of_field[near])]).on(0)
    total = _refitted(frame, board, accounts, noises, found)
    return replace(found, total=total, beside=beside)


def _summed(each: Fields, weights: Array) -> WithFields:
    by_field = np.logaddexp.reduce(weights, axis=(1, 2))
    of_spots = by_field[len(each.each) - len(each.spots) :]
    return WithFields(
        each,
        np.logaddexp.reduce(weights, axis=(0, 2)),
        np.logaddexp.reduce(weights, axis=(0, 1)),
        None,
        np.exp(of_spots - np.logaddexp.reduce(by_field)),
    )


def _worth_a_look(accounts: Accounts, weights: Array) -> Array:
    """Return which sets of three (sets,) hold one of the likeliest sets of two with a field."""
    total = np.logaddexp.reduce(weights, axis=(0, 2))
    pairs = [i for i in ascending(-total).tolist() if len(accounts.effects[i]) == TOGETHER - 1]
    best = [{*accounts.effects[i]} for i in pairs[:BEAM]]
    return np.array(
        [
            len(names) == TOGETHER and any(pair < {*names} for pair in best)
            for names in accounts.effects
        ]
    )


def _refitted(
    frame: Explanation, board: LinearBoard, accounts: Accounts, noises: Noises, found: WithFields
) -> Array:
    """Return the weights (sets,) with the likeliest sets made linear about the fit of each."""
    total = found.total.copy()
    for i in ascending(-total)[:REFITTED].tolist():
        acting = accounts.effects[i]
        if not acting or len(acting) > TOGETHER or total[i] < total.max() - NEAR:
            continue
        at = explain_account(frame, acting, acting)
        linear = LinearBoard.of(at, tuple(board.columns))
        only = accounts.among(np.arange(len(total)) == i)
        total[i] = np.logaddexp.reduce(found.fields.weights(linear, only, noises)[:, i], axis=None)
    return total
