"""One posterior over all accounts of the marks: every answer of a diagnosis is a reading of it.

An account says which effects act, and whether a reading is off as well, a round was moved, or
a smooth field acts that no effect draws. Accounts that ask for the same effects count together:
what every machine has is in each account, and is asked for only where the marks say that the
settings have it wrong.
"""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from plumb.diagnosis.every_machine import Clean, asked_for, clean_of, pitches
from plumb.diagnosis.evidence import (
    MOST_TOGETHER,
    Accounts,
    Effects,
    Noises,
    accounts_with,
    outlier_weights,
    search,
    weights_of,
)
from plumb.diagnosis.explanation import Board, Explanation, explain
from plumb.diagnosis.linear import (
    LinearBoard,
    Metric,
    MovedRound,
    Other,
    fields,
    moved_rounds,
)
from plumb.diagnosis.noise import Noise, noise_by
from plumb.diagnosis.outliers import Reading, readings_of
from plumb.diagnosis.priors import (
    FIELD,
    MOVED,
    OUTLIER,
    PITCH,
    TURNED,
    noise_prior,
    usual_checks,
    zero_checks,
)
from plumb.fit.inputs import Stated
from plumb.model.catalogue import EVERY_MACHINE
from plumb.model.plain import ascending, ranked

Array = np.ndarray
TRIED_SPREADS = (1.0, 4.0)  # [mm] of the fields beside which sets are looked for
REFITTED = 8  # likeliest sets that are made linear about the fit of each
NEAR = 5.0  # nats below the best within which they are
LISTED = 0.95  # of all weight that the listed accounts hold together
MOST_LISTED = 8


@dataclass(frozen=True)
class Account:
    """Effects that the marks ask for together."""

    effects: Effects  # first those that only some machines have
    acting: Effects  # effects of the likeliest set behind it, beyond what is usual
    clean: float  # log weight with nothing else
    field: float  # log weight with a smooth field too

    @property
    def weight(self) -> float:
        """Log weight with a smooth field and without."""
        return float(np.logaddexp(self.clean, self.field))


@dataclass(frozen=True)
class Listed:
    """An account that is worth naming, and how likely it is with those that only add to it."""

    account: Account
    share: float  # of all accounts


@dataclass(frozen=True)
class Posterior:
    """How likely each account is; weights are logarithms with a constant in common."""

    frame: Explanation
    felt: Effects
    accounts: tuple[Account, ...]  # likeliest first
    moved: tuple[tuple[MovedRound, float], ...]  # rounds that do not go with the others
    outliers: Array  # (readings,) with this reading off
    turned: float | None  # with all y errors the other way round; None without marks
    noise: Noise
    noises: Noises  # worth a look
    smooth: Other | None = None  # the likeliest field

    @cached_property
    def _of_effects(self) -> float:
        """Log weight of all accounts with effects and perhaps a field."""
        return float(np.logaddexp.reduce([account.weight for account in self.accounts]))

    @cached_property
    def _whole(self) -> float:
        moved = [weight for _, weight in self.moved]
        return float(np.logaddexp.reduce([self._of_effects, *moved, *self.outliers]))

    @property
    def field_chance(self) -> float:
        """How likely it is that the machine also does what no effect of the library does."""
        fields = np.logaddexp.reduce([account.field for account in self.accounts])
        return float(np.exp(fields - self._whole))

    @property
    def moved_chances(self) -> Mapping[MovedRound, float]:
        """How likely each way is in which a later round does not go with the others."""
        return {move: float(np.exp(weight - self._whole)) for move, weight in self.moved}

    @property
    def outlier_chances(self) -> Array:
        """How likely each reading is off (readings,)."""
        chances: Array = np.exp(self.outliers - self._whole)
        return chances

    @property
    def turned_chance(self) -> float:
        """How likely it is that all y errors have the wrong sign."""
        if self.turned is None:
            return 0.0
        return float(np.exp(self.turned - np.logaddexp(self.turned, self._whole)))

    @property
    def nothing_chance(self) -> float:
        """How likely it is that no effect acts, if no reading is off and no round was moved."""
        return sum(self.chance_of(each) for each in self.accounts if not each.effects)

    @property
    def effect_chances(self) -> Mapping[str, float]:
        """How likely each felt effect is asked for, on the same condition."""
        chances = dict.fromkeys(self.felt, 0.0)
        for account in self.accounts:
            for name in account.effects:
                chances[name] += self.chance_of(account)
        return chances

    def chance_of(self, account: Account) -> float:
        """How likely an account is, on the same condition."""
        return float(np.exp(account.weight - self._of_effects))

    def listed(self) -> list[Listed]:
        """Return the fewest accounts that hold LISTED of the weight, likeliest first.

        An account with more effects than a likelier account adds nothing that the marks ask for,
        so it counts with that one; but none counts with "nothing", which would hide it.
        """
        several = [account.effects for account in self.accounts]
        weights = np.array([account.weight for account in self.accounts])
        return [Listed(self.accounts[i], share) for i, share in listing(several, weights)]


def listing(several: Sequence[Effects], weights: Array) -> list[tuple[int, float]]:
    """Return the same of accounts that ask for some effects, by log weights (accounts,): the place
    and the share of each.
    """
    chances = np.exp(weights - np.logaddexp.reduce(weights)).tolist()
    kept: dict[int, float] = {}
    before = 0.0
    for i in ascending(-weights).tolist():
        effects = {*several[i]}
        base = next((j for j in kept if several[j] and {*several[j]} < effects), None)
        if base is not None:
            kept[base] += chances[i]
        elif before < LISTED and len(effects) <= MOST_TOGETHER + len(EVERY_MACHINE):
            kept[i] = chances[i]
        else:
            continue
        before += chances[i]
    order = ranked(kept, lambda i: -kept[i])
    held = np.cumsum([0.0, *(kept[i] for i in order)])
    return [
        (i, kept[i])
        for i, so_far in zip(order[:MOST_LISTED], held.tolist(), strict=False)
        if so_far < LISTED
    ]


def together(asked: Sequence[Effects], weights: Array) -> tuple[list[Effects], Array]:
    """Return what sets ask for, each once, with the log weight (accounts, ...) of all that ask for
    it; weights (sets, ...).
    """
    places: dict[Effects, int] = {}
    of_set = [places.setdefault(effects, len(places)) for effects in asked]
    total = np.full((len(places), *weights.shape[1:]), -np.inf)
    np.logaddexp.at(total, of_set, weights)
    return list(places), total


def posterior_of(board: Board, stated: Stated | None) -> Posterior:
    """Weigh all accounts of a board."""
    frame = board.fitted
    felt = felt_effects(frame)
    linear = LinearBoard.of(frame, felt)
    middle, _ = noise_prior(stated)
    others = fields(frame, middle)
    found = search(linear, stated, [each for each in others if each.spread in TRIED_SPREADS])
    noises, accounts = found.noises, accounts_with(linear, found.sets)
    near, with_field = accounts.among(found.clean), accounts.among(found.field)
    weights = _by_other(linear, with_field, noises, others, FIELD)
    for each, other in zip(weights, others, strict=True):
        # What noise hides is nothing to look for.
        each[:, noises.sigmas > other.spread] = -np.inf
    by_field = np.logaddexp.reduce(weights, axis=2)
    smooth = others[int(np.argmax(np.logaddexp.reduce(by_field, axis=1)))]
    clean = clean_of(linear, accounts, noises).on(0)
    smoothed = clean_of(linear, with_field, noises, smooth).on(0)
    field = np.logaddexp.reduce(by_field, axis=0)
    clean, field = _refitted(frame, found.sets, noises, smooth, (clean, smoothed, field))
    moves = moved_rounds(frame)
    moved = [_by_other(linear, near, noises, [move.other], MOVED / len(moves)) for move in moves]
    readings = readings_of(board.rows)
    numbers = _numbers(readings, board, len(linear.read))
    of_field = np.logaddexp.reduce(weights, axis=(0, 1))
    return Posterior(
        frame=frame,
        felt=felt,
        accounts=_accounts(linear, accounts, (clean, replace(smoothed, total=field))),
        moved=tuple(
            (move, float(np.logaddexp.reduce(weight, axis=None)))
            for move, weight in zip(moves, moved, strict=True)
        ),
        outliers=outlier_weights(linear, near.up_to(2), noises, numbers) + np.log(OUTLIER),
        turned=_turned(frame, linear, near, noises),
        noise=noise_by(noises.sigmas, np.logaddexp(clean.by_noise, of_field), stated),
        noises=noises,
        smooth=smooth,
    )


def felt_effects(frame: Explanation) -> Effects:
    """Effects that change any of the measured numbers."""
    board = frame.board
    return tuple(
        name for name in board.effect_columns if np.any(frame.slopes[:, board.columns([name])])
    )


def _by_other(
    board: LinearBoard, accounts: Accounts, noises: Noises, others: Sequence[Other], chance: float
) -> Array:
    """Return the log weights (others, sets, m) with each of some other things too, one of which
    acts by `chance`.
    """
    return np.stack(
        [_with(board, accounts, noises, other) + np.log(chance / len(others)) for other in others]
    )


def _with(
    board: LinearBoard, accounts: Accounts, noises: Noises, other: Other | None = None
) -> Array:
    """Return the log weights (sets, m) with another thing too, if there is one."""
    weights = [
        weights_of(accounts, Metric.of(board, noises.sigmas, other, pitch=is_drifting), noises)
        + log
        for is_drifting, log in pitches(board)
    ]
    return np.asarray(np.logaddexp.reduce(weights))


def _turned(
    frame: Explanation, board: LinearBoard, accounts: Accounts, noises: Noises
) -> float | None:
    """Return the log weight of all accounts if each mark is as far above as it is read below."""
    rows = frame.board.rows
    if not len(rows.measured):
        return None
    read = board.read.copy()
    read[1 : rows.measured.size : 2, 0] += 2 * (rows.targets - rows.measured)[:, 1]
    weights = _with(replace(board, read=read), accounts, noises)
    return float(np.logaddexp.reduce(weights, axis=None) + np.log(TURNED))


def _numbers(readings: Sequence[Reading], board: Board, none: int) -> Array:
    """Rows (readings, 2) of each reading; `none` where it has a single number."""
    numbers = np.full((len(readings), 2), none)
    for row, reading in zip(numbers, readings, strict=True):
        row[: reading.size] = reading.numbers(board.rows)
    return numbers


def _accounts(
    board: LinearBoard, accounts: Accounts, weighed: tuple[Clean, Clean]
) -> tuple[Account, ...]:
    """Put sets together that ask for the same effects, with nothing else and with a field."""
    asked: list[Effects] = []
    several: list[tuple[float, float, int]] = []
    for place, each in enumerate(weighed):
        order = [i for i in ascending(-each.total).tolist() if np.isfinite(each.total[i])]
        asked += asked_for(board, accounts, each, order)
        several += [(place, each.total[i], i) for i in order]
    weights = np.full((len(several), 2), -np.inf)
    for row, (place, weight, _) in zip(weights, several, strict=True):
        row[place] = weight
    likeliest: dict[Effects, int] = {}
    for k in ascending(-weights.max(axis=1)).tolist():
        likeliest.setdefault(asked[k], several[k][2])
    merged = [
        Account(effects, accounts.effects[likeliest[effects]], *both)
        for effects, both in zip(*map(list, together(asked, weights)), strict=True)
    ]
    return tuple(ranked(merged, lambda account: -account.weight))


def _refitted(
    frame: Explanation,
    sets: Sequence[Effects],
    noises: Noises,
    smooth: Other,
    weighed: tuple[Clean, Clean, Array],
) -> tuple[Clean, Array]:
    """Return the weights with the likeliest sets made linear about the fit of each.

    Slopes at the frame's fit are good to a part of a nat for most sets; where the sled sticks, or
    an error is large, they are not.
    """
    clean, smoothed, field = weighed
    total, with_field = clean.total.copy(), field.copy()
    both = np.logaddexp(total, field)
    for i in ascending(-both)[:REFITTED].tolist():
        acting = sets[i]
        if not acting or both[i] < both.max() - NEAR:
            continue
        at = explain_account(frame, acting, acting)
        usual = (*EVERY_MACHINE, PITCH)
        felt = [name for name in felt_effects(frame) if name in acting or name in usual]
        linear = LinearBoard.of(at, felt)
        only = accounts_with(linear, [acting])
        total[i], of_smooth = (
            float(np.logaddexp.reduce(_with(linear, only, noises, other), axis=None))
            for other in (None, smooth)
        )
        if np.isfinite(field[i]):
            with_field[i] += of_smooth - smoothed.total[i]
    shift = total - clean.total
    return replace(clean, total=total, nominal=clean.nominal + shift), with_field


def explain_account(frame: Explanation, asked: Effects, acting: Effects) -> Explanation:
    """Refit the frame and the effects of an account; what every machine has and the settings leave
    out too, held near what is usual where it does not act beyond that. What cannot be negative and
    fits best there is held at zero.
    """
    board = frame.board
    left_out = [
        name
        for name in EVERY_MACHINE
        if name not in asked and not board.problem.start[board.columns([name])].any()
    ]
    effects = (*asked, *left_out)
    usual = usual_checks(board, [name for name in effects if name not in acting])
    fitted = explain(board.with_usual(usual), effects, start=frame)
    impossible = zero_checks(fitted)
    if not impossible:
        return fitted
    return explain(board.with_usual((*usual, *impossible)), effects, start=frame)
