"""Errors of the chains that an explanation draws, mark by mark and over the whole sheet.

An explanation refits the frame, so it changes what the frame alone leaves. That change is what the
marks can show of it: its dots at the marks, and its curve against each covariate.
"""

from collections.abc import Mapping
from dataclasses import dataclass

import numpy as np

from plumb.diagnosis.explanation import Explanation
from plumb.fit.compare import chain_errors, hung_places
from plumb.fit.covariates import Covariate, covariates
from plumb.fit.observations import Observations, chains_to
from plumb.fit.sighting import Sighting, sighted
from plumb.model.plain import ascending
from plumb.model.predict import FOUND, Array, settings_of
from plumb.settings.machine import MachineSettings
from plumb.text.answers import Series

COLUMNS, ROWS = 41, 21  # places of the sheet behind a curve
BINS = 12  # of a curve, each with about as many places
WITHOUT_CURVE = ("order", "approach")  # they belong to visits, not to places
SAME_PLACE = 1.0  # [mm] between marks that were visited in several ways


@dataclass(frozen=True)
class Curve:
    """Curve of an explanation on a chain against a covariate, over the whole sheet [mm]."""

    at: Series  # (b,) of the covariate, rising
    middle: Series  # (b,) mean
    low: Series  # (b,) four fifths of the places lie between low and high
    high: Series  # (b,)


@dataclass(frozen=True)
class SuspectCurves:
    """Chain that an explanation adds to the frame's fit."""

    moved: Array  # (k, 2) [mm] of the marks on the sheet
    chains: Array  # (k, 2) [mm] at the marks, left and right
    curves: Mapping[str, tuple[Curve, Curve]]  # by covariate, left and right


def suspect_curves(
    frame: Explanation, explanation: Explanation, rows: Observations
) -> SuspectCurves:
    """Return what an explanation adds to the frame's fit at the marks of `rows`, and over the
    sheet.
    """
    model = model_by(frame)
    sheet = visits_all_over(model, rows)
    by_place = covariates(model, sheet)
    drawn = added_chains(frame, explanation, sheet)
    return SuspectCurves(
        moved=_moved(frame, explanation, rows)[rows.mark_rows],
        chains=added_chains(frame, explanation, rows)[rows.mark_rows],
        curves={
            covariate.name: _curves(covariate, drawn)
            for covariate in by_place
            if covariate.name not in WITHOUT_CURVE
        },
    )


def added_chains(frame: Explanation, explanation: Explanation, rows: Observations) -> Array:
    """Return what an explanation says more than the frame's fit (r, 2) [mm] on each visit, in
    chain.
    """
    model = model_by(frame)
    moved = _moved(frame, explanation, rows)
    return chain_errors(model, hung_places(model, rows), moved, rows.sled_weights)


def _moved(frame: Explanation, explanation: Explanation, rows: Observations) -> Array:
    """Return the same on the sheet (r, 2) [mm]."""
    return np.asarray(seen_by(explanation, rows).read.where - seen_by(frame, rows).read.where)


def model_by(explanation: Explanation) -> MachineSettings:
    """Return the machine as an explanation has it."""
    problem = explanation.board.problem
    values, _ = problem.values(explanation.unknowns)
    return settings_of(values, like=problem.settings)


def seen_by(explanation: Explanation, rows: Observations) -> Sighting:
    """Return what an explanation says is measured on each visit."""
    problem = explanation.board.problem
    values, outside = problem.values(explanation.unknowns)
    return sighted(
        values,
        outside,
        rows,
        over_top=problem.settings.feed == "top",
        usual_weight=problem.settings.sled_weight,
        names=(),
    )


def visits_all_over(model: MachineSettings, rows: Observations) -> Observations:
    """Visits all over the sheet. Each is made in the way of the nearest mark: its sled, its
    approach, its round. Places that no chain reaches are left out."""
    across = np.linspace(-model.sheet_width / 2, model.sheet_width / 2, COLUMNS)
    up = np.linspace(-model.sheet_height / 2, model.sheet_height / 2, ROWS)
    places = np.stack(np.meshgrid(across, up), axis=-1).reshape(-1, 2)
    like = _nearest(hung_places(model, rows), places)
    chains, outcome = chains_to(model, places, rows.sled_weights[like])
    good = outcome == FOUND
    like, places, chains = like[good], places[good], chains[good]
    count = len(places)
    return Observations(
        chains=chains,
        sled_weights=rows.sled_weights[like],
        mark_rows=np.arange(count),
        measured=places,
        targets=places,
        names=("",) * count,
        approaches=rows.approaches[like],
        rounds=rows.rounds[like],
        zero_groups=rows.zero_groups[like],
        sheet_groups=rows.sheet_groups[like],
        swapped=rows.swapped[like],
    )


def _nearest(visited: Array, places: Array) -> Array:
    """Return the visit (n,) nearest to each place; visits of the same place take turns."""
    gaps = np.linalg.norm(places[:, np.newaxis] - visited, axis=2)
    near = gaps <= gaps.min(axis=1, keepdims=True) + SAME_PLACE
    chosen = [np.flatnonzero(row)[i % int(row.sum())] for i, row in enumerate(near)]
    return np.array(chosen, dtype=int)


def _curves(covariate: Covariate, drawn: Array) -> tuple[Curve, Curve]:
    left, right = (_curve(covariate.values[:, side], drawn[:, side]) for side in (0, 1))
    return left, right


def _curve(at: Array, drawn: Array) -> Curve:
    """Mean and spread in bins of about as many places."""
    known = np.isfinite(at) & np.isfinite(drawn)
    order = ascending(at[known])
    bins = [part for part in np.array_split(order, BINS) if len(part)]
    inside = [drawn[known][part] for part in bins]
    return Curve(
        at=np.array([at[known][part].mean() for part in bins]),
        middle=np.array([part.mean() for part in inside]),
        low=np.array([np.quantile(part, 0.1) for part in inside]),
        high=np.array([np.quantile(part, 0.9) for part in inside]),
    )
