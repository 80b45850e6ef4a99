"""Where the noise of a board is taken from: repeats, a statement, the scatter, or what is usual."""

from __future__ import annotations

import scipy

from plumb.board.observations import Observations
from plumb.diagnose.explanation import Board, explain
from plumb.diagnose.misfit import beyond_library
from plumb.diagnose.noise import Noise
from plumb.diagnose.repeats import distance_spread, mark_spread, rounding_sigma
from plumb.diagnose.significance import KNOWN
from plumb.diagnose.spread import Spread
from plumb.fit.problem import USUAL_SIGMA

FEW_REPEATS = 6  # degrees of freedom below which a stated sigma is trusted more than repeats
GOOD_REPEATS = 12  # three marks read three times
FEW_SCATTER = 8  # degrees of freedom below which the scatter tells nothing of the noise
LARGEST_SIGMA = 1.0  # [mm] nobody reads a tape worse: a larger scatter is no noise
SMALLEST_SIGMA = 0.01  # [mm] for repeats that agree to the last digit they were written with
SURE = 0.01  # chance at which two numbers for the noise are said to disagree


def noise_on(board: Board, stated: float | None) -> Noise:
    """The noise of what was measured on a board; stated [mm]."""
    left, spare = beyond_library(explain(board))
    scatter = Spread(left * board.sigma**2, max(spare, 0.0))
    return noise_of(repeats_of(board.rows), scatter, stated=stated)


def repeats_of(rows: Observations) -> Spread:
    """The spread of readings that were taken of the same mark or distance in the same way."""
    spread = mark_spread(rows) + distance_spread(rows)
    least = rounding_sigma(rows) ** 2 * spread.degrees if spread.degrees else 0.0
    return Spread(max(spread.squares, least), spread.degrees)


def noise_of(repeats: Spread, scatter: Spread, *, stated: float | None) -> Noise:
    """What to take for the noise.

    Enough repeats before a stated sigma, this before few repeats; else the usual sigma of a tape,
    or the scatter about everything that the library can draw if that is larger. What is beyond
    LARGEST_SIGMA is not believed to be noise.
    """
    if repeats.degrees >= FEW_REPEATS or (repeats.degrees >= 2 and not stated):
        return _from_repeats(repeats, stated)
    if stated:
        return Noise(stated, KNOWN, "stated")
    large = scatter.degrees >= FEW_SCATTER and _exceeds(scatter, USUAL_SIGMA)
    if large and scatter.sigma <= LARGEST_SIGMA:
        return Noise(scatter.sigma, scatter.degrees, "scatter", (_SCATTER, _ASK))
    return Noise(LARGEST_SIGMA if large else USUAL_SIGMA, KNOWN, "default", (_ASK,))


def _from_repeats(repeats: Spread, stated: float | None) -> Noise:
    notes = []
    if repeats.degrees < GOOD_REPEATS:
        notes.append(
            f"the noise rests on {repeats.degrees:.0f} spare numbers, so only large effects can "
            "be proved; read three marks three times for sharper answers"
        )
    if stated and _exceeds(repeats, stated):
        notes.append(
            f"repeats differ by {repeats.sigma:.2f} mm, more than the stated {stated:g} mm: the "
            "repeats are believed"
        )
    sigma = max(repeats.sigma, SMALLEST_SIGMA)
    return Noise(sigma, float(repeats.degrees), "repeats", tuple(notes))


def _exceeds(spread: Spread, sigma: float) -> bool:
    """Whether readings of this sigma hardly ever spread as much."""
    return bool(scipy.special.chdtrc(spread.degrees, spread.squares / sigma**2) < SURE)


_ASK = (
    "no reading error is stated and no mark was read twice: a tape's usual one is taken, and what "
    "hangs on it may be wrong; read three marks three times, or give --sigma"
)
_SCATTER = (
    "the marks scatter more than a tape usually does about everything the library can draw: that "
    "scatter is taken for noise, and an unknown effect would hide in it"
)
