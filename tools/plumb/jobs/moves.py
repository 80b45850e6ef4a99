"""The moves of a job: a row each, and the places along them."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from plumb._dry_run import COLUMNS
from plumb.model.predict import Array

Flags = NDArray[np.bool_]
Rows = NDArray[np.intp]

IN_WOOD = -0.01  # [mm] of z: the bit is below the sheet's face
CLEAR = 5.0  # [mm] above the sheet, if a program goes no higher
TURN = 0.2  # [rad] of an arc between two places


@dataclass(frozen=True)
class Samples:
    """Places along moves."""

    move: Rows  # (k,) row of the move
    places: Array  # (k, 2) [mm]
    z: Array  # (k,) [mm]


@dataclass(frozen=True)
class Moves:
    """Rows as plumb._dry_run.COLUMNS names them."""

    rows: Array  # (n, columns)

    def __len__(self) -> int:
        return len(self.rows)

    def __getitem__(self, name: str) -> Array:
        """A number of all moves (n,) by its name."""
        column: Array = self.rows[:, COLUMNS.index(name)]
        return column

    def only(self, those: Flags | Rows) -> Moves:
        """Some of the moves."""
        return Moves(self.rows[those])

    @property
    def over_sheet(self) -> Flags:
        """Moves of the sled, not of a single chain (n,)."""
        return np.asarray(self["by_chains"] == 0)

    @property
    def rapid(self) -> Flags:
        """Moves at the greatest feed: G0, G28, and the ways of a drilling cycle (n,)."""
        return np.asarray(np.isinf(self["asked"]))

    @property
    def cut(self) -> Flags:
        """Moves with the bit in the wood (n,)."""
        deep = np.minimum(self["z_from"], self["z_to"]) < IN_WOOD
        return np.asarray(deep & self.over_sheet)

    @property
    def way(self) -> Array:
        """Length over all axes (n,) [mm]."""
        return np.hypot(self["length"], self["z_to"] - self["z_from"])

    def sampled(self, step: float) -> Samples:
        """Places along the moves, both ends included, at most `step` [mm] apart."""
        turns = np.abs(self["sweep"]) / TURN
        counts = np.ceil(np.maximum(self.way / step, turns)).astype(int) + 1
        counts = np.maximum(counts, 2)
        move = np.repeat(np.arange(len(self)), counts)
        first = np.cumsum(counts) - counts
        share = (np.arange(len(move)) - first[move]) / (counts[move] - 1)
        return Samples(move, self.places_at(move, share), self._z_at(move, share))

    def _z_at(self, move: Rows, share: Array) -> Array:
        low, high = self["z_from"][move], self["z_to"][move]
        return np.asarray(low + share * (high - low))

    def places_at(self, move: Rows, share: Array) -> Array:
        """Places (k, 2) [mm] at shares of some moves."""
        start = np.stack([self["from_x"], self["from_y"]], axis=1)[move]
        end = np.stack([self["to_x"], self["to_y"]], axis=1)[move]
        across = self["length"][move] > 0
        places = np.where(across[:, None], start + share[:, None] * (end - start), start)
        round_ = (self["sweep"][move] != 0) & across
        centre = np.stack([self["centre_x"], self["centre_y"]], axis=1)[move]
        from_centre, to_centre = start - centre, end - centre
        radius = np.hypot(*from_centre.T) * (1 - share) + np.hypot(*to_centre.T) * share
        angle = np.arctan2(from_centre[:, 1], from_centre[:, 0]) + share * self["sweep"][move]
        turned = centre + radius[:, None] * np.stack([np.cos(angle), np.sin(angle)], axis=1)
        return np.asarray(np.where(round_[:, None], turned, places))


def safe_height(moves: Moves) -> float:
    """The z [mm] at which a job crosses the sheet, or a little above the sheet."""
    across = moves.over_sheet & (moves["length"] > 0)
    return max(CLEAR, float(moves["z_to"][across].max(initial=0.0)))
