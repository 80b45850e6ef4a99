"""The owner of a board of the bench: measures more of the same machine, as it is proposed."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from plumb.bench.boards import BoardCut
from plumb.bench.causes import CHAIN, MAKER
from plumb.diagnosis import Checked
from plumb.plan.ahead import Check
from plumb.plan.planned_visits import Visits

Array = np.ndarray


@dataclass(frozen=True)
class BoardOwner:
    """Somebody with a machine of the bench, its sheet and a tape."""

    source: np.random.Generator
    noise: float  # [mm] of a coordinate

    def with_marks(self, board: BoardCut, visits: Visits) -> BoardCut:
        """The board with the marks of these visits as well, on the same sheet.

        Raises ValueError where the sled cannot hang.
        """
        where = np.zeros((len(visits), 2))
        for swapped in (False, True):
            mine = visits.swapped == swapped
            where[mine] = replace(board.machine, swapped=swapped).read(
                visits.chains[mine],
                approaches=visits.approaches[mine],
                weights=visits.sled_weights[mine],
            )
        if not np.isfinite(where).all():
            raise ValueError("the sled cannot hang where it is sent")
        where = where + self.noise * self.source.standard_normal(where.shape)
        marks = tuple(visits.marks(where))
        measurements = board.measurements
        return replace(
            board, measurements=replace(measurements, marks=(*measurements.marks, *marks))
        )

    def checked(self, board: BoardCut, checks: Sequence[Check]) -> list[Checked]:
        """What direct measurements find, each with its error."""
        return [
            Checked(
                check.name,
                true_value(board, check.name) + check.sigma * float(self.source.standard_normal()),
                check.sigma,
            )
            for check in checks
        ]


def true_value(board: BoardCut, name: str) -> float:
    """What a perfect measurement of a number of the frame or of an effect would find."""
    if "." in name:
        return float(board.machine.hidden.parameters.get(name, CHAIN.get(name, 0.0)))
    return float(getattr(board.machine, name, getattr(MAKER, name, 0.0)))
