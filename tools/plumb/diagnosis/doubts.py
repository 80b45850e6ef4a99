"""What to doubt of a verdict: sizes that no machine has, mixed-up signs, parts that disagree."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.answer import Ranked
from plumb.diagnosis.clean import CleanReadings
from plumb.diagnosis.explanation import Explanation, explain
from plumb.diagnosis.gain import Search
from plumb.diagnosis.halves import half_warnings, round_warnings
from plumb.diagnosis.judgement import Judgement
from plumb.diagnosis.signs import sign_warning
from plumb.diagnosis.sizes import Room, room_for
from plumb.diagnosis.slips import shifts
from plumb.diagnosis.slips_in_repeats import twins_that_agree
from plumb.model.catalogue import effect_names
from plumb.model.ranks import ranked
from plumb.text.shown import worded

_IMPOSSIBLE = (
    "every explanation needs sizes that no real machine has, so each takes the place of another "
    "cause: check which settings were in force, the signs of the marks, the stated frame, and that "
    "the sled hangs on one ring, not on two brackets"
)


@dataclass(frozen=True)
class Doubts:
    """What could hide, and sentences on what does not go together."""

    could_hide: tuple[Room, ...]
    warnings: tuple[str, ...]
    disagreements: tuple[str, ...]  # rounds, or halves of the sheet


def find_doubts(
    readings: CleanReadings,
    gate: Search,
    judgement: Judgement,
    ranking: Sequence[Ranked],
    rounds: Sequence[str],
) -> Doubts:
    """All doubts about a judgement; `rounds` are the names of the files of marks."""
    accepted = judgement.explanations or (readings.frame,)
    return Doubts(
        could_hide=tuple(room_for(name, accepted, readings.noise) for name in effect_names()),
        warnings=(
            *readings.noise.notes,
            *([_IMPOSSIBLE] if judgement.none_possible else []),
            *_place_warnings(readings, judgement),
            *_order_warnings(gate, ranking),
            *_unsettled_warnings((readings.frame, *judgement.explanations)),
            *_sign_warnings(readings, judgement),
        ),
        disagreements=() if readings.slips else _disagreements(readings, accepted[0], rounds),
    )


def _order_warnings(gate: Search, ranking: Sequence[Ranked]) -> list[str]:
    """Where a full refit ranks effects otherwise than the slopes did."""
    first = gate.gains[0].effect if gate.proved else None
    if first in (None, ranking[0].effect):
        return []
    return [
        f"the full refit puts {ranking[0].effect} before {first}, which the "
        "slopes at the frame's fit put first: the error is large; fit one and diagnose again"
    ]


def _place_warnings(readings: CleanReadings, judgement: Judgement) -> list[str]:
    """Where to look first if nothing in the library explains the marks."""
    board = readings.frame.board
    if judgement.verdict != "not_in_library" or not len(board.rows.measured):
        return []
    nearest = explain(board, judgement.to_add, start=readings.frame)
    of_marks = [shift for shift in shifts(nearest) if shift.reading.is_mark]
    worst = ranked(of_marks, lambda shift: -shift.drop)[0]
    name, off = board.rows.names[worst.reading.index], float(np.hypot(*worst.offset))
    if worst.reading in twins_that_agree(board.rows, board.sigma):
        return [
            f"mark {name} stays {worded(off, 1)} off when it is read again: it is the machine there"
        ]
    return [
        f"the marks are farthest off at {name}, by {worded(off, 1)}: read it again; if it stays, "
        "it is the machine there"
    ]


def _unsettled_warnings(explanations: Sequence[Explanation]) -> list[str]:
    unsettled = [fitted for fitted in explanations if not fitted.settled]
    names = ", ".join(" + ".join(fitted.effects) or "frame" for fitted in unsettled)
    return [f"the fit did not come to rest: {names}"] if unsettled else []


def _sign_warnings(readings: CleanReadings, judgement: Judgement) -> list[str]:
    """What the other sign of y would change, where the verdict leaves doubts."""
    if judgement.verdict in ("slip", "nothing_provable") or judgement.shares:
        return []
    board = readings.frame.board
    warning = sign_warning(board, readings.felt, readings.noise, judgement.explanations)
    return [warning] if warning else []


def _disagreements(
    readings: CleanReadings, best: Explanation, rounds: Sequence[str]
) -> tuple[str, ...]:
    """Rounds that do not go together, else halves of the sheet."""
    by_round = round_warnings(best, readings.noise, rounds)
    return tuple(by_round or half_warnings(best, readings.noise))
