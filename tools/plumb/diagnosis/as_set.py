"""A test whether the marks can fault the settings, or noise alone could explain the errors."""

from collections.abc import Iterable

import numpy as np
import scipy

from plumb.diagnosis.explanation import Explanation
from plumb.model.predict import NAMES

FEIGNED = 0.005  # chance below which noise is no longer believed to do it


def is_good(frame: Explanation, fits: Iterable[Explanation] = ()) -> bool:
    """Return whether noise alone may lower chi-square as much as the fitted frame does, and each
    of some fits, against the settings as they are. Where the sheet lies is no setting.

    If the settings are right, a fit of k numbers lowers chi-square by that of k degrees of freedom
    at most: what is known of them before the marks only makes it less.
    """
    problem = frame.board.problem
    at = problem.at(np.zeros(len(frame.unknowns)))
    if at is None:
        return False
    pose = [i for i in frame.board.frame if problem.names[i] not in NAMES]
    count = frame.board.rows.count
    left, slopes = at.residual[:count], at.slopes[:count, pose]
    left = left - slopes @ np.linalg.lstsq(slopes, left, rcond=1e-10)[0]
    as_set = float(left @ left)
    return all(
        scipy.special.chdtrc(len(fit.free) - len(pose), max(as_set - _left(fit), 0.0)) > FEIGNED
        for fit in (frame, *fits)
    )


def _left(fit: Explanation) -> float:
    return float(np.sum(fit.residual[: fit.board.rows.count] ** 2))
