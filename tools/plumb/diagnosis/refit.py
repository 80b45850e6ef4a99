"""The fit of an account: the frame and its effects, with what every machine has held near usual."""

import numpy as np

from plumb.diagnosis.evidence import Accounts, Effects, accounts_of
from plumb.diagnosis.explanation import Explanation, explain
from plumb.diagnosis.linear import LinearBoard
from plumb.diagnosis.priors import PITCH, usual_checks, zero_checks
from plumb.model.catalogue import EVERY_MACHINE


def felt_effects(frame: Explanation) -> Effects:
    """Effects that change any of the measured numbers."""
    board = frame.board
    return tuple(
        name for name in board.effect_columns if np.any(frame.slopes[:, board.columns([name])])
    )


def explain_account(frame: Explanation, asked: Effects, acting: Effects) -> Explanation:
    """Refit the frame and the effects of an account; what every machine has and the settings leave
    out too, held near what is usual where it does not act beyond that. What cannot be negative and
    fits best there is held at zero.
    """
    board = frame.board
    left_out = [
        name
        for name in EVERY_MACHINE
        if name not in asked and not board.problem.start[board.columns([name])].any()
    ]
    effects = (*asked, *left_out)
    usual = usual_checks(board, [name for name in effects if name not in acting])
    fitted = explain(board.with_usual(usual), effects, start=frame)
    impossible = zero_checks(fitted)
    if not impossible:
        return fitted
    return explain(board.with_usual((*usual, *impossible)), effects, start=frame)


def about(at: Explanation, effects: Effects) -> tuple[LinearBoard, Accounts]:
    """Return the board made linear about a fit, and the account of its effects."""
    names = [name for name in felt_effects(at) if name in (*effects, *EVERY_MACHINE, PITCH)]
    linear = LinearBoard.of(at, names)
    accounts = accounts_of(linear, len(effects))
    wanted = [{*names} == {*effects} for names in accounts.effects]
    return linear, accounts.among(np.array(wanted))
