"""Where the noise of a reading is taken from: the rule for every command.

- `--sigma` is used as it is given. Where repeats contradict it, a note says so.
- `tape_sigma_mm` of the marks and repeats count together, the statement as much as a spread of
  STATEMENT degrees of freedom. Where the two contradict each other beyond chance, the repeats
  are believed, and a note says so.
- Without a statement repeats alone count; without repeats the statement alone.
- With neither a diagnosis takes the usual sigma of a tape, or the scatter about everything that
  the library can draw if that is larger; `plumb add` takes what its fit leaves.
"""

from __future__ import annotations

import scipy

from plumb.board.observations import Observations
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.misfit import beyond_library
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.repeats import distance_spread, mark_spread, rounding_sigma
from plumb.diagnosis.significance import KNOWN
from plumb.diagnosis.spread import Spread
from plumb.fit.inputs import Stated
from plumb.fit.problem import USUAL_SIGMA
from plumb.text.readers import to_do
from plumb.text.shown import worded

STATEMENT = 10.0  # degrees of freedom that a stated sigma is worth when it meets repeats
FEW_REPEATS = 6  # degrees of freedom below which repeats do not overrule a stated sigma
GOOD_REPEATS = 12  # three marks read three times
FEW_SCATTER = 8  # degrees of freedom below which the scatter tells nothing of the noise
LARGEST_SIGMA = 1.0  # [mm] nobody reads a tape worse: a larger scatter is no noise
SMALLEST_SIGMA = 0.01  # [mm] for repeats that agree to the last digit they were written with
SURE = 0.01  # chance at which two numbers for the noise are said to disagree


def noise_on(board: Board, stated: Stated | None) -> Noise:
    """The noise of what was measured on a board."""
    repeats = repeats_of(board.rows)
    known = known_noise(repeats, stated)
    if known is not None:
        return known
    left, spare = beyond_library(explain(board))
    return guessed_noise(Spread(left * board.sigma**2, max(spare, 0.0)))


def repeats_of(rows: Observations) -> Spread:
    """The spread of readings that were taken of the same mark or distance in the same way."""
    spread = mark_spread(rows) + distance_spread(rows)
    least = rounding_sigma(rows) ** 2 * spread.degrees if spread.degrees else 0.0
    return Spread(max(spread.squares, least), spread.degrees)


def known_noise(repeats: Spread, stated: Stated | None) -> Noise | None:
    """What statements and repeats say of the noise; None if there are neither."""
    if stated is not None and (stated.is_final or repeats.degrees < 1):
        return Noise(stated.sigma, KNOWN, "stated", _contradiction(repeats, stated))
    if stated is not None:
        return _together(repeats, stated)
    return _from_repeats(repeats) if repeats.degrees >= 2 else None


def guessed_noise(scatter: Spread) -> Noise:
    """The noise where nothing was stated or repeated.

    What is beyond LARGEST_SIGMA is not believed to be noise.
    """
    large = scatter.degrees >= FEW_SCATTER and _exceeds(scatter, USUAL_SIGMA)
    if large and scatter.sigma <= LARGEST_SIGMA:
        return Noise(scatter.sigma, scatter.degrees, "scatter", (_SCATTER, _ask()))
    return Noise(LARGEST_SIGMA if large else USUAL_SIGMA, KNOWN, "default", (_ask(),))


def _together(repeats: Spread, stated: Stated) -> Noise:
    """A statement that may be wrong, and repeats that are few."""
    notes = _contradiction(repeats, stated)
    if notes and repeats.degrees >= FEW_REPEATS:
        return _from_repeats(repeats, notes)
    pooled = repeats + Spread(STATEMENT * stated.sigma**2, STATEMENT)
    return Noise(pooled.sigma, pooled.degrees, "stated and repeats", notes, repeats)


def _from_repeats(repeats: Spread, notes: tuple[str, ...] = ()) -> Noise:
    if repeats.degrees < GOOD_REPEATS:
        notes += (
            f"the noise rests on {repeats.degrees:.0f} spare numbers, so only large effects can "
            "be proved; read three marks three times for sharper answers",
        )
    sigma = max(repeats.sigma, SMALLEST_SIGMA)
    within = Spread(sigma**2 * repeats.degrees, repeats.degrees)
    return Noise(sigma, float(repeats.degrees), "repeats", notes, within)


def _contradiction(repeats: Spread, stated: Stated) -> tuple[str, ...]:
    """A sentence if repeats and a statement differ by more than chance."""
    more = repeats.degrees > 0 and _exceeds(repeats, stated.sigma)
    less = repeats.degrees > 0 and _falls_below(repeats, stated.sigma)
    if not (more or less):
        return ()
    if stated.is_final:
        used = to_do(
            f"the {stated.sigma:g} mm of --sigma are used; leave it out to use the repeats",
            page=f"the stated {stated.sigma:g} mm are used",
        )
    elif repeats.degrees >= FEW_REPEATS:
        used = "the repeats are believed"
    else:
        used = "both are used, for the repeats are few; read three marks three times"
    than = "more" if more else "less"
    return (
        f"repeats differ by {worded(repeats.sigma)}, {than} than the stated "
        f"{worded(stated.sigma)}, and chance alone hardly does that: {used}",
    )


def _exceeds(spread: Spread, sigma: float) -> bool:
    """Whether readings of this sigma hardly ever spread as much."""
    return bool(scipy.special.chdtrc(spread.degrees, spread.squares / sigma**2) < SURE)


def _falls_below(spread: Spread, sigma: float) -> bool:
    """Whether readings of this sigma hardly ever spread as little."""
    return bool(scipy.special.chdtr(spread.degrees, spread.squares / sigma**2) < SURE)


def _ask() -> str:
    return (
        "no reading error is stated and no mark was read twice: a tape's usual error is taken, and "
        "what hangs on it may be wrong; read three marks three times, or "
        + to_do("give --sigma", page="choose the finest lines of your tape under Readings")
    )


_SCATTER = (
    "the marks scatter more than a tape usually does about everything the library can draw: that "
    "scatter is taken for noise, and an unknown effect would hide in it"
)
