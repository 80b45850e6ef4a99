"""Nearest causes where the machine does something that no effect draws.

There a smooth field explains nearly as much as effects do, so the weight of an account says little
of which machine to set. What predicts best the readings that a fit did not see says more: each
effect has to take a good part of that error, or it is left out.
"""

from collections.abc import Sequence

import numpy as np

from plumb.diagnosis.evidence import Effects
from plumb.diagnosis.explanation import Explanation, free_columns, span
from plumb.diagnosis.posterior import Posterior
from plumb.diagnosis.refit import explain_account
from plumb.fit.expected import plausible_range
from plumb.model.plain import ranked

Array = np.ndarray
WORTH = 1 / 6  # of the error at readings not used, which each effect has to take
MOST = 4  # effects that are tried together
HELD = 0.01  # typical sizes: what cannot be negative and is smaller was held at zero
BEAM = 6  # best sets of a size that are tried with another effect
REFITTED = 3  # best sets of a size that are fitted again


def nearest(frame: Explanation, posterior: Posterior) -> Effects:
    """Return the effects that predict best the readings that a fit did not see; none if the frame
    alone does. Sizes that no machine has do not count.
    """
    best: Effects = ()
    least = min(left_out(at, ()) for at in (frame, explain_account(frame, (), ())))
    sets: Sequence[Effects] = [()]
    for _ in range(MOST):
        larger = dict.fromkeys(
            tuple(name for name in posterior.felt if name in {*few, more})
            for few in sets
            for more in posterior.felt
            if more not in few
        )
        sets = ranked(larger, lambda few: left_out(frame, few))[:BEAM]
        fitted = [(left_out_refitted(frame, few), few) for few in sets[:REFITTED]]
        left, first = ranked(fitted, lambda each: each[0])[0]
        if np.isfinite(left) and left <= least * (1 - WORTH) ** (len(first) - len(best)):
            best, least = first, left
    return best


def left_out(at: Explanation, effects: Effects) -> float:
    """Return the RMS [mm] of readings by a fit without each, linear about `at`; infinite for sizes
    that no machine has.

    With H = basis basis^T and the residual r of a reading b, the fit without it leaves
    (1 - H_bb)^-1 r_b.
    """
    board, problem = at.board, at.board.problem
    free = free_columns(board, dict.fromkeys([*at.effects, *effects]))
    drawn = at.slopes[:, free]
    step = np.linalg.lstsq(drawn, at.residual, rcond=1e-10)[0]
    values = problem.start[free] + problem.scale[free] * (at.unknowns[free] + step)
    for column, value in zip(free, values, strict=True):
        if column not in board.frame and not plausible_range(problem.names[column]).holds(value):
            return np.inf
    basis, residual = span(drawn), at.residual - drawn @ step
    marks, off = board.rows.measured.size, []
    for start, size, end in ((0, 2, marks), (marks, 1, board.rows.count)):
        rows = basis[start:end].reshape((end - start) // size, size, basis.shape[1])
        kept = np.eye(size) - rows @ np.swapaxes(rows, 1, 2)
        each = residual[start:end].reshape(-1, size, 1)
        off.append((np.linalg.pinv(kept, rcond=1e-6, hermitian=True) @ each).ravel())
    return board.rows.rms_of(np.concatenate(off) * board.sigma)


def left_out_refitted(frame: Explanation, effects: Effects) -> float:
    """Return the same linear about the fit of these effects; infinite too where none comes to rest,
    or where a size that cannot be negative was held at zero.
    """
    fit = explain_account(frame, effects, effects)
    board, problem = fit.board, fit.board.problem
    columns = board.columns(effects)
    sizes = problem.start[columns] / problem.scale[columns] + fit.unknowns[columns]
    is_held = any(
        size < HELD and plausible_range(problem.names[column]).low == 0
        for column, size in zip(columns, sizes, strict=True)
    )
    return left_out(fit, effects) if fit.settled and not is_held else np.inf
