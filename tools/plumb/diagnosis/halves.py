"""Parts of a board that want different numbers: halves of the sheet, and rounds of marks.

If parameters move by more than 3 sigma from one part to the other, physics is missing even where
each part by itself fits well, or the rounds were not cut by the same machine.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.board.sighting import SHEET_ROTATION
from plumb.diagnosis.explanation import Explanation, span
from plumb.diagnosis.misfit import library_basis
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.significance import tail
from plumb.model.catalogue import ZEROING_NAMES
from plumb.model.ranks import greatest

Array = np.ndarray
CHANCE = 0.0027  # of a move beyond 3 sigma from noise alone
FEWEST = 6  # measured numbers in a part: fewer tell nothing of it


@dataclass(frozen=True)
class Move:
    """How a parameter differs between two parts of a board."""

    parameter: str
    deviations: float  # by how many sigma
    chance: float  # that noise alone moves the parameters together as much


def half_warnings(explanation: Explanation, noise: Noise) -> list[str]:
    """A sentence for each pair of halves of the sheet that want different parameters."""
    rows = explanation.board.rows
    if not len(rows.targets):
        return []
    said = []
    for axis, names in ((0, "left and right"), (1, "lower and upper")):
        beyond = rows.targets[:, axis] > np.median(rows.targets[:, axis])
        mask = np.zeros(rows.count, dtype=bool)
        mask[: rows.measured.size] = np.repeat(beyond, 2)
        move = _move(explanation, explanation.basis, mask, noise)
        if move:
            said.append(
                f"the {names} half of the sheet want different numbers ({_words(move)}): physics "
                "is missing even where each half fits, so do not trust a size to its interval"
            )
    return said


def round_warnings(explanation: Explanation, noise: Noise, rounds: Sequence[str]) -> list[str]:
    """A sentence for each round (by its name) that does not go with all others.

    Judged beyond everything that the library can draw, so that no effect is blamed on a round.
    """
    if len(rounds) < 2:
        return []
    basis, said = library_basis(explanation), []
    for number, name in enumerate(rounds):
        mask = _numbers_of(explanation, number)
        move = _move(explanation, basis, mask, noise)
        if move:
            said.append(
                f"{name} does not go with the other rounds ({_words(move)}): do not pool them; "
                f"{_way_out(explanation, basis, mask, noise, name)}"
            )
    # Of two rounds either may differ.
    return said[-1:] if len(rounds) == 2 else said


def _words(move: Move) -> str:
    if move.deviations < 3:
        return f"all fitted numbers together; {move.parameter} by {move.deviations:.1f} sigma"
    return f"{move.parameter} by {move.deviations:.1f} sigma"


def _way_out(explanation: Explanation, basis: Array, mask: Array, noise: Noise, name: str) -> str:
    """What would explain the difference, as far as a marks file can say it."""
    for flag, columns in (
        ("chains_rezeroed", _columns(explanation, ZEROING_NAMES, mask)),
        ("new_sheet", _pose(explanation, mask)),
    ):
        wider = np.hstack([basis, span(columns - basis @ (basis.T @ columns), against=columns)])
        if not _move(explanation, wider, mask, noise):
            return f"{flag} = true in {name} would explain it; if it is not so, use one at a time"
    return "use one file at a time and compare what they say"


def _numbers_of(explanation: Explanation, number: int) -> Array:
    """Which measured numbers (n,) belong to a round."""
    rows = explanation.board.rows
    marks = np.repeat(rows.rounds[rows.mark_rows] == number, 2)
    return np.concatenate([marks, rows.distance_rounds == number])


def _move(explanation: Explanation, basis: Array, mask: Array, noise: Noise) -> Move | None:
    """The parameter that moves most between the masked numbers and the rest, if any surely does."""
    if min(mask.sum(), (~mask).sum()) < FEWEST or not np.isfinite(noise.sigma):
        return None
    names = explanation.board.problem.names
    free = [i for i in explanation.free if np.any(explanation.slopes[: mask.size, i])]
    masked = _columns(explanation, [names[i] for i in free], mask)
    beyond = masked - basis @ (basis.T @ masked)
    left = explanation.residual - basis @ (basis.T @ explanation.residual)
    together = span(beyond, against=masked)
    if not together.shape[1]:
        return None
    chance = float(tail(np.sum((together.T @ left) ** 2), together.shape[1], noise.degrees))
    lengths = np.linalg.norm(beyond, axis=0)
    felt = lengths > 1e-5 * np.linalg.norm(masked, axis=0)
    pulls = np.where(felt, np.abs(beyond.T @ left) / np.where(felt, lengths, 1.0), 0.0)
    most = greatest(pulls)
    single = float(tail(pulls[most] ** 2, 1, noise.degrees)) * len(free)
    if min(chance, single) > CHANCE:
        return None
    return Move(names[free[most]], float(pulls[most]), min(chance, single))


def _columns(explanation: Explanation, names: Sequence[str], mask: Array) -> Array:
    """Slopes by some unknowns, on the masked numbers only (rows of the priors are zero)."""
    known = explanation.board.problem.names
    masked = explanation.slopes[:, [known.index(name) for name in names]].copy()
    masked[: mask.size][~mask] = 0.0
    masked[mask.size :] = 0.0
    return masked


def _pose(explanation: Explanation, mask: Array) -> Array:
    """Columns that shift and turn the masked marks on their sheet."""
    marks = explanation.board.rows.measured.size
    shifts = np.zeros((len(explanation.residual), 2))
    for axis in (0, 1):
        shifts[axis:marks:2, axis] = 1.0
    shifts[: mask.size][~mask] = 0.0
    turns = [SHEET_ROTATION] if SHEET_ROTATION in explanation.board.problem.names else []
    return np.hstack([shifts, _columns(explanation, turns, mask)])
