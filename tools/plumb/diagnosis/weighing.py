"""How likely each account of the marks is: effects, a reading that is off, or a Gaussian process.

An account is a set of effects, with nothing else, with one reading off, with a Gaussian process
that no mechanics made, or with rounds that do not go together. What is known before the marks
enters as spreads: of the frame by its priors, of each effect by the sizes that real machines have,
of an outlier by what people misread. The marks then say how likely each account is, over all sizes
at once. So an account that can draw anything is worth little, and a search needs no limit.
"""

from __future__ import annotations

from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from itertools import combinations

import numpy as np
import scipy

from plumb.diagnosis.explanation import Board, Explanation, gaussian_process_columns
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.outliers import Reading, readings_of
from plumb.fit.expected import plausible_range
from plumb.model.catalogue import EVERY_MACHINE, ZEROING_NAMES
from plumb.model.plain import ranked

Array = np.ndarray
TOGETHER = 3  # effects at once in an account; all at once are an account too
FEWER = 150  # measured numbers beyond which only pairs are weighed, for time
EFFECT = 0.1  # how likely an effect is before the marks
EVERYWHERE = 0.9  # the same of what every machine has and the settings do not know of
ALL = 0.01  # how likely it is that every effect acts at once
OUTLIER = 0.05  # that some reading is off
UNKNOWN = 0.05  # that the machine does what no effect of the library does
OUTLIER_MM = (4.0, 20.0, 200.0)  # [mm] spreads of an outlier, all as likely
WIDTHS = (0.35, 0.7, 1.4)  # length scales, in halves of what the marks span
LEFT_OUT = 1e-3  # share of the noise's variance to which a Gaussian process is described
PROCESS_MM = (1.0, 2.0, 4.0)  # [mm] spreads of a Gaussian process, all as likely


@dataclass(frozen=True)
class Weighed:
    """The accounts of a board, and the logarithms of their weights."""

    effects: tuple[tuple[str, ...], ...]  # of each account
    clean: Array  # (accounts,) with nothing else
    process: float  # with a Gaussian process or a moved round, all sets of effects together
    outliers: Array  # (readings,) with this reading off, all sets of effects together

    @property
    def best(self) -> tuple[str, ...]:
        """The effects of the likeliest account of a few effects."""
        few = [i for i, names in enumerate(self.effects) if len(names) <= TOGETHER]
        return self.effects[ranked(few, lambda i: -float(self.clean[i]))[0]]

    @property
    def process_chance(self) -> float:
        """How likely a Gaussian process of no effect is, if no reading is off."""
        return float(np.exp(self.process - np.logaddexp.reduce([*self.clean, self.process])))

    def outlier_chances(self, allowed: Array) -> Array:
        """Return how likely each reading is off (readings,), if only those allowed may be."""
        weights = np.where(allowed, self.outliers, -np.inf)
        whole = np.logaddexp.reduce([*self.clean, self.process, *weights])
        chances: Array = np.exp(weights - whole)
        return chances


def weigh(
    frame: Explanation, felt: Sequence[str], noise: Noise, *, with_outliers: bool = True
) -> Weighed:
    """Weigh all accounts of what a frame's fit leaves."""
    board = LinearBoard.of(frame, felt, noise)
    sets, before = accounts(frame, felt)
    parts, plain = board.parts(sets), Metric.of(board)
    clean = before + plain.evidences(parts)[:, 0]
    outliers = np.zeros(0)
    if with_outliers:
        outliers = plain.outlier_evidences(parts, before, OUTLIER_MM) + np.log(OUTLIER)
    least = LEFT_OUT * board.sigma**2 / max(PROCESS_MM) ** 2
    processes = [
        before + metric.evidences(parts)[:, 0]
        for columns in gaussian_process_columns(frame, WIDTHS, least)
        for metric in Metric.with_other(board, columns, PROCESS_MM)
    ]
    process = np.logaddexp.reduce(np.ravel(processes)) - np.log(len(processes))
    between = rounds_columns(frame)
    if between is not None:
        (metric,) = Metric.with_other(board, between, (1.0,))
        moved = before + metric.evidences(parts)[:, 0]
        process = np.logaddexp(process, np.logaddexp.reduce(moved))
    return Weighed(sets, clean, float(process + np.log(UNKNOWN)), outliers)


def accounts(frame: Explanation, felt: Sequence[str]) -> tuple[tuple[tuple[str, ...], ...], Array]:
    """Return sets of effects, last all at once, and the logarithms of their prior weights."""
    most = TOGETHER if frame.board.rows.count <= FEWER else 2
    sets = [names for size in range(most + 1) for names in combinations(felt, size)]
    chances = {name: EFFECT for name in felt} | dict.fromkeys(left_out(frame), EVERYWHERE)
    odds = {name: float(np.log(chance / (1 - chance))) for name, chance in chances.items()}
    before = [sum(odds[name] for name in names) for names in sets]
    return (*sets, tuple(felt)), np.array([*before, np.log(ALL)])


def left_out(frame: Explanation) -> tuple[str, ...]:
    """Return what every machine has, and what the settings do not know of."""
    board = frame.board
    return tuple(
        name for name in EVERY_MACHINE if not np.any(board.problem.start[board.columns([name])])
    )


# A board made linear about the fit of its frame, and what it says of sets of effects.
#
# What is measured is then a sum of normals: noise, the frame within its priors, and effects of
# sizes that real machines have. The evidence of a set is the density of the readings over all of
# that.
#
# Several boards with the same rows are weighed at once: what was read is a column for each.

SHARES = (0.3, 1.0)  # spreads of sizes as shares of the largest that was met, both as likely
_BY_SHARE = np.array(SHARES)[:, np.newaxis, np.newaxis, np.newaxis]


@dataclass(frozen=True)
class LinearBoard:
    """Readings and slopes, whitened; direct checks are readings too."""

    read: Array  # (n, boards) less what the start predicts
    frame: Array  # (n, f) slopes by the frame in standard deviations of its priors
    effects: Array  # (n, p) slopes by the effects in the largest sizes that were met
    columns: Mapping[str, Array]  # of each effect, in `effects`
    numbers: Array  # (readings, 2) rows of each reading; n where it has a single number
    sigma: float  # [mm]
    degrees: float  # of freedom of sigma

    @staticmethod
    def of(frame: Explanation, felt: Sequence[str], noise: Noise) -> LinearBoard:
        """About the fit of a frame alone, with the effects that are felt."""
        board = frame.board
        count, held = board.rows.count, int(board.problem.held.sum())
        kept = np.r_[0:count, count + held : len(frame.residual)]
        slopes = frame.slopes[kept]
        read = frame.residual[kept] + slopes[:, board.frame] @ frame.unknowns[board.frame]
        starts = np.cumsum([0, *(len(board.columns([name])) for name in felt)])
        return LinearBoard(
            read=read[:, np.newaxis],
            frame=slopes[:, board.frame],
            effects=_in_largest(board, felt, slopes),
            columns={
                name: np.arange(low, high)
                for name, low, high in zip(felt, starts[:-1], starts[1:], strict=True)
            },
            numbers=_rows_of(readings_of(board.rows), board, len(kept)),
            sigma=board.sigma,
            degrees=noise.degrees,
        )

    def with_more(self, board: Board, slopes: Array, read: Array, noise: Noise) -> LinearBoard:
        """Further rows below, by whitened slopes (m, u) of a board's unknowns; `read` (m, boards)
        less what the start predicts. No reading is asked for on its own then."""
        so_far = np.repeat(self.read, read.shape[1], axis=1)
        return replace(
            self,
            read=np.vstack([so_far, read]),
            frame=np.vstack([self.frame, slopes[:, board.frame]]),
            effects=np.vstack([self.effects, _in_largest(board, tuple(self.columns), slopes)]),
            numbers=self.numbers[:0],
            degrees=noise.degrees,
        )

    def parts(self, sets: Sequence[tuple[str, ...]]) -> tuple[Part, ...]:
        """Return sets of effects, those with as many parameters together."""
        members = [np.concatenate([[], *(self.columns[name] for name in names)]) for names in sets]
        sizes = np.array([len(member) for member in members])
        return tuple(
            Part(
                np.flatnonzero(sizes == size),
                np.array([members[i] for i in np.flatnonzero(sizes == size)], dtype=int),
            )
            for size in np.unique(sizes)
        )


@dataclass(frozen=True)
class Part:
    """Some sets of effects with as many parameters."""

    places: Array  # (sets,) among all sets
    index: Array  # (sets, k) columns of their effects


@dataclass(frozen=True)
class Metric:
    """What weighs readings where only noise, the frame and perhaps something else act.

    The covariance of the readings is 1 + loose loose^T, with root root^T = 1 + loose^T loose; its
    inverse is never written out.
    """

    board: LinearBoard
    loose: Array  # (n, c) what independent normals move
    root: Array  # (c, c)
    by_effects: Array  # (n, p) inverse @ effects
    by_read: Array  # (n, boards) inverse @ read

    @staticmethod
    def of(board: LinearBoard) -> Metric:
        """Return the metric of nothing but noise and the frame."""
        return Metric._of(board, board.frame, board.frame.T @ board.frame)

    @staticmethod
    def with_other(board: LinearBoard, other: Array, sizes: Sequence[float]) -> list[Metric]:
        """Return the metrics with something else of these sizes; columns (numbers, c) [mm]."""
        columns = np.zeros((len(board.frame), other.shape[1]))
        columns[: len(other)] = other / board.sigma
        both = np.hstack([board.frame, columns])
        gram = both.T @ both
        frame, more = np.ones(board.frame.shape[1]), np.ones(columns.shape[1])
        scales = [np.concatenate([frame, size * more]) for size in sizes]
        return [Metric._of(board, both * by, gram * np.outer(by, by)) for by in scales]

    @staticmethod
    def _of(board: LinearBoard, loose: Array, gram: Array) -> Metric:
        root = scipy.linalg.cholesky(np.eye(len(gram)) + gram, lower=True)
        drawn = np.hstack([board.effects, board.read])
        drawn = drawn - loose @ scipy.linalg.cho_solve((root, True), loose.T @ drawn)
        by_effects, by_read = np.split(drawn, [board.effects.shape[1]], axis=1)
        return Metric(board, loose, root, by_effects, by_read)

    @property
    def log_determinant(self) -> float:
        """Logarithm of the determinant of the covariance."""
        return 2 * float(np.sum(np.log(np.diag(self.root))))

    def evidences(self, parts: Iterable[Part]) -> Array:
        """Logarithm of the evidence (sets, boards) of each set, up to what all have in common."""
        weighed = [_Fitted.of(self, part) for part in parts]
        evidences = np.zeros((sum(len(part.places) for part in parts), self.board.read.shape[1]))
        for fitted in weighed:
            size = fitted.log_determinant + self.log_determinant
            both = self._density(self._left(fitted)) - size / 2
            evidences[fitted.part.places] = _mean_of_shares(both)
        return evidences

    def outlier_evidences(
        self, parts: Iterable[Part], before: Array, spreads: Sequence[float]
    ) -> Array:
        """Return the same of the first board for each reading being off by one of these spreads
        [mm], all sets together, each with the logarithm of its weight before the marks.
        """
        summed = []
        for part in parts:
            outliers = self._outliers(_Fitted.of(self, part), spreads)
            weighed: Array = outliers + before[part.places][np.newaxis, :, np.newaxis]
            summed.append(np.logaddexp.reduce(weighed, axis=(0, 1)))
        count = len(spreads) * len(self.board.numbers)
        together: Array = np.logaddexp.reduce(summed, axis=0) - np.log(count)
        return together

    def _left(self, fitted: _Fitted) -> Array:
        """Chi-square (shares, sets, boards) with each set fitted."""
        whole: Array = np.sum(self.board.read * self.by_read, axis=0) - fitted.explained
        return whole

    def _outliers(self, fitted: _Fitted, spreads: Sequence[float]) -> Array:
        """Return the evidence (spreads, sets, readings) with a reading off."""
        # What a reading set free may take, and what pulls at it; a third row stands for none.
        turned, by_effects, by_read = (
            np.vstack([rows, np.zeros((1, rows.shape[1]))])[self.board.numbers]
            for rows in (
                scipy.linalg.solve_triangular(self.root, self.loose.T, lower=True).T,
                self.by_effects,
                self.by_read[:, :1],
            )
        )
        exists = (self.board.numbers < len(self.board.read)).astype(float)
        drawn = fitted.drawn(by_effects)  # (shares, sets, k, readings, 2)
        kept = [
            exists[:, i] * (i == j)
            - np.sum(turned[:, i] * turned[:, j], axis=1)
            - np.sum(drawn[..., i] * drawn[..., j], axis=2)
            for i, j in ((0, 0), (0, 1), (1, 1))
        ]
        taken = np.sum(fitted.pulled[..., np.newaxis, :1] * drawn, axis=2)
        pull = by_read[..., 0] - taken
        left = self._left(fitted)[..., :1]
        size = fitted.log_determinant + self.log_determinant
        return np.array(
            [self._off(left, size, kept, pull, length / self.board.sigma) for length in spreads]
        )

    def _off(
        self, left: Array, spread: Array, kept: Sequence[Array], pull: Array, length: float
    ) -> Array:
        """Return the evidence (sets, readings) with each off by a length [sigmas]; `kept` is a
        symmetric matrix of two by two."""
        first, both, second = kept[0] + length**-2, kept[1], kept[2] + length**-2
        size = first * second - both**2
        x, y = pull[..., 0], pull[..., 1]
        explained = (second * x**2 - 2 * both * x * y + first * y**2) / size
        wider = np.log(size) + 4 * np.log(length)
        off: Array = _mean_of_shares(self._density(left - explained) - (spread + wider) / 2)
        return off

    def _density(self, left: Array) -> Array:
        """Logarithm of the density of readings with this chi-square; Student's where sigma was
        estimated."""
        degrees = self.board.degrees
        if np.isinf(degrees):
            return np.asarray(-left / 2)
        density: Array = -(degrees + len(self.board.read)) / 2 * np.log1p(left / degrees)
        return density


@dataclass(frozen=True)
class _Fitted:
    """The sets of a part, fitted with each spread of sizes."""

    part: Part
    root: Array  # (shares, sets, k, k), whitens the sets' parameters
    pulled: Array  # (shares, sets, k, boards)
    log_determinant: Array  # (shares, sets, 1)

    @staticmethod
    def of(metric: Metric, part: Part) -> _Fitted:
        """By the metric's slopes and readings."""
        effects, index = metric.board.effects, part.index
        gram, along = effects.T @ metric.by_effects, metric.by_read.T @ effects
        inner = gram[index[:, :, np.newaxis], index[:, np.newaxis, :]]
        whole = np.eye(index.shape[1]) + _BY_SHARE**2 * inner
        lower = np.linalg.cholesky(whole)
        root = np.linalg.inv(lower)
        pulled = root @ (_BY_SHARE * np.moveaxis(along[:, index], 0, -1))
        diagonal = np.diagonal(lower, axis1=-2, axis2=-1)
        return _Fitted(part, root, pulled, 2 * np.sum(np.log(diagonal), axis=-1, keepdims=True))

    @property
    def explained(self) -> Array:
        """Of chi-square (shares, sets, boards)."""
        explained: Array = np.sum(self.pulled**2, axis=2)
        return explained

    def drawn(self, by_effects: Array) -> Array:
        """Rows (readings, 2, p) of effects by the whitened parameters of each set (shares, sets, k,
        readings, 2)."""
        rows = by_effects.reshape(-1, by_effects.shape[2]).T  # (p, readings * 2)
        drawn = self.root @ (_BY_SHARE * rows[self.part.index])
        by_reading: Array = drawn.reshape(*drawn.shape[:-1], len(by_effects), 2)
        return by_reading


def _in_largest(board: Board, names: Sequence[str], slopes: Array) -> Array:
    """Slopes by effects in the largest sizes that were met."""
    columns = board.columns(names)
    in_largest: Array = slopes[:, columns] * largest_met(board, columns)
    return in_largest


def largest_met(board: Board, columns: Array) -> Array:
    """Return the largest sizes (k,) met of these columns' parameters, in typical sizes."""
    met = [plausible_range(board.problem.names[i]) for i in columns]
    largest = np.array([max(abs(known.low), abs(known.high)) for known in met])
    in_typical: Array = largest / board.problem.scale[columns]
    return in_typical


def _rows_of(readings: Sequence[Reading], board: Board, none: int) -> Array:
    """Rows (readings, 2) of each reading; `none` where it has a single number."""
    numbers = np.full((len(readings), 2), none)
    for row, reading in zip(numbers, readings, strict=True):
        row[: reading.size] = reading.numbers(board.rows)
    return numbers


def _mean_of_shares(evidences: Array) -> Array:
    """Logarithm of the mean over the spreads of sizes, which come first."""
    mean: Array = np.logaddexp.reduce(evidences, axis=0) - np.log(len(SHARES))
    return mean


# Rounds that do not go together, as they would be measured: a sheet moved, chains hung again.

MOVED = 6.0  # [mm] spread of a sheet laid elsewhere, and of a chain's zero


def rounds_columns(frame: Explanation) -> Array | None:
    """Return what rounds may move (n, c) [mm] as independent normals; None in a single round."""
    board, rows = frame.board, frame.board.rows
    number = np.concatenate([np.repeat(rows.rounds[rows.mark_rows], 2), rows.distance_rounds])
    later = np.unique(number)[1:]
    if not len(later):
        return None
    names, scale = board.problem.names, board.problem.scale
    zeros = [names.index(name) for name in ZEROING_NAMES]
    slopes = frame.slopes[: rows.count] * board.sigma
    moved = np.zeros((rows.count, 2))
    for axis in (0, 1):
        moved[axis : rows.measured.size : 2, axis] = MOVED
    changed = np.hstack([moved, slopes[:, zeros] * MOVED / scale[zeros], slopes[:, board.frame]])
    return np.hstack([changed * (number == each)[:, np.newaxis] for each in later])
