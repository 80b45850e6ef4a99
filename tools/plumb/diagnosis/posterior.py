"""One posterior over all accounts of the marks: every answer of a diagnosis is a reading of it.

An account says which effects act, and whether beside them a reading is off, a round was moved, or
a smooth field acts that no effect draws. Accounts that ask for the same effects count together:
what every machine has is in each account, and is asked for only where the marks say that the
settings have it wrong.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np
import scipy

from plumb.diagnosis.evidence import (
    FEWER,
    Accounts,
    Effects,
    Fitted,
    Noises,
    Part,
    accounts_of,
    fitted,
    log_orthant,
    noises_of,
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
    rows_in_metric,
)
from plumb.diagnosis.noise import Noise, noise_by
from plumb.diagnosis.outliers import Reading, readings_of
from plumb.diagnosis.priors import (
    FIELD,
    MOVED,
    OUTLIER,
    OUTLIER_SPREADS,
    PITCH,
    PITCH_CHANCE,
    TOGETHER,
    TURNED,
    SizePriors,
    usual_checks,
)
from plumb.fit.inputs import Stated
from plumb.model.catalogue import EVERY_MACHINE
from plumb.model.plain import ascending

Array = np.ndarray
REFITTED = 8  # likeliest sets that are made linear about their own fit
NEAR = 7.0  # nats below the best within which they are
LISTED = 0.95  # of all weight that the listed accounts hold together
MOST_LISTED = 8


@dataclass(frozen=True)
class Account:
    """Effects that the marks ask for together."""

    effects: Effects  # first those that only some machines have
    acting: Effects  # effects of the likeliest set behind it, beyond what is usual
    clean: float  # log weight with nothing else
    field: float  # log weight with a smooth field beside


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

    @cached_property
    def clean(self) -> float:
        """Log weight of all accounts with nothing beside effects."""
        return float(np.logaddexp.reduce([account.clean for account in self.accounts]))

    @cached_property
    def _whole(self) -> float:
        fields = [account.field for account in self.accounts]
        moved = [weight for _, weight in self.moved]
        return float(np.logaddexp.reduce([self.clean, *fields, *moved, *self.outliers]))

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
        """How likely it is that no effect acts, if nothing else is wrong."""
        nothing = [account.clean for account in self.accounts if not account.effects]
        return float(np.exp(np.logaddexp.reduce(nothing) - self.clean)) if nothing else 0.0

    @property
    def effect_chances(self) -> Mapping[str, float]:
        """How likely each felt effect is asked for, if nothing else is wrong."""
        chances = dict.fromkeys(self.felt, 0.0)
        for account in self.accounts:
            for name in account.effects:
                chances[name] += float(np.exp(account.clean - self.clean))
        return chances

    def listed(self) -> list[Listed]:
        """Return the fewest accounts that hold LISTED of the weight, likeliest first.

        An account with more effects than a likelier account adds nothing that the marks ask for,
        so it counts with that one; but none counts with "nothing", which would hide it.
        """
        return listing(self.accounts, np.array([account.clean for account in self.accounts]))

    def listed_with_field(self) -> list[Listed]:
        """Return the same where a smooth field acts too."""
        return listing(self.accounts, np.array([account.field for account in self.accounts]))


def listing(accounts: Sequence[Account], weights: Array) -> list[Listed]:
    """Return the same for other log weights (accounts,) of accounts."""
    chances = np.exp(weights - np.logaddexp.reduce(weights))
    kept: dict[int, float] = {}
    before = 0.0
    for i in ascending(-weights):
        own = {*accounts[i].effects}
        base = next((j for j in kept if accounts[j].effects and {*accounts[j].effects} < own), None)
        if base is None and (before >= LISTED or len(own) > TOGETHER + len(EVERY_MACHINE)):
            continue
        kept[base if base is not None else int(i)] = kept.get(i if base is None else base, 0.0) + (
            float(chances[i])
        )
        before += float(chances[i])
    order = sorted(kept, key=lambda i: -kept[i])
    held = np.cumsum([kept[i] for i in order]) - np.array([kept[i] for i in order])
    return [
        Listed(accounts[i], kept[i])
        for i, so_far in zip(order[:MOST_LISTED], held, strict=False)
        if so_far < LISTED
    ]


def posterior_of(board: Board, stated: Stated | None) -> Posterior:
    """Weigh all accounts of a board."""
    frame = explain(board)
    felt = felt_effects(frame)
    linear = LinearBoard.of(frame, felt)
    accounts = accounts_of(linear, TOGETHER if linear.measured <= FEWER else 2)
    noises = noises_of(linear, accounts, stated)
    clean = clean_of(linear, accounts, noises).on(0)
    clean = _refitted(frame, felt, accounts, noises, clean)
    few = accounts.up_to(2)
    sigma = float(noises.sigmas[np.argmax(clean.by_noise)])
    field, noise_of_field = _with_others(linear, few, noises, fields(frame, sigma), FIELD)
    moves = moved_rounds(frame)
    moved = [
        _with_others(linear, few, noises, [move.other], MOVED / len(moves))[0] for move in moves
    ]
    readings = readings_of(board.rows)
    numbers = _numbers(readings, board, len(linear.read))
    return Posterior(
        frame=frame,
        felt=felt,
        accounts=_accounts(linear, accounts, clean, field),
        moved=tuple(
            (move, float(np.logaddexp.reduce(weight)))
            for move, weight in zip(moves, moved, strict=True)
        ),
        outliers=outlier_weights(linear, few, noises, numbers) + np.log(OUTLIER),
        turned=_turned(frame, linear, few, noises),
        noise=noise_by(noises.sigmas, np.logaddexp(clean.by_noise, noise_of_field), stated),
        noises=noises,
    )


def felt_effects(frame: Explanation) -> Effects:
    """Effects that change any of the measured numbers."""
    board = frame.board
    return tuple(
        name for name in board.effect_columns if np.any(frame.slopes[:, board.columns([name])])
    )


def _with_others(
    board: LinearBoard, accounts: Accounts, noises: Noises, others: Sequence[Other], chance: float
) -> tuple[Array, Array]:
    """Return the log weights (sets,) with one of some other things beside the effects, and the same
    by noises (m,).
    """
    weights = [
        weights_of(accounts, Metric.of(board, noises.sigmas, other, pitch=is_drifting), noises)
        + (log + np.log(chance / len(others)))
        for other in others
        for is_drifting, log in _pitches(board)
    ]
    together = np.logaddexp.reduce(weights)
    return np.logaddexp.reduce(together, axis=1), np.logaddexp.reduce(together, axis=0)


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
            for is_drifting, log in _pitches(board)
        ],
    )
    return np.asarray(np.logaddexp.reduce(weights, axis=1))


def _numbers(readings: Sequence[Reading], board: Board, none: int) -> Array:
    """Rows (readings, 2) of each reading; `none` where it has a single number."""
    numbers = np.full((len(readings), 2), none)
    for row, reading in zip(numbers, readings, strict=True):
        row[: reading.size] = reading.numbers(board.rows)
    return numbers


def _accounts(
    board: LinearBoard, accounts: Accounts, clean: Clean, field: Array
) -> tuple[Account, ...]:
    """Put sets together that ask for the same effects."""
    order = ascending(-clean.total)
    together: dict[Effects, Account] = {}
    for i, asked in zip(order, asked_for(board, accounts, clean, order), strict=True):
        known = together.get(asked)
        if known is None:
            here = float(clean.total[i]), float(field[i])
            together[asked] = Account(asked, accounts.effects[i], *here)
        else:
            together[asked] = replace(
                known,
                clean=float(np.logaddexp(known.clean, clean.total[i])),
                field=float(np.logaddexp(known.field, field[i])),
            )
    return tuple(sorted(together.values(), key=lambda account: -account.clean))


def _refitted(
    frame: Explanation, felt: Effects, accounts: Accounts, noises: Noises, clean: Clean
) -> Clean:
    """Return the weights with the likeliest sets made linear about their own fit.

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


def explain_account(frame: Explanation, asked: Effects, acting: Effects) -> Explanation:
    """Refit the frame and the effects of an account; what every machine has and the settings leave
    out too, held near what is usual where it does not act beyond that.
    """
    board = frame.board
    left_out = [
        name
        for name in EVERY_MACHINE
        if name not in asked and not board.problem.start[board.columns([name])].any()
    ]
    effects = (*asked, *left_out)
    usual = usual_checks(board, [name for name in effects if name not in acting])
    return explain(board.with_usual(usual), effects, start=frame)


# Clean accounts: which sets are likely, and what every machine has that they ask for.

ONE_IN = 20.0  # times less likely after the marks than before: then what the settings say is wrong


@dataclass(frozen=True)
class Clean:
    """Log evidences (sets, boards) of all sets with nothing beside them, and what hangs on them."""

    total: Array
    nominal: Array  # without what chains usually are longer or shorter
    at_settings: dict[int, Array]  # of each usual number: log ratio of its densities, after to
    # before the marks, where the settings have it
    by_noise: Array  # (m,) of the first board

    def on(self, board: int) -> Clean:
        """Return the same of one board, as arrays (sets,)."""
        ratios = {column: each[:, board] for column, each in self.at_settings.items()}
        return Clean(self.total[:, board], self.nominal[:, board], ratios, self.by_noise)


def clean_of(board: LinearBoard, accounts: Accounts, noises: Noises) -> Clean:
    """Weigh all sets, with nominal chains and with chains as makers sell them."""
    usual = [int(column) for column in np.flatnonzero(board.sizes.usual)]
    shape = (len(accounts.effects), board.read.shape[1])
    by_pitch, density = [], {column: np.full(shape, -np.inf) for column in usual}
    by_noise = np.full(len(noises.sigmas), -np.inf)
    for is_drifting, log_chance in _pitches(board):
        total = np.full(shape, -np.inf)
        metric = Metric.of(board, noises.sigmas, pitch=is_drifting)
        for part in accounts.parts:
            fit = fitted(part, board.sizes, metric)
            weight = _by_noise(fit.evidence, part) + noises.log_prior + log_chance
            np.logaddexp.at(total, part.sets, np.logaddexp.reduce(weight, axis=2).T)
            by_noise = np.logaddexp(by_noise, np.logaddexp.reduce(weight[0], axis=0))
            for column in usual:
                there = weight + _by_noise(_density_at_settings(board, part, fit, column), part)
                np.logaddexp.at(density[column], part.sets, np.logaddexp.reduce(there, axis=2).T)
        by_pitch.append(total)
    whole = np.logaddexp.reduce(by_pitch)
    at_settings = {
        column: each - whole - _prior_at_settings(board, column) for column, each in density.items()
    }
    return Clean(whole, by_pitch[0], at_settings, by_noise)


def _by_noise(values: Array, part: Part) -> Array:
    """Return values (boards, a * m) as (boards, a, m)."""
    return values.reshape(len(values), len(part.sets), -1)


def _pitches(board: LinearBoard) -> list[tuple[bool, float]]:
    """Return whether chains are as makers sell them, with the logarithm of its chance."""
    if not board.sizes.pitch.any():
        return [(False, 0.0)]
    return [(False, float(np.log(1 - PITCH_CHANCE))), (True, float(np.log(PITCH_CHANCE)))]


def _density_at_settings(board: LinearBoard, part: Part, fit: Fitted, column: int) -> Array:
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
    every = {
        name: clean.at_settings[int(column)]
        for name, columns in board.columns.items()
        for column in columns
        if int(column) in clean.at_settings
    }
    has_pitch = bool(board.sizes.pitch.any())
    drifts = clean.nominal - clean.total < -np.log(ONE_IN + 1)
    return [
        (
            *(name for name in accounts.effects[i] if name not in every),
            *([PITCH] if has_pitch and drifts[i] and PITCH not in accounts.effects[i] else []),
            *(name for name, ratio in every.items() if ratio[i] < -np.log(ONE_IN)),
        )
        for i in sets
    ]


# Readings that are off.


def outlier_weights(
    board: LinearBoard, accounts: Accounts, noises: Noises, numbers: Array
) -> Array:
    """Return the log evidence (readings,) of accounts with this reading off; numbers (readings, 2)
    are the rows of each, the second beyond all rows where it has a single number.
    """
    board, noises = _with_usual_pitch(board), noises.sparse
    exists = numbers < len(board.read)
    weights = np.full(len(numbers), -np.inf)
    for sigma, log_prior in zip(noises.sigmas, noises.log_prior, strict=True):
        rows, root = rows_in_metric(board, sigma)
        rows = np.vstack([rows, np.zeros((1, rows.shape[1]))])[numbers]
        root = np.vstack([root, np.zeros((1, root.shape[1]))])[numbers]
        kept = -np.einsum("rif,rjf->rij", root, root)
        inside = np.r_[np.full(board.measured, sigma**-2), np.zeros(len(board.read))]
        kept[:, [0, 1], [0, 1]] += np.where(exists, inside[numbers], 0.0)
        metric = Metric.of(board, np.array([sigma]))
        for part in accounts.parts:
            off = _off(part, board.sizes, fitted(part, board.sizes, metric), rows, kept)
            weights = np.logaddexp(weights, log_prior + off)
    return weights - np.log(len(numbers) * len(OUTLIER_SPREADS))


def _with_usual_pitch(board: LinearBoard) -> LinearBoard:
    """Return the board whose frame has chains as makers sell them."""
    drifting = np.flatnonzero(board.sizes.pitch)
    columns = board.effects[:, drifting] * board.sizes.pitch[drifting]
    return replace(board, frame=np.hstack([board.frame, columns]))


def _off(part: Part, sizes: SizePriors, fit: Fitted, rows: Array, kept: Array) -> Array:
    """Return the log evidence (readings,) of a part's accounts with each reading off.

    rows (readings, 2, p + 1) are those of C^-1 [effects, readings], kept (readings, 2, 2) those of
    C^-1 itself. A shift o of spread l changes the evidence by the determinant and the pull of a
    matrix of two by two.
    """
    drawn = np.moveaxis(rows[:, :, part.index], (2, 3), (0, 1))  # (a, k, readings, 2)
    taken = np.einsum("kla,alri->akri", fit.inverse, drawn, optimize=True)
    inside = kept - np.einsum("akri,akrj->arij", drawn, taken, optimize=True)
    pull = rows[:, :, -1] - np.einsum("ka,akri->ari", fit.mean[:, 0], drawn, optimize=True)
    edge = (sizes.mean - sizes.least)[part.index]
    before = np.sum(scipy.special.log_ndtr(edge / np.sqrt(part.variance)), axis=1)
    weights = []
    for spread in OUTLIER_SPREADS:
        a, b, c = (inside[..., i, j] + (i == j) * spread**-2 for i, j in ((0, 0), (0, 1), (1, 1)))
        size = a * c - b**2
        x, y = (
            (c * pull[..., 0] - b * pull[..., 1]) / size,
            (a * pull[..., 1] - b * pull[..., 0]) / size,
        )
        gain = (x * pull[..., 0] + y * pull[..., 1]) / 2 - np.log(size) / 2 - 2 * np.log(spread)
        moved = taken[..., 0] * x[:, np.newaxis] + taken[..., 1] * y[:, np.newaxis]
        mean = fit.mean[:, :1] - np.moveaxis(moved, 0, 2)
        possible = log_orthant(mean + edge.T[:, np.newaxis], fit.inverse) - before
        weights.append(np.logaddexp.reduce(fit.loose.T + gain + possible.T, axis=0))
    return np.asarray(np.logaddexp.reduce(weights))
