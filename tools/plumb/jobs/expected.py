"""The error to expect of each part, from measured marks: how much too wide, high or askew.

The machine is taken as the marks leave it: the frame within its priors, and every effect of the
library at a size that real machines have. So the spread holds what the fit leaves open and what
could still hide. A part is compared with the program by the straight map that takes one to the
other; its shift and its turn say where it lies, not how it fits.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
import scipy

from plumb.diagnosis.clean import clean_readings
from plumb.diagnosis.linear_board import largest_met
from plumb.diagnosis.measured import measured_board
from plumb.fit.inputs import Inputs
from plumb.fit.problem import Problem
from plumb.jobs.parts import Part
from plumb.model.predict import FOUND, NAMES, Array, lengths, places_with_slopes
from plumb.settings.machine import MachineSettings

SPREAD = 0.3  # of an effect's size, as a share of the largest that was met
NARROW = 20.0  # [mm] below this a part is too small for its errors to be seen
MOST = 400  # places of a part that are asked for
TWO_SIDED = 1.96  # sigmas of 95 %


@dataclass(frozen=True)
class Error:
    """An error of a part, and how far it may be off [mm]."""

    mm: float
    within: float  # 95 %


@dataclass(frozen=True)
class PartErrors:
    """How a part will differ from its program."""

    width: Error | None  # positive: too wide; None: too narrow to be seen
    height: Error | None
    skew: Error | None  # how far the top lies too far to the right of the bottom


@dataclass(frozen=True)
class Believed:
    """The machine as the marks leave it: a normal about a linearized problem."""

    problem: Problem
    about: Array  # (u,) unknowns of the linearization
    mean: Array  # (u,) to add to them
    root: Array  # (u, u) root @ root.T is the covariance

    @staticmethod
    def of(inputs: Inputs) -> Believed:
        """Refit the frame, then let every effect act within what real machines have."""
        board = measured_board(inputs)
        frame = clean_readings(board, inputs).frame
        board = frame.board
        held = np.asarray(board.problem.held, dtype=bool)
        kept = np.ones(len(frame.residual), dtype=bool)
        count = board.rows.count
        kept[count : count + int(held.sum())] = False
        effects = np.flatnonzero(~held)
        precision = np.ones(len(held))
        precision[effects] = 1 / (SPREAD * largest_met(board, effects)) ** 2
        slopes = frame.slopes[kept]
        information = slopes.T @ slopes + np.diag(precision)
        pull = slopes.T @ frame.residual[kept] - precision * frame.unknowns
        lower = scipy.linalg.cholesky(information, lower=True)
        mean = scipy.linalg.cho_solve((lower, True), pull)
        root = scipy.linalg.solve_triangular(lower.T, np.eye(len(held)))
        return Believed(board.problem, frame.unknowns, mean, root)

    def seen(self, settings: MachineSettings, places: Array) -> tuple[Array, Array]:
        """Errors (n, 2) [mm] of places that a machine with these settings is sent to, and how they
        change with the unknowns (n, 2, u)."""
        chains, outcome = lengths(settings.as_plumb_model(), places)
        values, _ = self.problem.values(self.about)
        over_top = self.problem.settings.feed == "top"
        where, by_value, reached = places_with_slopes(values, over_top=over_top, chains=chains)
        by_name = np.zeros((*where.shape, len(self.problem.names)))
        for column, name in enumerate(self.problem.names):
            if name in NAMES:
                by_name[:, :, column] = by_value[:, :, NAMES.index(name)]
        by_name *= self.problem.scale
        hangs = (outcome == FOUND) & (reached == FOUND)
        errors = where - places + by_name @ self.mean
        return errors[hangs], by_name[hangs]


def errors_of(
    believed: Believed, settings: MachineSettings, parts: Sequence[Part]
) -> tuple[PartErrors, ...]:
    """The error to expect of each part, cut with these settings."""
    return tuple(_errors_of(believed, settings, part) for part in parts)


def _errors_of(believed: Believed, settings: MachineSettings, part: Part) -> PartErrors:
    places = part.places[:: max(1, len(part.places) // MOST)]
    width, height = part.size
    errors, slopes = believed.seen(settings, places)
    if len(errors) < len(places) or max(width, height) < NARROW:
        return PartErrors(None, None, None)
    # error = shift + matrix @ (place - middle), by least squares: a row for each number of it.
    middle = places - places.mean(axis=0)
    fit = np.linalg.pinv(np.column_stack([np.ones(len(places)), middle]))
    stretch = np.einsum("jn,nk->jk", fit[1:], errors)  # [by place, of error]
    by_unknown = np.einsum("jn,nku->jku", fit[1:], slopes) @ believed.root
    wide, high = width >= NARROW, height >= NARROW
    return PartErrors(
        width=_error(width * stretch[0, 0], width * by_unknown[0, 0]) if wide else None,
        height=_error(height * stretch[1, 1], height * by_unknown[1, 1]) if high else None,
        skew=_error(
            height * (stretch[0, 1] + stretch[1, 0]), height * (by_unknown[0, 1] + by_unknown[1, 0])
        )
        if wide and high
        else None,
    )


def _error(mm: float, spread: Array) -> Error:
    return Error(float(mm), TWO_SIDED * float(np.linalg.norm(spread)))
