"""How far off a job would be with the fitted settings: what the marks leave open, place by place.

Two things are counted: how well the marks and the priors settle the numbers of the explanation
that is used, and how far its rivals would lead elsewhere, each by its share. What no explanation
has is not counted.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from plumb.board.observations import Observations
from plumb.board.visits import visited
from plumb.diagnosis.explanation import Explanation
from plumb.diagnosis.suspect_curves import model_by
from plumb.model.predict import FOUND, NAMES, Array, lengths

COLUMNS, ROWS = 41, 21  # places of the sheet


@dataclass(frozen=True)
class ExpectedError:
    """One standard deviation of the sled's place, x and y together, all over the sheet."""

    x: Array  # (COLUMNS,) [mm]
    y: Array  # (ROWS,) [mm] from the top down
    sigma: Array  # (ROWS, COLUMNS) [mm]; nan where no chain reaches

    @property
    def rms(self) -> float:
        """Over all places that are reached [mm]."""
        return float(np.sqrt(np.nanmean(self.sigma**2)))

    @property
    def worst(self) -> float:
        """At the worst place [mm]."""
        return float(np.nanmax(self.sigma))


def expected_error(
    used: Explanation, rivals: Sequence[tuple[Explanation, float]] = ()
) -> ExpectedError:
    """The error to expect of a machine set as `used` says; rivals with their shares of what is
    likely, the rest being the share of `used`."""
    width, height = model_by(used).sheet
    x = np.linspace(-width / 2, width / 2, COLUMNS)
    y = np.linspace(height / 2, -height / 2, ROWS)
    places = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    chains, outcome = lengths(model_by(used), places)
    where, slopes, hanging = hung(used, chains)
    variance = _variance(used, slopes)
    good = (outcome == FOUND) & (hanging == FOUND)
    for rival, share in rivals:
        elsewhere, _, reached = hung(rival, chains)
        variance += share * np.sum((elsewhere - where) ** 2, axis=1)
        good &= reached == FOUND
    sigma = np.where(good, np.sqrt(variance), np.nan).reshape(ROWS, COLUMNS)
    return ExpectedError(x, y, sigma)


def hung(explanation: Explanation, chains: Array) -> tuple[Array, Array, Array]:
    """Where the sled hangs (n, 2) [mm] with these chains, slopes by NAMES (n, 2, v), and FOUND."""
    problem = explanation.board.problem
    values, _ = problem.values(explanation.unknowns)
    usual = problem.settings.sled_weight
    return visited(
        values,
        _visits(chains, usual),
        over_top=problem.settings.feed == "top",
        usual_weight=usual,
    )


def _variance(explanation: Explanation, slopes: Array) -> Array:
    """Of a place (n,) [mm²] by the machine's numbers as the explanation settles them."""
    problem, free = explanation.board.problem, explanation.free
    columns = explanation.slopes[:, free]
    covariance = np.linalg.pinv(columns.T @ columns, rcond=1e-12, hermitian=True)
    # The sheet's rotation, the tape and the like do not move the sled.
    machine = [i for i, column in enumerate(free) if problem.names[column] in NAMES]
    by_name = slopes[:, :, [NAMES.index(problem.names[free[i]]) for i in machine]]
    moved = by_name * problem.scale[free[machine]]
    inside = covariance[np.ix_(machine, machine)]
    variance: Array = np.einsum("nij,jk,nik->n", moved, inside, moved)
    return variance


def _visits(chains: Array, weight: float) -> Observations:
    """Visits (n,) with these chains and the usual sled, of which nothing is read."""
    count = len(chains)
    none = np.zeros((0, 2))
    first = np.zeros(count, dtype=int)
    return Observations(
        chains=chains,
        sled_weights=np.full(count, weight),
        mark_rows=np.zeros(0, dtype=int),
        measured=none,
        targets=none,
        names=(),
        distance_rows=np.zeros((0, 2), dtype=int),
        distances=np.zeros(0),
        distance_rounds=np.zeros(0, dtype=int),
        approaches=np.zeros((count, 2)),
        rounds=first,
        zero_groups=first,
        sheet_groups=first,
        swapped=np.zeros(count, dtype=bool),
    )
