"""Check marks: marks that took no part in a fit, held against what the fit promises of them.

A fit promises a place with an interval: what the marks and the priors leave open of its numbers,
and the noise of the new reading. A small residual of the fit itself is no accuracy; this is.
"""

from dataclasses import dataclass, replace

import numpy as np
import scipy

from plumb.diagnosis.explanation import Explanation, explain, measured_board
from plumb.diagnosis.posterior import posterior_of
from plumb.fit.inputs import Inputs
from plumb.fit.observations import Observations, model_and_observations
from plumb.fit.sighting import sighted
from plumb.marks.read import Measurements
from plumb.model.catalogue import effect_names
from plumb.model.predict import Array
from plumb.text.values import bare, worded

LEVEL = 0.99  # of the checks of an unchanged machine hold; a recheck by the diary goes by it too


@dataclass(frozen=True)
class CheckedMark:
    """A check mark [mm]."""

    name: str
    target: tuple[float, float]
    predicted: tuple[float, float]  # where the fit says that it is
    measured: tuple[float, float]
    promised: float  # how far off 99 of 100 such readings are at most
    off: float  # how far the reading is from the prediction
    error: float  # how far it is from its target
    is_within: bool


@dataclass(frozen=True)
class CheckRound:
    """All check marks of a round."""

    marks: tuple[CheckedMark, ...]
    chi_square: float  # of all coordinates together
    sigma: float  # [mm] of a reading

    @property
    def limit(self) -> float:
        """Of chi-square."""
        return float(scipy.special.chdtri(2 * len(self.marks), 1 - LEVEL))

    @property
    def holds(self) -> bool:
        """Whether the marks are where the fit promises them."""
        return self.chi_square <= self.limit


def check_marks(inputs: Inputs, marks: Measurements) -> CheckRound:
    """Hold check marks against the fit of these inputs, with the effects that its settings have.

    Raises InputError for too few marks, and for marks that cannot be reached.
    """
    record = inputs.settings.fitted
    effects = [name for name in effect_names() if record and name in record.effects]
    board = measured_board(inputs)
    sigma = posterior_of(board, inputs.stated).noise.sigma
    fitted = explain(board.with_rows(board.rows, sigma=sigma), tuple(effects))
    in_force = marks.rounds[0].cut_with or inputs.settings
    _, rows = model_and_observations(inputs.settings, marks, cut_with=in_force)
    rows = _on_last_sheet(rows, board.rows)
    where, covariances = _predicted(fitted, rows)
    missed = rows.measured - where
    distances = np.einsum("ni,nij,nj->n", missed, np.linalg.inv(covariances), missed)
    return CheckRound(
        marks=tuple(
            CheckedMark(
                name=rows.names[i],
                target=_point(rows.targets[i]),
                predicted=_point(where[i]),
                measured=_point(rows.measured[i]),
                promised=_reach(covariances[i]),
                off=float(np.hypot(*missed[i])),
                error=float(np.hypot(*(rows.measured[i] - rows.targets[i]))),
                is_within=bool(distances[i] <= scipy.special.chdtri(2, 1 - LEVEL)),
            )
            for i in range(len(where))
        ),
        chi_square=_chi_square(fitted, rows, missed),
        sigma=sigma,
    )


def _predicted(fitted: Explanation, rows: Observations) -> tuple[Array, Array]:
    """Return where the marks are (n, 2) [mm], and the covariance (n, 2, 2) [mm²] of a reading
    there.
    """
    where, moved = _sighting(fitted, rows)
    noise = fitted.board.sigma**2 * np.eye(2)
    covariances: Array = np.einsum("nij,jk,nlk->nil", moved, fitted.covariance, moved) + noise
    return where, covariances


def _chi_square(fitted: Explanation, rows: Observations, missed: Array) -> float:
    """Return how far off the marks are together; what they share of the fit is counted."""
    _, moved = _sighting(fitted, rows)
    flat = moved.reshape(-1, moved.shape[2])
    whole = flat @ fitted.covariance @ flat.T + fitted.board.sigma**2 * np.eye(len(flat))
    return float(missed.ravel() @ np.linalg.solve(whole, missed.ravel()))


def _sighting(fitted: Explanation, rows: Observations) -> tuple[Array, Array]:
    """Return where the fit has the marks (n, 2) [mm], and by how much its numbers move them (n, 2,
    f).
    """
    problem, free = fitted.board.problem, fitted.free
    values, outside = problem.values(fitted.unknowns)
    names = tuple(problem.names[column] for column in free)
    seen = sighted(
        values,
        outside,
        rows,
        over_top=problem.settings.feed == "top",
        usual_weight=problem.settings.sled_weight,
        names=names,
    )
    return seen.read.where[rows.mark_rows], seen.read.slopes[rows.mark_rows] * problem.scale[free]


def _on_last_sheet(rows: Observations, fitted: Observations) -> Observations:
    """Return the check marks on the sheet and with the zeros of the last round that was fitted."""
    sheet, zero = int(fitted.sheet_groups.max()), int(fitted.zero_groups.max())
    return replace(
        rows,
        sheet_groups=np.full_like(rows.sheet_groups, sheet),
        zero_groups=np.full_like(rows.zero_groups, zero),
    )


def _reach(covariance: Array) -> float:
    """Return the radius that holds at least 99 of 100 readings [mm]."""
    longest = float(np.linalg.eigvalsh(covariance)[-1])
    return float(np.sqrt(scipy.special.chdtri(2, 1 - LEVEL) * longest))


def _point(pair: Array) -> tuple[float, float]:
    return float(pair[0]), float(pair[1])


# Whether check marks are where the settings promise them, in a sentence for people.


def check_sentence(checked: CheckRound) -> str:
    """Return what was promised, what was measured, and what follows."""
    off = ", ".join(bare(mark.off) for mark in checked.marks)
    promised = worded(max(mark.promised for mark in checked.marks))
    measured = f"Promised: within {promised}. Measured: off from what was promised by {off}."
    if checked.holds:
        return f"{measured} The settings hold."
    far = " and ".join(mark.name for mark in checked.marks if not mark.is_within)
    which = f"mark {far}" if far else "both marks together"
    return (
        f"{measured} More than noise, at {which}: read it again. If it stays, the settings miss "
        "something, or the machine has changed."
    )
