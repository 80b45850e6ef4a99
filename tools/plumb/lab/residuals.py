"""Residuals as the page draws them: on the sheet, and in chain."""

import math
from collections.abc import Collection, Sequence
from typing import Any, TypeVar

from pydantic import BaseModel, ConfigDict

from plumb.cure.add import BoardView
from plumb.diagnosis.readings import NOTHING_DOUBTED, Doubts
from plumb.fit.compare import ComparedMark, Comparison
from plumb.fit.fit import Fit
from plumb.marks.read import Measurements
from plumb.model.predict import Array

Pair = tuple[float, float]
Ends = tuple[float | None, float | None]  # left and right; None for what is not known
NO_ENDS: Ends = (None, None)
Value = TypeVar("Value")


class Span(BaseModel):
    """A distance that was measured [mm]."""

    between: tuple[str, str]
    ends: tuple[Pair, Pair]  # the targets of its marks, machine frame
    measured: float


class Readings(BaseModel):
    """The readings of a board, and those to be looked at again."""

    model_config = ConfigDict(json_schema_serialization_defaults_required=True)
    marks: tuple[ComparedMark, ...] = ()
    spans: list[Span] = []
    sigma: float = 0.0  # [mm] of a reading
    doubted: list[int] = []  # marks that no fit sees
    doubted_spans: list[int] = []


class State(BaseModel):
    """The readings against a machine: as it is set, or fitted [mm]; None for a reading that took
    no part in the fit.
    """

    title: str
    fit_rms: float
    noise_rms: float | None  # that noise alone would leave
    errors: list[Pair | None]
    spans: list[float | None]  # errors of the distances
    chains: list[Ends]


def readings_of(
    measurements: Measurements, raw: Comparison, sigma: float, doubts: Doubts = NOTHING_DOUBTED
) -> dict[str, Any]:
    """Return the fields of Readings; `sigma` [mm] of a reading."""
    return {
        "marks": raw.marks,
        "spans": _spans(measurements),
        "sigma": sigma,
        "doubted": list(doubts.marks),
        "doubted_spans": list(doubts.spans),
    }


def _spans(measurements: Measurements) -> list[Span]:
    """Return the distances with the places of their ends."""
    places: dict[str, Pair] = {}
    for mark in measurements.marks:
        places.setdefault(mark.name, mark.target)
    return [
        Span(
            between=each.between,
            ends=(places[each.between[0]], places[each.between[1]]),
            measured=each.length,
        )
        for each in measurements.distances
    ]


def as_set(raw: Comparison, *, title: str = "as set", doubts: Doubts = NOTHING_DOUBTED) -> State:
    """Return the marks against the settings as they stand. What is doubted does not count."""
    return State(
        title=title,
        fit_rms=doubts.rms(raw),
        noise_rms=None,
        errors=[mark.error for mark in raw.marks],
        spans=[each.error for each in raw.distances],
        chains=[(mark.left_chain_residual, mark.right_chain_residual) for mark in raw.marks],
    )


def fitted_state(
    title: str, fitted: Fit, view: BoardView, doubts: Doubts = NOTHING_DOUBTED
) -> State:
    """Return what a fit leaves of the readings of a board, from which what is doubted was left
    out.
    """
    errors: list[Pair | None] = [*pairs(fitted.errors)]
    spans: list[float | None] = [*fitted.distance_errors.tolist()]
    return State(
        title=title,
        fit_rms=fitted.rms,
        noise_rms=fitted.noise_rms,
        errors=among_all(errors, doubts.marks, None),
        spans=among_all(spans, doubts.spans, None),
        chains=among_all(ends(view.chains(fitted.errors)), doubts.marks, NO_ENDS),
    )


def among_all(sure: Sequence[Value], doubted: Collection[int], nothing: Value) -> list[Value]:
    """Return what is said of sure readings in the places of all readings."""
    said = iter(sure)
    count = len(sure) + len(doubted)
    return [nothing if i in doubted else next(said) for i in range(count)]


def pairs(values: Array) -> list[Pair]:
    """Return vectors as the page reads them."""
    return [(float(x), float(y)) for x, y in values]


def ends(values: Array) -> list[Ends]:
    """Return left and right."""
    return [(_known(left), _known(right)) for left, right in values]


def _known(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
