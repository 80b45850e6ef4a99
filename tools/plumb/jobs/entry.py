"""Where a cut is taken up again in the middle of a move, and the rest of that move."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.jobs.moves import Flags, Moves, Rows
from plumb.model.predict import Array
from plumb.model.ranks import least
from plumb.text.errors import InputError

NEAR = 5.0  # [mm] a cut passes a place
ALIKE = 1.0  # [mm] passes that are hardly farther away than the nearest
STEP, COARSE = 0.05, 5.0  # [mm] between places that are tried
SLOW = 100.0  # [mm/min] into the wood, where the program never goes straight down


@dataclass(frozen=True)
class Entry:
    """A move of the job that is cut in two."""

    line: int
    rows: Moves  # the move and those behind it that the same line makes
    share: float  # of the first move that is done already
    place: tuple[float, float]  # [mm]
    z: float  # [mm]
    plunge: float  # [mm/min]
    passes: tuple[int, ...]  # lines of all cuts that pass there

    def program(self, origin: Sequence[float]) -> list[str]:
        """Into the wood, and the rest of the line; coordinates begin at `origin` [mm]."""
        down = f"G1 Z{self.z - origin[2]:.4f} F{self.plunge:g}"
        here = np.array(self.place)
        lines = [down]
        for row in range(len(self.rows)):
            end = np.array([self.rows["to_x"][row], self.rows["to_y"][row]])
            lines.append(self._move(row, here, end, origin))
            here = end
        return lines

    def _move(self, row: int, here: Array, end: Array, origin: Sequence[float]) -> str:
        rows = self.rows
        to = (*end, rows["z_to"][row])
        words = [f"{a}{b - o:.4f}" for a, b, o in zip("XYZ", to, origin, strict=True)]
        feed = rows["asked"][row]
        if np.isinf(feed):
            return " ".join(["G0", *words])
        sweep = rows["sweep"][row]
        if sweep == 0 or (row == 0 and self.share >= 1):
            return " ".join(["G1", *words, f"F{feed:g}"])
        centre = np.array([rows["centre_x"][row], rows["centre_y"][row]]) - here
        code = "G3" if sweep > 0 else "G2"
        return " ".join([code, *words, f"I{centre[0]:.4f} J{centre[1]:.4f} F{feed:g}"])


def entry_at(moves: Moves, place: tuple[float, float], *, line: int | None) -> Entry:
    """Where a cut passes nearest to a place; of several passes the first, or that near `line`."""
    cut = np.flatnonzero(moves.cut & ~moves.rapid)
    if line is not None:
        cut = cut[_same_run(moves, cut, line)]
    if not len(cut):
        which = "" if line is None else f" around line {line}"
        raise InputError(f"the program cuts nothing{which}")
    cut = cut[_near(moves.only(cut), place)]
    samples = moves.only(cut).sampled(STEP)
    away = np.hypot(*(samples.places - place).T)
    if away.min() > NEAR:
        nearest = samples.places[least(away)]
        raise InputError(
            f"no cut passes within {NEAR:g} mm of X{place[0]:g} Y{place[1]:g}; the nearest is at "
            f"X{nearest[0]:.1f} Y{nearest[1]:.1f}"
        )
    near = np.flatnonzero(away <= away.min() + ALIKE)
    # The sled goes away and comes back between two passes.
    stretches = np.split(near, np.flatnonzero(np.diff(near) > 1) + 1)
    passes = [int(stretch[least(away[stretch])]) for stretch in stretches]
    best = passes[0]
    row = int(cut[samples.move[best]])
    lines = moves["line"].astype(int)
    begin = np.flatnonzero(samples.move == samples.move[best])
    x, y = samples.places[best]
    return Entry(
        line=int(lines[row]),
        rows=moves.only(np.flatnonzero((lines == lines[row]) & (np.arange(len(moves)) >= row))),
        share=float((best - begin[0]) / (len(begin) - 1)),
        place=(float(x), float(y)),
        z=float(samples.z[best]),
        plunge=_plunge(moves, row),
        passes=tuple(int(lines[cut[samples.move[each]]]) for each in passes),
    )


def _near(moves: Moves, place: tuple[float, float]) -> Rows:
    """The moves that may pass a place as near as the nearest."""
    samples = moves.sampled(COARSE)
    away = np.hypot(*(samples.places - place).T)
    return np.unique(samples.move[away <= away.min() + COARSE + ALIKE])


def _same_run(moves: Moves, cut: Rows, line: int) -> Flags:
    """Cuts between the lifts around a line."""
    # A run ends where the bit comes out of the wood.
    above = np.minimum(moves["z_from"], moves["z_to"]) >= 0
    run = np.cumsum(above | moves.rapid)
    of_line = cut[moves["line"][cut] >= line]
    return np.asarray(run[cut] == (run[of_line[0]] if len(of_line) else -1))


def _plunge(moves: Moves, row: int) -> float:
    """The feed with which the program last went straight down."""
    down = (moves["z_to"] < moves["z_from"]) & (moves["length"] == 0) & ~moves.rapid
    before = np.flatnonzero(down[: row + 1])
    return float(moves["asked"][before[-1]]) if len(before) else SLOW
