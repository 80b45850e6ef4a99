"""Spots: places of the sheet about which the machine does what no effect draws.

A spot falls off as a Gauss bell does and moves the sled each way by normals. Of a grid of spots
over the whole sheet those are looked for that the marks ask for most, if all effects act at once;
about the best of them the grid is made finer as long as that pays for its smaller share.
"""

from dataclasses import dataclass
from itertools import product

import numpy as np

from plumb.diagnosis.explanation import Explanation, half_span, measured_columns, places_of
from plumb.diagnosis.linear import Disturbance, LinearBoard
from plumb.diagnosis.priors import FIELD_SPREADS, SPOT_WIDTHS
from plumb.model.plain import ascending, greatest

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
