"""The evidence of accounts: how likely the readings are by each set of effects, over all sizes.

An account says which effects act (none, sets of a few, or all), and whether a reading
is off, a round was moved, or a smooth field acts that no effect draws. Its evidence is the density
of the readings over all sizes, frames and noises that its priors allow. Sizes are normals whose
densities Laplace's method gives in closed form, because the board is linear; what cannot be
negative takes the ratio of the posterior's to the prior's mass where it is not.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, replace
from functools import cache, cached_property
from itertools import combinations, compress, product

import numpy as np
import scipy

from plumb.diagnosis.explanation import (
    Board,
    Explanation,
    beyond,
    explain,
    gaussian_process_columns,
    span,
)
from plumb.diagnosis.priors import (
    ALL,
    FIELD_SPREADS,
    FIELD_WIDTHS,
    NOISE_DEGREES,
    OUTLIER_SPREADS,
    PITCH,
    PITCH_CHANCE,
    ROUND_SPREAD,
    TOGETHER,
    SizePriors,
    chance_of,
    noise_prior,
    size_priors,
    turned,
    usual_checks,
    zero_checks,
)
from plumb.fit.inputs import Stated
from plumb.fit.observations import Observations
from plumb.model.catalogue import EVERY_MACHINE, ZEROING_NAMES
from plumb.text.errors import to_do
from plumb.text.values import Unit

# A board made linear about a fit, and what is left of it once noise and frame are allowed for.
#
# What is measured is then a sum of normals: noise, the frame within its priors, effects, and
# perhaps a smooth field or a round that moved. With Z = [frame, effects, readings] as columns, all
# that any account needs is the Gram matrix Z' C^-1 Z, where C holds noise and field. The frame is
# integrated out by a Schur complement. A field is written in few orthonormal columns U with
# variances l, so Woodbury's identity gives C^-1 for each noise s and each field without another
# factorization:
#
# C^-1 = (1 - U diag(l / (s^2 + l)) U') / s^2


ROUNDING = 1e-9  # [mm] less than that moves nothing
LEFT_OUT = 1e-3  # share of the noise's variance to which a field is described


@dataclass(frozen=True)
class LinearBoard:
    """Readings and slopes about a fit. Measured numbers come first, then direct checks.

    Rows of measured numbers are in mm, those of checks in their standard deviations; effects are
    in typical sizes (pitches as `turned` has them), the frame in standard deviations of its priors.
    """

    measured: int  # rows of measured numbers
    frame: Array  # (n, f)
    effects: Array  # (n, p)
    read: Array  # (n, boards) less what the settings predict with usual sizes
    columns: dict[str, Array]  # of each effect that is felt, among the p
    sizes: SizePriors

    @staticmethod
    def of(at: Explanation, felt: Sequence[str]) -> LinearBoard:
        """Make the board of an explanation linear about its fit, with the effects that are felt."""
        board = at.board
        count, held = board.rows.count, int(board.problem.held.sum())
        kept = np.r_[0:count, count + held : len(at.residual) - board.usual]
        slopes = _unwhitened(at.slopes[kept], count, board.sigma)
        read = at.residual[kept] + at.slopes[kept] @ at.unknowns
        columns = board.columns(felt)
        sizes = size_priors(board, columns)
        read = _unwhitened(read[:, np.newaxis], count, board.sigma)
        starts = np.cumsum([0, *(len(board.columns([name])) for name in felt)])
        return LinearBoard(
            measured=count,
            frame=slopes[:, board.frame],
            effects=turned(board, columns, slopes[:, columns]),
            read=read - slopes[:, columns] @ sizes.mean[:, np.newaxis],
            columns={
                name: np.arange(low, high)
                for name, low, high in zip(felt, starts[:-1], starts[1:], strict=True)
            },
            sizes=sizes,
        )


def _unwhitened(rows: Array, measured: int, sigma: float) -> Array:
    return np.vstack([rows[:measured] * sigma, rows[measured:]])


# What else may move readings: a smooth field, and a round that was moved.


@dataclass(frozen=True)
class Disturbance:
    """Something that moves the measured numbers as independent normals do."""

    axes: Array  # (n, r) orthonormal
    variances: Array  # (r,) [mm^2]

    @staticmethod
    def of(columns: Array) -> Disturbance:
        """Return what columns (n, c) [mm] of independent normals move."""
        left, sizes, _ = np.linalg.svd(columns, full_matrices=False)
        seen = sizes > 1e-6 * max(sizes.max(initial=0.0), 1e-9)
        return Disturbance(left[:, seen], sizes[seen] ** 2)

    def times(self, length: float) -> Disturbance:
        """Return the same, larger by a factor."""
        return replace(self, variances=self.variances * length**2)


def smooth_fields(frame: Explanation, sigma: float) -> list[Disturbance]:
    """Return smooth fields that no effect draws, of all usual widths and spreads; sigma [mm]."""
    least = LEFT_OUT * sigma**2 / max(FIELD_SPREADS) ** 2
    return [
        unit.times(spread)
        for columns in gaussian_process_columns(frame, FIELD_WIDTHS, least)
        for unit in [Disturbance.of(columns)]
        for spread in FIELD_SPREADS
    ]


@dataclass(frozen=True, eq=False)
class MovedRound:
    """A later round that does not go with the others, and what would make it so."""

    number: int
    cause: str  # "new_sheet", "chains_rezeroed", or "" for another machine
    other: Disturbance


def moved_rounds(frame: Explanation) -> list[MovedRound]:
    """Return how each later round may have been moved; none if all marks are of one round."""
    board, rows = frame.board, frame.board.rows
    number = np.concatenate([np.repeat(rows.rounds[rows.mark_rows], 2), rows.distance_rounds])
    slopes = frame.slopes[: rows.count] * board.sigma
    by_cause = _causes_of_moves(board, slopes)
    return [
        MovedRound(int(later), cause, Disturbance.of(columns[:, moved] * mine[:, np.newaxis]))
        for later in np.unique(number)[1:]
        for mine in [number == later]
        for cause, columns in by_cause.items()
        for moved in [np.any(np.abs(columns[mine]) > ROUNDING, axis=0)]
        if moved.any()
    ]


def _causes_of_moves(board: Board, slopes: Array) -> dict[str, Array]:
    """Columns (n, c) [mm] of what may change from one round to the next."""
    names, scale, marks = board.problem.names, board.problem.scale, board.rows.measured.size
    shifts = np.zeros((len(slopes), 2))
    for axis in (0, 1):
        shifts[axis:marks:2, axis] = ROUND_SPREAD
    zeros = [names.index(name) for name in ZEROING_NAMES]
    hung = slopes[:, zeros] * ROUND_SPREAD / scale[zeros]
    turned = slopes[:, [i for i in board.frame if names[i] == "sheet_rotation"]]
    everything = np.hstack([shifts, hung, slopes[:, board.frame]])
    return {"new_sheet": np.hstack([shifts, turned]), "chains_rezeroed": hung, "": everything}


# Gram matrices of readings and effects, for each noise, with the frame integrated out.


@dataclass(frozen=True)
class Metric:
    """Distances between readings: for each of m noises, with noise, frame and one other thing."""

    sigmas: Array  # (m,) [mm] of the noise
    gram: Array  # (m, p, p) of the effects
    along: Array  # (m, p, boards) of effects and readings
    square: Array  # (m, boards) of the readings
    log_determinant: Array  # (m,) of the covariance of the readings

    @staticmethod
    def of(
        board: LinearBoard, sigmas: Array, other: Disturbance | None = None, *, pitch: bool = False
    ) -> Metric:
        """Return the metrics for noises (m,) [mm]; `pitch`: with chains as makers sell them."""
        columns = np.hstack([board.frame, board.effects, board.read])
        inside, beyond = np.split(columns, [board.measured])
        precision = 1 / sigmas**2
        whole = precision[:, np.newaxis, np.newaxis] * (inside.T @ inside) + beyond.T @ beyond
        log_determinant = board.measured * 2 * np.log(sigmas)
        if other is not None:
            seen = other.axes.T @ inside
            taken = other.variances / (sigmas[:, np.newaxis] ** 2 + other.variances)
            weights = precision[:, np.newaxis] * taken
            whole = whole - np.einsum("ri,mr,rj->mij", seen, weights, seen, optimize=True)
            log_determinant = log_determinant - np.sum(np.log1p(-taken), axis=1)
        return _without_frame(board, sigmas, whole, log_determinant, pitch=pitch)


def _without_frame(
    board: LinearBoard, sigmas: Array, whole: Array, log_determinant: Array, *, pitch: bool
) -> Metric:
    """Integrate the frame out of Gram matrices (m, z, z), and usual pitch if asked."""
    frame, effects = board.frame.shape[1], board.effects.shape[1]
    drifting = np.flatnonzero(board.sizes.pitch) if pitch else np.zeros(0, dtype=int)
    loose = np.concatenate([np.arange(frame), frame + drifting])
    spread = np.concatenate([np.ones(frame), board.sizes.pitch[drifting]])
    kept = np.arange(frame, whole.shape[1])
    inner = whole[:, loose[:, np.newaxis], loose] * np.outer(spread, spread) + np.eye(len(loose))
    mixed = whole[:, loose[:, np.newaxis], kept] * spread[:, np.newaxis]
    rest = whole[:, frame:, frame:] - np.swapaxes(mixed, 1, 2) @ np.linalg.solve(inner, mixed)
    return Metric(
        sigmas=sigmas,
        gram=rest[:, :effects, :effects],
        along=rest[:, :effects, effects:],
        square=np.diagonal(rest[:, effects:, effects:], axis1=1, axis2=2),
        log_determinant=log_determinant + np.linalg.slogdet(inner)[1],
    )


def rows_in_metric(board: LinearBoard, sigma: float) -> tuple[Array, Array]:
    """Return C^-1 [effects, first readings] (n, p + 1), and C^-1 among the two numbers of each
    mark or the number of each distance, with noise and frame in C.
    """
    weight = np.r_[
        np.full(board.measured, 1 / sigma**2), np.ones(len(board.frame) - board.measured)
    ]
    weighted = weight[:, np.newaxis] * board.frame
    inner = np.eye(board.frame.shape[1]) + board.frame.T @ weighted
    root = np.linalg.solve(np.linalg.cholesky(inner), weighted.T).T
    drawn = np.hstack([board.effects, board.read[:, :1]])
    return weight[:, np.newaxis] * drawn - root @ (root.T @ drawn), root


# The evidence of each account.

Array = np.ndarray
Effects = tuple[str, ...]
FEWER = 150  # measured numbers beyond which sets of three are left out, for time


@dataclass(frozen=True)
class AccountGroup:
    """Variants of accounts with as many unknowns: a set of effects, each of a spread."""

    sets: Array  # (a,) which set each variant belongs to; they rise
    index: Array  # (a, k) columns of its effects
    variance: Array  # (a, k) of the prior
    edge: Array  # (a, k) how far the mean of the prior is above the least
    log_prior: Array  # (a,)

    @cached_property
    def log_possible(self) -> Array:
        """Logarithm of the mass (a,) that the prior has where it is possible."""
        deviations = self.edge / np.sqrt(self.variance)
        mass: Array = np.sum(scipy.special.log_ndtr(deviations), axis=1)
        return mass

    @cached_property
    def starts(self) -> Array:
        """The first variant of each set."""
        return np.flatnonzero(np.diff(self.sets, prepend=-1))

    def among(self, kept: Array) -> AccountGroup:
        """Return some of the variants (a,)."""
        each = (self.sets, self.index, self.variance, self.edge, self.log_prior)
        return AccountGroup(*(values[kept] for values in each))


@dataclass(frozen=True)
class Accounts:
    """Sets of effects that may act, with all spreads of their sizes."""

    effects: tuple[Effects, ...]
    parts: tuple[AccountGroup, ...]

    def up_to(self, most: int) -> Accounts:
        """Return the accounts of at most `most` effects."""
        return self.among(np.array([len(names) <= most for names in self.effects]))

    def among(self, wanted: Array) -> Accounts:
        """Return the accounts of some sets (sets,)."""
        parts = (part.among(wanted[part.sets]) for part in self.parts)
        return Accounts(self.effects, tuple(part for part in parts if len(part.sets)))


ABSENT, TYPICAL, LARGEST = range(3)  # how an effect is spread in a variant


def accounts_of(board: LinearBoard, most: int = TOGETHER) -> Accounts:
    """Return all accounts of a board: sets of up to `most` effects, and all effects at once. Each
    effect of a set is of a typical size or as large as any that was met; all at once are large.
    """
    names, sizes = tuple(board.columns), board.sizes
    sets = [
        chosen for size in range(min(most, len(names)) + 1) for chosen in combinations(names, size)
    ]
    spreads = np.vstack([_spreads(chosen, names) for chosen in sets])
    numbers = np.repeat(np.arange(len(sets)), [2 ** len(chosen) for chosen in sets])
    odds = np.log([chance_of(name) / (1 - chance_of(name)) / 2 for name in names])
    log_prior = (spreads != ABSENT) @ odds
    if len(names) > most:
        spreads = np.vstack([spreads, np.full(len(names), LARGEST)])
        numbers, log_prior = np.r_[numbers, len(sets)], np.r_[log_prior, np.log(ALL)]
        sets.append(names)
    of_column = np.repeat(spreads, [len(columns) for columns in board.columns.values()], axis=1)
    more = np.stack([np.zeros(of_column.shape[1]), sizes.typical**2, sizes.largest**2])
    variance = sizes.usual**2 + np.take_along_axis(more, of_column, axis=0)
    counts = np.count_nonzero(variance, axis=1)
    parts = []
    for count in np.unique(counts):
        kept = counts == count
        index = np.nonzero(variance[kept])[1].reshape(-1, count)
        mine = np.take_along_axis(variance[kept], index, axis=1)
        edge = (sizes.mean - sizes.least)[index]
        parts.append(AccountGroup(numbers[kept], index, mine, edge, log_prior[kept]))
    return Accounts(tuple(sets), tuple(parts))


def _spreads(chosen: Effects, names: Effects) -> Array:
    """Return in all ways how each effect is spread (ways, effects) in a set."""
    ways = np.array(list(product((TYPICAL, LARGEST), repeat=len(chosen))), dtype=int)
    spreads = np.full((len(ways), len(names)), ABSENT)
    spreads[:, [names.index(name) for name in chosen]] = ways
    return spreads


# The evidence of each variant, for all noises and boards of a metric at once.


@dataclass(frozen=True)
class Fitted:
    """The variants of a part, fitted with each of m noises to each of some boards."""

    loose: Array  # (boards, a * m) logarithm of the evidence as if any sign were possible
    possible: Array  # (boards, a * m) what impossible signs change in it
    mean: Array  # (k, boards, a * m) of the sizes, in typical sizes off `SizePriors.mean`
    inverse: Array  # (k, k, a * m) their covariance, as if any sign were possible

    @property
    def evidence(self) -> Array:
        """Logarithm of the evidence (boards, a * m), with the prior of the variant."""
        evidence: Array = self.loose + self.possible
        return evidence


def fitted(part: AccountGroup, metric: Metric) -> Fitted:
    """Fit all variants of a part."""
    index, noises = part.index.T, len(metric.sigmas)
    k, count = index.shape
    gram, along = metric.gram.transpose(1, 2, 0), metric.along.transpose(1, 2, 0)
    matrix = gram[index[:, np.newaxis], index].reshape(k, k, count * noises)
    along = np.swapaxes(along[index], 1, 2).reshape(k, -1, count * noises)
    across = np.repeat(part.variance.T, noises, axis=1)
    matrix[np.arange(k), np.arange(k)] += 1 / across
    inverse, log_determinant = _inverted(matrix)
    mean = np.einsum("ija,jba->iba", inverse, along)
    explained = np.sum(along * mean, axis=0)
    left = np.tile(metric.square.T, count) - explained
    size = np.tile(metric.log_determinant, count) + log_determinant + np.log(across).sum(axis=0)
    loose = np.repeat(part.log_prior, noises) - (size + left) / 2
    edges = np.repeat(part.edge.T, noises, axis=1)

    def mass(boards: Array, each: Array) -> Array:
        return log_orthant(mean[:, boards, each] + edges[:, each], inverse, each)

    possible = _with_mass(loose, mass, axis=1) - loose
    return Fitted(loose, possible - np.repeat(part.log_possible, noises), mean, inverse)


def _with_mass(loose: Array, mass: Callable[..., Array], *, axis: int) -> Array:
    """Return log weights with the logarithm of the mass that is possible, where that matters.

    Mass is at most one, so what lies UNLIKELY below the best without it stays there.
    """
    weight, known = loose.copy(), np.zeros(loose.shape, dtype=bool)
    while True:
        likely = ~known & (weight > weight.max(axis=axis, keepdims=True) - UNLIKELY)
        if not likely.any():
            return weight
        places = np.nonzero(likely)
        weight[places] += mass(*places)
        known |= likely


def _inverted(matrix: Array) -> tuple[Array, Array]:
    """Return the inverses of positive matrices (k, k, b), and the logarithms of their determinants.

    Gauss and Jordan's elimination, a pivot for all matrices at once.
    """
    inverse, log_determinant = matrix.copy(), np.zeros(matrix.shape[2])
    for i in range(len(inverse)):
        pivot = inverse[i, i].copy()
        log_determinant += np.log(pivot)
        inverse[i, i] = 1.0
        row = inverse[i] / pivot
        column = inverse[:, i].copy()
        column[i] = 0.0
        inverse[:, i] = 0.0
        inverse[i] = row
        for j in range(len(inverse)):
            if j != i:
                inverse[j] -= column[j] * row
    return inverse, log_determinant


UNLIKELY = 8.0  # nats below the best of as many unknowns
FAR = 5.0  # deviations above zero from which a number counts as surely positive


def log_orthant(mean: Array, covariance: Array, each: Array | None = None) -> Array:
    """Return the logarithm of the mass (b,) that normals have where nothing is negative.

    mean (k, b), infinite where either sign is possible; covariance (k, k, c), of which each (b,) is
    that of each normal. One number after the other is taken to be positive, the least likely first,
    and what that says of the others is kept as a normal again (Mendell and Elston 1974).
    """
    each = np.arange(mean.shape[1]) if each is None else each
    deviations = np.sqrt(np.diagonal(covariance)).T[:, each]
    bounded = np.flatnonzero(~(FAR * deviations < mean).all(axis=1))
    mean = np.where(np.isfinite(mean), mean, 1e6)[bounded]
    order = np.argsort(mean / deviations[bounded], axis=0)
    mean = np.take_along_axis(mean, order, axis=0)
    order = bounded[order]
    # Above the diagonal, where it is read.
    spread = [covariance[row, order[i:], each] for i, row in enumerate(order)]
    mass = np.zeros(mean.shape[1])
    for i, rows in enumerate(spread):
        deviation = np.sqrt(rows[0])
        at = mean[i] / deviation
        log_mass = scipy.special.log_ndtr(at)
        mass += log_mass
        pull = np.exp(-0.5 * at**2 - 0.5 * np.log(2 * np.pi) - log_mass)
        less = pull * (pull + at)
        shares = rows[1:] / deviation
        mean[i + 1 :] += shares * pull
        for j, share in enumerate(shares):
            spread[i + 1 + j] -= less * share * shares[j:]
    return mass


# The noises that are worth a look, and the evidence of sets of effects over all of them.

NOISE_STEP = 0.3  # of the logarithm of the noise, at most
NOISE_REACH = 5.0  # spreads of its prior to both sides
NEGLIGIBLE = 6.0  # nats below the best: what is less likely is not looked at


@dataclass(frozen=True)
class Noises:
    """Standard deviations of a reading, and the logarithms of their priors."""

    sigmas: Array  # (m,) [mm]
    log_prior: Array  # (m,)


def noises_of(
    board: LinearBoard,
    accounts: Accounts,
    stated: Stated | None,
    fields: Sequence[Disturbance] = (),
) -> Noises:
    """Return the noises that some account finds likely, by single effects and all at once; with
    one of these fields too, for what a field draws is no noise.
    """
    middle, spread = noise_prior(stated)
    if not spread:
        return Noises(np.array([middle]), np.zeros(1))
    # n numbers leave a spread of 1 / sqrt(2 n). A sum of a normal's density in steps of two spreads
    # is off by 1.4 % (Poisson's summation formula).
    step = float(min(np.sqrt(2 / max(board.measured, 1)), NOISE_STEP))
    off = np.arange(-NOISE_REACH * spread, NOISE_REACH * spread + step, step)
    half = (NOISE_DEGREES + 1) / 2
    log_prior = -half * np.log1p((off / spread) ** 2 / NOISE_DEGREES)
    log_prior -= np.logaddexp.reduce(log_prior)
    every = Noises(middle * np.exp(off), log_prior)
    few = accounts.among(
        np.array([len(names) < 2 or len(names) > TOGETHER for names in accounts.effects])
    )
    best = [
        np.max([weight.max(axis=0) for _, weight in variants(few, metric, every)], axis=0)
        for metric in (Metric.of(board, every.sigmas, other) for other in (None, *fields))
    ]
    clean, others = best[0], np.max(best, axis=0)
    likely = (clean > clean.max() - NEGLIGIBLE) | (others > others.max() - NEGLIGIBLE)
    return Noises(every.sigmas[likely], every.log_prior[likely])


def variants(
    accounts: Accounts, metric: Metric, noises: Noises
) -> Iterable[tuple[AccountGroup, Array]]:
    """Yield each part with the log evidence (a, m) of its variants, first board."""
    for part in accounts.parts:
        evidence = fitted(part, metric).evidence[0]
        yield part, evidence.reshape(len(part.sets), -1) + noises.log_prior


def weights_of(accounts: Accounts, metric: Metric, noises: Noises) -> Array:
    """Return the log evidence (sets, m) of each set; -inf for sets without an account here."""
    total = np.full((len(accounts.effects), len(noises.sigmas)), -np.inf)
    for part, weight in variants(accounts, metric, noises):
        add_by_set(total, part, weight)
    return total


def add_by_set(total: Array, part: AccountGroup, weight: Array) -> None:
    """Add the log weights (a, ...) of a part's variants to those (sets, ...) of their sets."""
    sets = part.sets[part.starts]
    total[sets] = np.logaddexp(total[sets], np.logaddexp.reduceat(weight, part.starts, axis=0))


# Readings that are off.


@dataclass(frozen=True)
class Reading:
    """A reading: a mark's place or a distance, by its index among its kind."""

    index: int
    is_mark: bool

    @property
    def size(self) -> int:
        """The number of numbers that were read."""
        return 2 if self.is_mark else 1

    def numbers(self, rows: Observations) -> Array:
        """Return its entries among all measured numbers."""
        if self.is_mark:
            return np.array([2 * self.index, 2 * self.index + 1])
        return np.array([rows.measured.size + self.index])

    def place(self, rows: Observations) -> int:
        """Return its place among all readings."""
        return self.index if self.is_mark else len(rows.measured) + self.index


def readings_of(rows: Observations) -> list[Reading]:
    """Return all readings."""
    marks = [Reading(i, True) for i in range(len(rows.measured))]
    return marks + [Reading(i, False) for i in range(len(rows.distances))]


def outlier_weights(
    board: LinearBoard, accounts: Accounts, noises: Noises, numbers: Array
) -> Array:
    """Return the log evidence (readings,) of accounts with this reading off; numbers (readings, 2)
    are the rows of each, the second beyond all rows where it has a single number.
    """
    board = _with_usual_pitch(board)
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
            off = _off(part, fitted(part, metric), rows, kept)
            weights = np.logaddexp(weights, log_prior + off)
    together: Array = weights - np.log(len(numbers) * len(OUTLIER_SPREADS))
    return together


def _with_usual_pitch(board: LinearBoard) -> LinearBoard:
    """Return the board whose frame has chains as makers sell them."""
    drifting = np.flatnonzero(board.sizes.pitch)
    columns = board.effects[:, drifting] * board.sizes.pitch[drifting]
    return replace(board, frame=np.hstack([board.frame, columns]))


def _off(part: AccountGroup, fit: Fitted, rows: Array, kept: Array) -> Array:
    """Return the log evidence (readings,) of a part's accounts with each reading off.

    rows (readings, 2, p + 1) are those of C^-1 [effects, readings], kept (readings, 2, 2) those of
    C^-1 itself. A shift o of spread l changes the evidence by the determinant and the pull of a
    matrix of two by two.
    """
    drawn = np.moveaxis(rows[:, :, part.index], (2, 3), (0, 1))  # (a, k, readings, 2)
    taken = np.einsum("kla,alri->akri", fit.inverse, drawn, optimize=True)
    inside = kept - np.einsum("akri,akrj->arij", drawn, taken, optimize=True)
    pull = rows[:, :, -1] - np.einsum("ka,akri->ari", fit.mean[:, 0], drawn, optimize=True)
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
        loose = fit.loose.T + gain - part.log_possible[:, np.newaxis]

        def mass(each: Array, readings: Array, mean: Array = mean) -> Array:
            return log_orthant(mean[:, readings, each] + part.edge.T[:, each], fit.inverse, each)

        weights.append(np.logaddexp.reduce(_with_mass(loose, mass, axis=0), axis=0))
    return np.asarray(np.logaddexp.reduce(weights))


# The noise of a reading: what is stated, repeats and scatter say of it, as one posterior.


KNOWN = np.inf  # degrees of freedom of a noise that needs no estimate
KNOWN_QUANTILE = 1.96  # half-width of a 95 % interval where the noise is known
ORIGINS = {
    "stated": "as stated",
    "stated and marks": "as stated, and from the scatter of the marks",
    "marks": "from the scatter of the marks",
}
FEWEST_SPARE = 0.5  # numbers that a fit must leave over to say anything of its misfit
DRAWN = 99  # noises of the prior
SURPRISING = 2.5  # spreads of what was stated by which the marks may differ from it


@dataclass(frozen=True)
class Noise:
    """Standard deviation of one coordinate or distance, and how well it is known."""

    sigma: float  # [mm]
    degrees: float  # of freedom; KNOWN if it was not estimated
    source: str  # one of ORIGINS
    notes: tuple[str, ...] = ()

    @property
    def quantile(self) -> float:
        """Half-width of a 95 % interval, in standard deviations."""
        return (
            KNOWN_QUANTILE
            if np.isinf(self.degrees)
            else float(scipy.special.stdtrit(self.degrees, 0.975))
        )

    @property
    def upper_quantile(self) -> float:
        """Distance of a 95 % upper limit, in standard deviations."""
        return 1.645 if np.isinf(self.degrees) else float(scipy.special.stdtrit(self.degrees, 0.95))


def noise_by(sigmas: Array, weights: Array, stated: Stated | None, unit: Unit) -> Noise:
    """Return the noise by log weights (m,) of some standard deviations [mm].

    The logarithm of a standard deviation that is known with n degrees of freedom spreads by
    1 / sqrt(2 n), so Student's t with as many degrees follows for what is fitted.
    """
    if not noise_prior(stated)[1]:
        return Noise(float(sigmas[0]), KNOWN, "stated")
    chances = np.exp(weights - np.logaddexp.reduce(weights))
    logs = np.log(sigmas)
    middle = float(chances @ logs)
    variance = float(chances @ (logs - middle) ** 2)
    variance = variance or NOISE_STEP**2 / 12  # where one is left, it is known to a step
    noise = Noise(float(np.exp(middle)), 0.5 / variance, "stated and marks" if stated else "marks")
    return noise if stated is None else _compared(noise, stated, unit)


def _compared(noise: Noise, stated: Stated, unit: Unit) -> Noise:
    """Return the noise with a note if the marks contradict what was stated."""
    _, spread = noise_prior(stated)
    off = np.log(noise.sigma / stated.sigma)
    if abs(off) < SURPRISING * spread:
        return noise
    than = "more" if off > 0 else "less"
    note = (
        f"the marks scatter by {unit.worded(noise.sigma)}, {than} than the stated "
        f"{unit.worded(stated.sigma)}: read three marks three times, "
        + to_do("or say with --sigma what holds", page="or correct what your tape is good to")
    )
    return Noise(noise.sigma, noise.degrees, noise.source, (note,))


# Lack of fit: the last guard, whether an account leaves more than noise ever would.


def misfit_chance(explanation: Explanation, stated: Stated | None) -> float:
    """Return the chance that noise leaves as much as this explanation does, over all noises that
    were likely before the marks (a posterior-predictive check, Gelman, Meng and Stern 1996).

    Repeats that scatter more than was stated make noises likelier. Repeats that scatter less do
    not: they share what is wrong with a mark, and say nothing of how marks differ.
    """
    basis, count = explanation.basis, explanation.board.rows.count
    # How near the frame is to what was stated says nothing of how well the marks are explained.
    left = float(explanation.numbers @ explanation.numbers)
    spare = count - float(np.sum(basis[:count] ** 2))
    if spare < FEWEST_SPARE:
        return 1.0
    middle, spread = noise_prior(stated)
    logs = spread * scipy.special.stdtrit(NOISE_DEGREES, (np.arange(DRAWN) + 0.5) / DRAWN)
    variances = (middle * np.exp(logs)) ** 2
    squares, degrees = _repeats(explanation.board.rows)
    by_repeats = -(degrees * np.log(variances) + squares / variances) / 2
    by_repeats = np.exp(by_repeats - np.logaddexp.reduce(by_repeats))
    tails = scipy.special.chdtrc(spare, left / variances)
    return float(max(tails.mean(), by_repeats @ tails))


def _repeats(rows: Observations) -> tuple[float, int]:
    """Return the sum of squares [mm^2] of readings of a mark in a round about their mean, and its
    degrees of freedom.
    """
    errors = rows.measured - rows.targets
    alike: dict[object, list[int]] = {}
    for i, row in enumerate(rows.mark_rows):
        alike.setdefault((rows.names[i], *rows.chains[row], rows.rounds[row]), []).append(i)
    groups = [errors[group] for group in alike.values()]
    squares = sum(float(np.sum((group - group.mean(axis=0)) ** 2)) for group in groups)
    return squares, 2 * (len(errors) - len(groups))


def left_by_noise(explanation: Explanation, noise: Noise) -> float:
    """Return what noise alone would leave of a fit [mm], as `Explanation.rms` counts it."""
    leverages = np.sum(explanation.basis**2, axis=1)
    return noise.sigma * explanation.board.rows.rms_of_noise(leverages)


def library_basis(explanation: Explanation) -> Array:
    """Orthonormal columns of what was fitted and of every effect of the library."""
    raw = explanation.slopes[:, explanation.board.columns(explanation.board.effect_columns)]
    basis = explanation.basis
    return np.hstack([basis, span(beyond(basis, raw), against=raw)])


# Sets of effects on a machine as every machine is: what the marks ask for beyond that.
#
# Every chain stretches and sags, and half of all chains are a little long or short. So this is in
# each account within what is usual, and is asked for only where the marks move it.


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


# The fit of an account: the frame and its effects, with what every machine has held near usual.


def felt_effects(frame: Explanation) -> Effects:
    """Effects that change any of the measured numbers."""
    board = frame.board
    return tuple(
        name for name in board.effect_columns if np.any(frame.slopes[:, board.columns([name])])
    )


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


def about(at: Explanation, effects: Effects) -> tuple[LinearBoard, Accounts]:
    """Return the board made linear about a fit, and the account of its effects."""
    names = [name for name in felt_effects(at) if name in (*effects, *EVERY_MACHINE, PITCH)]
    linear = LinearBoard.of(at, names)
    accounts = accounts_of(linear, len(effects))
    wanted = [{*names} == {*effects} for names in accounts.effects]
    return linear, accounts.among(np.array(wanted))
