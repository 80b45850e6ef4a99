"""What the page draws of residuals: on the sheet, in chain, and against noise."""

from __future__ import annotations

import math
from collections.abc import Collection, Sequence

import numpy as np
from pydantic import BaseModel

from plumb.cure.live_board import BoardView
from plumb.fit.compare import Comparison
from plumb.fit.fit import Fit
from plumb.fit.quantiles import quantiles
from plumb.model.predict import Array

Pair = tuple[float, float]
Ends = tuple[float | None, float | None]  # left and right; None for what is not known
MICROMETRE = 3  # decimals of a mm


class Ranked(BaseModel):
    """The coordinates of residuals, the smallest first, against noise [mm]."""

    order: list[int]  # whose coordinate each is: 2 * mark + 0 for x, + 1 for y
    at: list[float]  # what noise alone would make of it
    low: list[float]  # noise leaves this band with no point, 95 times of 100
    high: list[float]
    beyond: list[bool]  # whether it lies outside of the band


class State(BaseModel):
    """The marks against a machine: as it is set, or fitted [mm]."""

    title: str
    fit_rms: float
    noise_rms: float | None  # that noise alone would leave
    errors: list[Pair]
    chains: list[Ends]
    ranked: Ranked


def as_set(
    raw: Comparison, sigma: float, *, title: str = "as set", doubted: Sequence[int] = ()
) -> State:
    """Return the marks against the settings as they stand; sigma [mm] is that of a reading. What is
    doubted does not count.
    """
    sure = [math.hypot(*mark.error) for i, mark in enumerate(raw.marks) if i not in doubted]
    return State(
        title=title,
        fit_rms=math.sqrt(np.mean(np.square(sure))) if doubted and sure else raw.rms,
        noise_rms=None,
        errors=[mark.error for mark in raw.marks],
        chains=[(mark.left_chain_residual, mark.right_chain_residual) for mark in raw.marks],
        ranked=_ranked(np.array([mark.error for mark in raw.marks]), math.sqrt(2) * sigma),
    )


def doubted_marks(
    raw: Comparison, doubted: Collection[tuple[str, tuple[float, ...] | None]]
) -> list[int]:
    """Return which of the marks have these readings, by name and place."""
    return [i for i, mark in enumerate(raw.marks) if (mark.name, mark.measured) in doubted]


def fitted_state(title: str, fitted: Fit, view: BoardView) -> State:
    """Return what a fit leaves of the marks of a board."""
    return State(
        title=title,
        fit_rms=fitted.rms,
        noise_rms=fitted.noise_rms,
        errors=pairs(fitted.errors),
        chains=ends(view.chains(fitted.errors)),
        ranked=_ranked(fitted.errors, fitted.noise_rms),
    )


def _ranked(errors: Array, noise_rms: float) -> Ranked:
    """Residuals (k, 2) [mm] against noise that leaves this much of their vectors [mm]."""
    placed = quantiles(errors.reshape(-1, 2), noise_rms)
    return Ranked(
        order=placed.order.tolist(),
        at=placed.at.round(MICROMETRE).tolist(),
        low=placed.low.round(MICROMETRE).tolist(),
        high=placed.high.round(MICROMETRE).tolist(),
        beyond=placed.beyond.tolist(),
    )


def pairs(values: Array) -> list[Pair]:
    """Return vectors as the page reads them."""
    return [(float(x), float(y)) for x, y in values]


def ends(values: Array) -> list[Ends]:
    """Return left and right."""
    return [(_known(left), _known(right)) for left, right in values]


def _known(value: float) -> float | None:
    return float(value) if math.isfinite(value) else None
