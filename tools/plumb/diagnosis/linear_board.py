"""A board made linear about the fit of its frame, and what it says of sets of effects.

What is measured is then a sum of normals: noise, the frame within its priors, and effects of sizes
that real machines have. The evidence of a set is the density of the readings over all of that.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import lru_cache
from itertools import groupby

import numpy as np

from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.readings import Reading, readings_of
from plumb.fit.plausible import plausible_range

Array = np.ndarray
SHARES = (0.3, 1.0)  # spreads of sizes as shares of the largest that was met, both as likely


@dataclass(frozen=True)
class LinearBoard:
    """Readings and slopes, whitened; direct checks are readings too."""

    read: Array  # (n,) less what the start predicts
    frame: Array  # (n, f) slopes by the frame in standard deviations of its priors
    effects: Array  # (n, p) slopes by the effects in the largest sizes that were met
    columns: Mapping[str, Array]  # of each effect, in `effects`
    readings: tuple[Reading, ...]
    numbers: tuple[Array, ...]  # of each reading
    sigma: float  # [mm]
    degrees: float  # of freedom of sigma

    @staticmethod
    def of(frame: Explanation, felt: Sequence[str], noise: Noise) -> LinearBoard:
        """About the fit of a frame alone, with the effects that are felt."""
        board, problem = frame.board, frame.board.problem
        count, held = board.rows.count, int(problem.held.sum())
        kept = np.r_[0:count, count + held : len(frame.residual)]
        slopes = frame.slopes[kept]
        of_effects = board.columns(felt)
        met = [plausible_range(problem.names[i]) for i in of_effects]
        largest = np.array([max(abs(known.low), abs(known.high)) for known in met])
        starts = np.cumsum([0, *(len(board.columns([name])) for name in felt)])
        readings = tuple(readings_of(board.rows))
        return LinearBoard(
            read=frame.residual[kept] + slopes[:, board.frame] @ frame.unknowns[board.frame],
            frame=slopes[:, board.frame],
            effects=slopes[:, of_effects] * (largest / problem.scale[of_effects]),
            columns={
                name: np.arange(low, high)
                for name, low, high in zip(felt, starts[:-1], starts[1:], strict=True)
            },
            readings=readings,
            numbers=tuple(reading.numbers(board.rows) for reading in readings),
            sigma=board.sigma,
            degrees=noise.degrees,
        )


@dataclass(frozen=True)
class Metric:
    """What weighs readings where only noise, the frame and perhaps a field act."""

    board: LinearBoard
    inverse: Array  # (n, n) of the covariance
    spread: float  # logarithm of its determinant
    by_effects: Array  # (n, p) inverse @ effects
    by_read: Array  # (n,) inverse @ read

    @staticmethod
    def of(board: LinearBoard, field: Array | None = None) -> Metric:
        """With a field's covariance [mm^2] of the measured numbers, if there is one."""
        covariance = np.eye(len(board.read)) + board.frame @ board.frame.T
        if field is not None:
            covariance[: len(field), : len(field)] += field / board.sigma**2
        inverse = np.linalg.inv(covariance)
        return Metric(
            board,
            inverse,
            float(np.linalg.slogdet(covariance)[1]),
            inverse @ board.effects,
            inverse @ board.read,
        )

    def evidences(self, sets: Sequence[tuple[str, ...]]) -> Array:
        """Logarithm of the evidence of each set, up to what all have in common."""
        return np.concatenate([self._evidence(part) for part in self._parts(sets)])

    def slip_evidences(
        self, sets: Sequence[tuple[str, ...]], before: Array, spreads: Sequence[float]
    ) -> Array:
        """The same for each reading being off by one of these spreads [mm], all sets together,
        each with the logarithm of its weight before the marks."""
        summed, done = np.full(len(self.board.readings), -np.inf), 0
        for part in self._parts(sets):
            weights = before[done : done + part.count]
            done += part.count
            for readings, evidences in self._slips(part, spreads):
                whole = np.logaddexp.reduce(evidences + weights, axis=(0, 2))
                summed[readings] = np.logaddexp(summed[readings], whole)
        together: Array = summed - np.log(len(spreads) * len(self.board.readings))
        return together

    def _parts(self, sets: Sequence[tuple[str, ...]]) -> Iterator[_Part]:
        """Sets of as many effects, with each spread of sizes."""
        widths = tuple((name, len(columns)) for name, columns in self.board.columns.items())
        for _, names in groupby(sets, key=len):
            yield _Part.of(self, _columns_of(widths, tuple(names)))

    def _evidence(self, part: _Part) -> Array:
        left = self.board.read @ self.by_read - part.explained
        both = self._density(left) - (part.spread + self.spread) / 2
        return np.asarray(np.logaddexp.reduce(both, axis=0) - np.log(len(SHARES)))

    def _slips(self, part: _Part, spreads: Sequence[float]) -> Iterator[tuple[Array, Array]]:
        """The readings with as many numbers, and the evidence (spreads, readings, sets) with each
        of them off."""
        drawn = part.scaled(self.by_effects)  # (shares, sets, n, k)
        weighed = drawn @ part.inverse
        pulls = self.by_read - _times(weighed, part.along)
        for size in sorted({len(numbers) for numbers in self.board.numbers}):
            readings = [i for i, numbers in enumerate(self.board.numbers) if len(numbers) == size]
            numbers = np.stack([self.board.numbers[i] for i in readings])  # (readings, size)
            kept = self.inverse[numbers[:, :, np.newaxis], numbers[:, np.newaxis]] - np.einsum(
                "smrik,smrjk->smrij", weighed[:, :, numbers], drawn[:, :, numbers]
            )
            yield np.array(readings), self._off(part, kept, pulls[:, :, numbers], spreads)

    def _off(self, part: _Part, kept: Array, pull: Array, spreads: Sequence[float]) -> Array:
        """kept: (shares, sets, readings, size, size); pull: the same without the last axis."""
        whole = (self.board.read @ self.by_read - part.explained)[..., np.newaxis]
        bound = (part.spread + self.spread)[..., np.newaxis]
        # Turned to the axes of `kept`, every spread of a slip adds to its diagonal alone.
        stiffness, axes = np.linalg.eigh(kept)
        pull = _times(np.swapaxes(axes, -1, -2), pull)
        evidences = []
        for spread in spreads:
            loose = stiffness + (self.board.sigma / spread) ** 2
            left = whole - np.sum(pull**2 / loose, axis=-1)
            wider = np.sum(np.log(loose * (spread / self.board.sigma) ** 2), axis=-1)
            both = self._density(left) - (bound + wider) / 2
            evidences.append(np.logaddexp.reduce(both, axis=0).T - np.log(len(SHARES)))
        return np.stack(evidences)

    def _density(self, left: Array) -> Array:
        """Logarithm of the density of readings with this chi-square; Student's where sigma was
        estimated."""
        degrees = self.board.degrees
        if np.isinf(degrees):
            return np.asarray(-left / 2)
        density: Array = -(degrees + len(self.board.read)) / 2 * np.log1p(left / degrees)
        return density


@dataclass(frozen=True)
class _Part:
    """Some sets of effects, each padded to the same number of parameters."""

    index: Array  # (sets, k) columns of the effects; the last of all is empty
    along: Array  # (shares, sets, k)
    inverse: Array  # (shares, sets, k, k)
    explained: Array  # (shares, sets) of chi-square
    spread: Array  # (shares, sets) logarithm of the determinant

    @property
    def count(self) -> int:
        """How many sets there are."""
        return len(self.index)

    @staticmethod
    def of(metric: Metric, index: Array) -> _Part:
        """Of sets by the columns of their effects."""
        board = metric.board
        width, most = board.effects.shape[1], index.shape[1]
        empty = np.zeros((width + 1, width + 1))
        empty[:width, :width] = board.effects.T @ metric.by_effects
        shares = np.array(SHARES)[:, np.newaxis, np.newaxis]
        gram = empty[index[:, :, np.newaxis], index[:, np.newaxis, :]]
        inner = np.eye(most) + shares[..., np.newaxis] ** 2 * gram
        along = shares * np.append(board.effects.T @ metric.by_read, 0.0)[index]
        inverse = np.linalg.inv(inner)
        explained = np.sum(along * _times(inverse, along), axis=-1)
        return _Part(index, along, inverse, explained, np.linalg.slogdet(inner)[1])

    def scaled(self, columns: Array) -> Array:
        """Columns (numbers, p) of effects for each share and set (shares, sets, numbers, k)."""
        padded = np.hstack([columns, np.zeros((len(columns), 1))])
        picked = np.moveaxis(padded[:, self.index], 0, 1)
        scaled: Array = np.array(SHARES)[:, np.newaxis, np.newaxis, np.newaxis] * picked
        return scaled


def _times(matrices: Array, vectors: Array) -> Array:
    """Each matrix times its vector."""
    product: Array = (matrices @ vectors[..., np.newaxis])[..., 0]
    return product


@lru_cache(maxsize=16)  # every metric of a board asks for the same sets
def _columns_of(widths: tuple[tuple[str, int], ...], sets: tuple[tuple[str, ...], ...]) -> Array:
    """The columns (sets, k) of each set, from the number of columns of each effect in order.

    A set with fewer columns is padded with the column behind the last.
    """
    ends = np.cumsum([width for _, width in widths])
    columns = {
        name: range(end - width, end) for (name, width), end in zip(widths, ends, strict=True)
    }
    members = [[column for name in names for column in columns[name]] for names in sets]
    most = max(1, *map(len, members))
    beyond = int(ends[-1]) if len(ends) else 0
    index = np.array([member + [beyond] * (most - len(member)) for member in members])
    index.flags.writeable = False
    return index
