"""One posterior over all accounts of the marks: every answer of a diagnosis is a reading of it."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import product

import numpy as np

from plumb.diagnosis.evidence import (
    FEWER,
    Accounts,
    Clean,
    Disturbance,
    Effects,
    LinearBoard,
    Metric,
    MovedRound,
    Noise,
    Noises,
    Reading,
    about,
    accounts_of,
    asked_for,
    clean_of,
    explain_account,
    felt_effects,
    moved_rounds,
    noise_by,
    noises_of,
    outlier_weights,
    pitches,
    readings_of,
    smooth_fields,
    weights_of,
)
from plumb.diagnosis.explanation import Board, Explanation, half_span, measured_columns, places_of
from plumb.diagnosis.priors import (
    FIELD,
    FIELD_SPREADS,
    LIKELIER,
    MOVED,
    OUTLIER,
    SPOT_WIDTHS,
    TOGETHER,
    TURNED,
    noise_prior,
)
from plumb.fit.inputs import Stated
from plumb.model.catalogue import EVERY_MACHINE
from plumb.model.plain import ascending, greatest, ranked

# Spots: places of the sheet about which the machine does what no effect draws.
#
# A spot falls off as a Gauss bell does and moves the sled each way by normals. Of a grid of spots
# over the whole sheet those are looked for that the marks ask for most, if all effects act at once;
# about the best of them the grid is made finer as long as that pays for its smaller share.


Array = np.ndarray
GRID = (9, 5)  # middles across and up
SEEN = 0.5  # of a spot's size: one that moves no reading by that is left out
MOST = 10  # spots that are worth a look
FAR_BELOW = 8.0  # nats below the best: what is less likely is not looked at
# Across, up, and logarithm of the width: half of the way to the next of the grid.
STEP = (0.125, 0.25, 0.3)
FINER = 8  # spots of half the step in the room of one


@dataclass(frozen=True, eq=False)
class Spot:
    """A spot, and what it moves of the measured numbers."""

    middle: Array  # (2,) [mm]
    share: float  # of all spots
    other: Disturbance


def likely_spots(frame: Explanation, board: LinearBoard, sigmas: Array) -> list[Spot]:
    """Return the spots that are worth a look with some noise (m,) [mm], if all effects act."""
    seek = _Seek(frame, board, sigmas)
    grid = np.array(
        list(product(*(np.linspace(-1, 1, count) for count in GRID), np.log(SPOT_WIDTHS)))
    )
    gains = seek.gains(grid)
    order = ascending(-gains.ravel())[:MOST].tolist()
    likely = [
        (int(place), int(spread))
        for i in order
        for place, spread in [np.unravel_index(i, gains.shape)]
        if gains[place, spread] > gains.max() - FAR_BELOW
    ]
    if not likely:
        return []
    place, spread = likely[0]
    best = seek.closer(grid[place], float(gains[place, spread]), 1 / gains.size)
    return [*(seek.spot(grid[i], j, 1 / gains.size) for i, j in likely), *best]


@dataclass(frozen=True)
class _Seek:
    """The search of spots (k, 3): x and y of the middle in halves of what the marks span, from the
    middle of it, and the logarithm of the width in the same halves.
    """

    frame: Explanation
    board: LinearBoard
    sigmas: Array

    def spot(self, spot: Array, spread: int, share: float) -> Spot:
        """Return the spot of a place and a spread."""
        places = places_of(self.frame)
        middle = (places.max(axis=0) + places.min(axis=0)) / 2 + half_span(places) * spot[:2]
        (columns,) = self._columns(spot[np.newaxis])
        other = Disturbance.of(columns[: self.board.measured]).times(FIELD_SPREADS[spread])
        return Spot(middle, share, other)

    def closer(self, spot: Array, gain: float, share: float) -> list[Spot]:
        """Return the best spot on ever finer grids about this; none if they do not pay."""
        step, found = np.array(STEP), list[Spot]()
        while True:
            near = spot + step * np.array(list(product((-1, 0, 1), repeat=3)))
            gains = self.gains(near)
            place, spread = np.unravel_index(greatest(gains.ravel()), gains.shape)
            if not gains[place, spread] > gain + np.log(FINER):
                return found
            spot, gain = near[place], float(gains[place, spread])
            step, share = step / 2, share / FINER
            found = [self.spot(spot, int(spread), share)]

    def gains(self, spots: Array) -> Array:
        """Return the log evidence that each spot adds (k, spreads), with the noise for which that
        is most; -inf for a spot that moves no reading by half of its size.
        """
        columns = self._columns(spots)
        gains = np.max([_gains(self.board, sigma, columns) for sigma in self.sigmas], axis=0)
        gains[np.abs(columns).max(axis=(1, 2)) < SEEN] = -np.inf
        return np.asarray(gains)

    def _columns(self, spots: Array) -> Array:
        """Return what spots move (k, n, 2) [mm], 1 mm to the right in the middle, and upwards."""
        places = places_of(self.frame)
        half = half_span(places)
        middle = (places.max(axis=0) + places.min(axis=0)) / 2
        apart = np.sum(((places - middle) / half - spots[:, np.newaxis, :2]) ** 2, axis=2)
        moved = np.exp(-apart / (2 * np.exp(2 * spots[:, [2]])))
        measured = measured_columns(moved.T, places, self.frame.board.rows)
        columns = np.zeros((len(spots), len(self.board.read), 2))
        columns[:, : len(measured)] = measured.reshape(len(measured), 2, -1).transpose(2, 0, 1)
        return columns


def _gains(board: LinearBoard, sigma: float, spots: Array) -> Array:
    """Return the log evidence that each of some spots (k, n, 2) [mm] adds, for each spread
    (k, s), if all effects act: ln N(y; 0, C + s^2 U U') - ln N(y; 0, C).
    """
    spreads = np.sqrt(board.sizes.usual**2 + board.sizes.largest**2)
    drawn = np.hstack([board.frame, board.effects * spreads])
    weight = np.r_[np.full(board.measured, sigma**-2), np.ones(len(drawn) - board.measured)]
    weighted = weight[:, np.newaxis] * drawn
    inner = np.eye(drawn.shape[1]) + drawn.T @ weighted
    root = np.linalg.solve(np.linalg.cholesky(inner), weighted.T)
    seen = np.einsum("rn,kni->kri", root, spots, optimize=True)
    square = np.einsum("kni,n,knj->kij", spots, weight, spots, optimize=True)
    square -= np.einsum("kri,krj->kij", seen, seen, optimize=True)
    read = board.read[:, 0]
    pull = np.einsum("kni,n->ki", spots, weight * read - root.T @ (root @ read), optimize=True)
    gains = []
    for spread in FIELD_SPREADS:
        whole = square + np.eye(2) * spread**-2
        taken = np.linalg.solve(whole, pull[:, :, np.newaxis])[:, :, 0]
        size = np.linalg.slogdet(whole)[1] + 4 * np.log(spread)
        gains.append((np.sum(pull * taken, axis=1) - size) / 2)
    return np.stack(gains, axis=1)


# Accounts in which the machine also does what no effect of the library draws.
#
# That is a smooth field all over the sheet, or a spot of it. It adds to effects: sets of up to
# three are weighed beside it, and the likeliest are made linear about the fit of each.


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


# An account says which effects act, and whether a reading is off as well, a round was moved, or
# a smooth field acts that no effect draws. Accounts that ask for the same effects count together:
# what every machine has is in each account, and is asked for only where the marks say that the
# settings have it wrong.


LISTED = 0.95  # of all weight that the listed accounts hold together
MOST_LISTED = 8


@dataclass(frozen=True)
class Account:
    """Effects that the marks ask for together."""

    effects: Effects  # first those that only some machines have
    acting: Effects  # effects of the likeliest set behind it, beyond what is usual
    clean: float  # log weight with nothing else
    field: float  # log weight with a smooth field too


@dataclass(frozen=True)
class Listed:
    """An account that is worth naming, and how likely it is, mostly with those that add to it."""

    account: Account
    share: float  # of all accounts


@dataclass(frozen=True)
class Posterior:
    """The probability of each account; weights are logarithms with a constant in common."""

    frame: Explanation
    felt: Effects
    accounts: tuple[Account, ...]  # likeliest first
    moved: tuple[tuple[MovedRound, float], ...]  # rounds that do not go with the others
    outliers: Array  # (readings,) with this reading off
    turned: float | None  # with all y errors the other way round; None without marks
    noise: Noise
    noises: Noises  # worth a look
    with_fields: WithFields

    @cached_property
    def clean(self) -> float:
        """Log weight of all accounts with effects and nothing else."""
        return float(np.logaddexp.reduce([account.clean for account in self.accounts]))

    @cached_property
    def _whole(self) -> float:
        fields = [account.field for account in self.accounts]
        moved = [weight for _, weight in self.moved]
        return float(np.logaddexp.reduce([self.clean, *fields, *moved, *self.outliers]))

    @property
    def field_chance(self) -> float:
        """The probability that the machine also does what no effect of the library does."""
        fields = np.logaddexp.reduce([account.field for account in self.accounts])
        return float(np.exp(fields - self._whole))

    @property
    def moved_chances(self) -> Mapping[MovedRound, float]:
        """The probability of each way in which a later round does not fit the others."""
        return {move: float(np.exp(weight - self._whole)) for move, weight in self.moved}

    @property
    def apart(self) -> tuple[int, ...]:
        """Numbers of the rounds that likely do not go with the others."""
        chances: dict[int, float] = {}
        for move, chance in self.moved_chances.items():
            chances[move.number] = chances.get(move.number, 0.0) + chance
        return tuple(number for number, chance in chances.items() if chance > LIKELIER)

    @property
    def outlier_chances(self) -> Array:
        """The probability that each reading is off (readings,)."""
        chances: Array = np.exp(self.outliers - self._whole)
        return chances

    @property
    def turned_chance(self) -> float:
        """The probability that all y errors have the wrong sign."""
        if self.turned is None:
            return 0.0
        return float(np.exp(self.turned - np.logaddexp(self.turned, self._whole)))

    def nothing_chance(self, *, with_field: bool = False) -> float:
        """Return the probability that no effect acts, with nothing else wrong, or with a field."""
        chances = self._chances(with_field)
        return sum(
            chance
            for account, chance in zip(self.accounts, chances, strict=True)
            if not account.effects
        )

    def effect_chances(self, *, with_field: bool = False) -> Mapping[str, float]:
        """Return the probability that each felt effect is needed, on the same condition."""
        chances = dict.fromkeys(self.felt, 0.0)
        for account, chance in zip(self.accounts, self._chances(with_field), strict=True):
            for name in account.effects:
                chances[name] += chance
        return chances

    def listed(self, *, with_field: bool = False) -> list[Listed]:
        """Return the fewest accounts that hold LISTED of the weight, likeliest first, on the same
        condition.

        An account with more effects than a likelier account adds nothing that the marks ask for,
        so it counts with that one; but none counts with "nothing", which would hide it.
        """
        several = [account.effects for account in self.accounts]
        weights = self._weights(with_field)
        return [Listed(self.accounts[i], share) for i, share in listing(several, weights)]

    def possible(self, *, with_field: bool) -> list[Listed]:
        """Return the fewest accounts that hold LISTED of the weight, each with its own share of
        what all of them hold.
        """
        chances = self._chances(with_field)
        order = ranked(range(len(chances)), lambda i: -chances[i])[:MOST_LISTED]
        held = np.cumsum([chances[i] for i in order])
        kept = order[: 1 + int(np.count_nonzero(held < LISTED))]
        whole = sum(chances[i] for i in kept)
        return [Listed(self.accounts[i], chances[i] / whole) for i in kept]

    @property
    def likeliest_with_field(self) -> Effects:
        """Effects of the account that is likeliest where a field acts."""
        return self.accounts[greatest(self._weights(True))].effects

    def listed_nearest_first(self, nearest: Effects) -> list[Listed]:
        """Return the same where a smooth field acts, the account of some effects before all."""
        place = next(i for i, each in enumerate(self.accounts) if each.effects == nearest)
        first = Listed(self.accounts[place], self._chances(True)[place])
        others = self.listed(with_field=True)
        return [first, *(each for each in others if each.account != first.account)]

    def _weights(self, with_field: bool) -> Array:
        return np.array([each.field if with_field else each.clean for each in self.accounts])

    def _chances(self, with_field: bool) -> list[float]:
        weights = self._weights(with_field)
        chances: list[float] = np.exp(weights - np.logaddexp.reduce(weights)).tolist()
        return chances

    def weighing(self, effects: Effects) -> Posterior:
        """Return the same with the account of some effects weighed with a field too, as of large
        sets only few are.
        """
        known = (each for each in self.accounts if each.effects == effects)
        account = next(known, Account(effects, effects, -np.inf, -np.inf))
        if np.isfinite(account.field):
            return self
        at = explain_account(self.frame, effects, effects)
        field = self.with_fields.fields.weight_about(at, effects, self.noises)
        weighed = replace(account, field=field)
        others = [each for each in self.accounts if each.effects != effects]
        return replace(self, accounts=(*others, weighed))


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
        elif before < LISTED and len(effects) <= TOGETHER + len(EVERY_MACHINE):
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
    accounts = accounts_of(linear, TOGETHER if linear.measured <= FEWER else 2)
    middle, _ = noise_prior(stated)
    smooth = smooth_fields(frame, middle)
    noises = noises_of(linear, accounts, stated, smooth[1 :: len(FIELD_SPREADS)])
    clean = clean_of(linear, accounts, noises).on(0)
    clean = _refitted_sets(frame, felt, accounts, noises, clean)
    few = accounts.up_to(2)
    fields = Fields.of(frame, linear, noises, smooth)
    with_fields = weigh_fields(
        frame, linear, accounts, noises, fields, float(np.logaddexp.reduce(clean.total))
    )
    moves = moved_rounds(frame)
    moved = [
        weights_with(linear, few, noises, move.other) + np.log(MOVED / len(moves)) for move in moves
    ]
    readings = readings_of(board.rows)
    numbers = _numbers(readings, board, len(linear.read))
    return Posterior(
        frame=frame,
        felt=felt,
        accounts=_accounts(linear, accounts, clean, with_fields),
        moved=tuple(
            (move, float(np.logaddexp.reduce(weight, axis=None)))
            for move, weight in zip(moves, moved, strict=True)
        ),
        outliers=outlier_weights(linear, few, noises, numbers) + np.log(OUTLIER),
        turned=_turned(frame, linear, few, noises),
        noise=noise_by(
            noises.sigmas, np.logaddexp(clean.by_noise, with_fields.by_noise), stated, board.unit
        ),
        noises=noises,
        with_fields=with_fields,
    )


def _turned(
    frame: Explanation, board: LinearBoard, accounts: Accounts, noises: Noises
) -> float | None:
    """Return the log weight of all accounts if each mark is as far above as it is read below."""
    rows = frame.board.rows
    if not len(rows.measured):
        return None
    read = board.read.copy()
    read[1 : rows.measured.size : 2, 0] += 2 * (rows.targets - rows.measured)[:, 1]
    weights = _with_nothing(replace(board, read=read), accounts, noises)
    return float(np.logaddexp.reduce(weights) + np.log(TURNED))


def _with_nothing(board: LinearBoard, accounts: Accounts, noises: Noises) -> Array:
    weights = np.logaddexp.reduce(
        [
            weights_of(accounts, Metric.of(board, noises.sigmas, pitch=is_drifting), noises) + log
            for is_drifting, log in pitches(board)
        ]
    )
    return np.asarray(np.logaddexp.reduce(weights, axis=1))


def _numbers(readings: Sequence[Reading], board: Board, none: int) -> Array:
    """Rows (readings, 2) of each reading; `none` where it has a single number."""
    numbers = np.full((len(readings), 2), none)
    for row, reading in zip(numbers, readings, strict=True):
        row[: reading.size] = reading.numbers(board.rows)
    return numbers


def _accounts(
    board: LinearBoard, accounts: Accounts, clean: Clean, with_fields: WithFields
) -> tuple[Account, ...]:
    """Put sets together that ask for the same effects; a field may explain what they ask for of
    what every machine has.
    """
    by_field = _asked(board, accounts, with_fields.beside or clean, with_fields.total)
    by_clean = _asked(board, accounts, clean, clean.total)
    missing = ((), -np.inf)
    merged = [
        Account(
            effects,
            by_clean.get(effects, by_field.get(effects, missing))[0],
            by_clean.get(effects, missing)[1],
            by_field.get(effects, missing)[1],
        )
        for effects in {**by_clean, **by_field}
    ]
    return tuple(ranked(merged, lambda account: -account.clean))


def _asked(
    board: LinearBoard, accounts: Accounts, weighed: Clean, total: Array
) -> dict[Effects, tuple[Effects, float]]:
    """Return what sets ask for by these weights (sets,): the likeliest set behind it, and the log
    weight of all.
    """
    order = ascending(-total)
    order = order[np.isfinite(total[order])]
    asked = asked_for(board, accounts, weighed, order)
    several, weights = together(asked, total[order])
    likeliest = dict(zip(reversed(asked), reversed(order.tolist()), strict=True))
    return {
        effects: (accounts.effects[likeliest[effects]], weight)
        for effects, weight in zip(several, weights.tolist(), strict=True)
    }


def _refitted_sets(
    frame: Explanation, felt: Effects, accounts: Accounts, noises: Noises, clean: Clean
) -> Clean:
    """Return the weights with the likeliest sets made linear about the fit of each.

    Slopes at the frame's fit are good to a part of a nat for most sets; where the sled sticks, or
    an error is large, they are not.
    """
    total = clean.total.copy()
    order = [i for i in ascending(-total)[:REFITTED] if total[i] > total.max() - NEAR]
    for i in order:
        acting = accounts.effects[i]
        if not acting or len(acting) > TOGETHER:
            continue
        at = explain_account(frame, acting, acting)
        linear = LinearBoard.of(at, felt)
        only = accounts.among(np.arange(len(total)) == i)
        total[i] = _with_nothing(linear, only, noises)[i]
    shift = total - clean.total
    return replace(clean, total=total, nominal=clean.nominal + shift)
