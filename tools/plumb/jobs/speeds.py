"""Where the sled goes slower than the program asks, and how long the job takes."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np

from plumb.jobs.dry_run import Done
from plumb.jobs.moves import Flags, Moves
from plumb.model.predict import Array
from plumb.model.ranks import least

LESS = 0.995  # of a feed: below it a limit acts
GREATEST, Z = "the greatest feed ($15)", "the speed of z ($18)"
ARC, CHAINS = "the arc", "the chains"


@dataclass(frozen=True)
class Slower:
    """Moves that a limit slows."""

    because: str
    moves: int
    line: int  # of the slowest
    asked: float  # [mm/min] there
    feed: float  # [mm/min] there


@dataclass(frozen=True)
class Times:
    """How long a job takes [s]; the pauses of the operator do not count."""

    whole: float
    cutting: float
    rapid: float
    asked: float  # the cutting at the feeds of the program


def slower_moves(moves: Moves) -> tuple[Slower, ...]:
    """Limits that act on cutting moves, those that act most often first."""
    asked, feed, top = moves["asked"], moves["feed"], moves["top"]
    works = ~moves.rapid & moves.over_sheet
    slowed = works & (top < LESS * asked)
    causes = np.full(len(moves), GREATEST, dtype=object)
    by_path = top < LESS * feed
    rises = np.abs(moves["z_to"] - moves["z_from"]) / np.maximum(moves.way, 1e-9)
    # What z's speed allows grows with 1 / rise; on any other limit the rise has no say.
    z_speed = _z_speed(moves, by_path & slowed, rises)
    is_z = by_path & (rises * top > 0.98 * z_speed) & (rises > 0)
    causes[by_path] = CHAINS
    causes[by_path & (moves["sweep"] != 0)] = ARC
    causes[is_z] = Z
    causes_seen = []
    for cause in (GREATEST, Z, ARC, CHAINS):
        rows = np.flatnonzero(slowed & (causes == cause))
        if len(rows):
            worst = rows[least(top[rows])]
            numbers = float(asked[worst]), float(top[worst])
            causes_seen.append(Slower(cause, len(rows), int(moves["line"][worst]), *numbers))
    return tuple(sorted(causes_seen, key=lambda each: -each.moves))


def _z_speed(moves: Moves, those: Flags, rises: Array) -> float:
    """[mm/min] The greatest speed of z that any of those moves reaches."""
    return float((rises * moves["top"])[those].max(initial=0.0)) or np.inf


def times_of(done: Done) -> Times:
    """How long it takes, and what the cutting would take at the program's feeds."""
    moves = done.moves
    took = np.diff(np.concatenate([[0.0], moves["ends"]]))
    works = ~moves.rapid
    asked = moves.way[works] / np.minimum(moves["asked"], moves["feed"])[works] * 60
    return Times(
        whole=done.seconds,
        cutting=float(took[works].sum()),
        rapid=float(took[~works].sum()),
        asked=float(asked.sum()),
    )
