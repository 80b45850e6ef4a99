"""What the bench of the lab draws of a board: its errors in chain, covariates, suspects.

Marks hang where the frame's fit has them. A few mm more or less turn no chain, so dots only rise
and fall when an effect is added.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import cached_property

import numpy as np

from plumb.cure.live_board import Chosen, LiveBoard
from plumb.diagnosis.explanation import Board, Explanation, explain
from plumb.diagnosis.suspect_curves import SuspectCurves, seen_by, suspect_curves
from plumb.fit.chain_view import chain_errors, hung_places
from plumb.fit.covariates import Covariate, covariates
from plumb.fit.problem import USUAL_SIGMA
from plumb.model.predict import Array


@dataclass(frozen=True)
class Drawn:
    """What an effect by itself adds to the frame's fit."""

    moved: Array  # (k, 2) [mm] of the marks on the sheet
    curves: SuspectCurves


class BoardView:
    """The view of a board."""

    def __init__(self, board: LiveBoard) -> None:
        rows = board.rows
        self.board = board
        self.model = board.fit(Chosen()).settings
        self._places = hung_places(self.model, rows)[rows.mark_rows]

    @cached_property
    def covariates(self) -> tuple[Covariate, ...]:
        """Those of the marks."""
        marked = self.board.rows.mark_rows
        return tuple(
            replace(each, values=each.values[marked])
            for each in covariates(self.model, self.board.rows)
        )

    def chains(self, errors: Array) -> Array:
        """Errors of the marks (k, 2) [mm] as those of left and right chain; nan: out of reach."""
        rows = self.board.rows
        return chain_errors(self.model, self._places, errors, rows.sled_weights[rows.mark_rows])

    def drawn(self, effect: str) -> Drawn:
        """What an effect draws into the marks once the frame is refitted with it."""
        frame, rows = self._frame, self.board.rows
        explanation = explain(frame.board, (effect,), start=frame)
        moved = seen_by(explanation, rows).read.where - seen_by(frame, rows).read.where
        curves = suspect_curves(frame, explanation, rows)
        return Drawn(np.asarray(moved[rows.mark_rows]), curves)

    @cached_property
    def _frame(self) -> Explanation:
        inputs, noise = self.board.inputs, self.board.noise
        board = Board.of(
            self.board.model,
            self.board.rows,
            sigma=noise.sigma or USUAL_SIGMA,
            priors=inputs.priors,
            checked=inputs.checked,
        )
        return explain(board)
