"""The same marks with all errors of y the other way round: a sign that was mixed up."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace

from plumb.diagnosis.explanation import Board, Explanation, explain
from plumb.diagnosis.misfit import LEVEL, misfit_chance
from plumb.diagnosis.noise import Noise
from plumb.diagnosis.sizes import possible
from plumb.model.ranks import ranked


def sign_warning(
    board: Board, felt: Sequence[str], noise: Noise, kept: Sequence[Explanation]
) -> str | None:
    """A sentence on the other sign of y, if nothing simple explains the marks as they stand."""
    if not len(board.rows.measured) or any(_is_simple(explanation, noise) for explanation in kept):
        return None
    turned = with_y_errors_turned(board)
    frame = explain(turned)
    if misfit_chance(frame, noise) > LEVEL:
        simple = ["the frame alone"]
    else:
        fits = [explain(turned, (name,), start=frame) for name in felt]
        fits = [single for single in fits if misfit_chance(single, noise) > LEVEL]
        fits = [single for single in fits if _is_simple(single, noise)]
        simple = [single.effects[0] for single in ranked(fits, lambda single: single.cost)]
    if not simple:
        return (
            "tried with all y errors the other way round as well: nothing simple explains the "
            "marks then either"
        )
    return (
        f"with all y errors the other way round {' or '.join(simple[:3])} would explain these "
        "marks: check that measured and target count y in the same direction"
    )


def with_y_errors_turned(board: Board) -> Board:
    """The board with each mark as far above its target as it was below it."""
    rows = board.rows
    measured = rows.measured.copy()
    measured[:, 1] = 2 * rows.targets[:, 1] - measured[:, 1]
    return board.with_rows(replace(rows, measured=measured))


def _is_simple(explanation: Explanation, noise: Noise) -> bool:
    """Whether at most one effect explains the marks, with sizes that a real machine can have."""
    return len(explanation.effects) < 2 and possible(explanation, noise)
