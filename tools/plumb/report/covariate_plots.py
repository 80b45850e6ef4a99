"""The covariate sheet: what the frame leaves of each chain, against all that it may depend on."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plumb.diagnosis.suspect_curves import SuspectCurves
from plumb.fit.compare import ChainView
from plumb.fit.covariates import Covariate
from plumb.pictures.sheet import MANY
from plumb.report.maps import DASHES, SUSPECTS, inline, light
from plumb.text.values import in_unit, unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = np.ndarray
WIDE, HIGH = 2.75, 2.05  # [inch]
SIDES = ("left", "right")
# What people read, by the name of the covariate.
TITLES = {
    "tension": "tension",
    "length": "free length",
    "angle": "angle below level",
    "phase": "turn of the sprocket",
    "wrap": "chain on the sprocket",
    "x": "x on the sheet",
    "y": "y on the sheet",
    "order": "order in the file",
    "approach": "side of the approach",
}
QUARTERS = (-180, -90, 0, 90, 180)  # [degree]
HEADINGS = ("left", "down", "right", "up", "left")  # of the last move
SAME = 1e-3  # spread below which a covariate is the same for all marks
CIRCLED = ("phase",)  # the sprocket's turn ends where it begins


@dataclass(frozen=True)
class Plot:
    """A picture of a chain against a covariate."""

    title: str
    svg: str


@dataclass(frozen=True)
class CovariateSheet:
    """All pictures, and what is not drawn and why."""

    plots: tuple[Plot, ...]
    left_out: tuple[str, ...]


def covariate_sheet(
    view: ChainView,
    by_visit: Sequence[Covariate],
    rows: Array,
    curves: Sequence[SuspectCurves],
    *,
    sigma: float,
) -> CovariateSheet:
    """Return the errors of `view`, whose marks are the visits in `rows`; the curves of the suspects
    over them, and a band of two sigmas [mm] around zero.
    """
    plots, left_out = [], []
    most = _most(view, curves, sigma)
    for covariate in by_visit:
        reason = _reason_against(covariate, rows)
        if reason:
            left_out.append(reason)
            continue
        for side in (0, 1):
            title = f"{SIDES[side].capitalize()} chain, {TITLES[covariate.name]}"
            svg = _plot(view, covariate, rows, side, curves, sigma=sigma, most=most, title=title)
            plots.append(Plot(title, svg))
    return CovariateSheet(tuple(plots), tuple(left_out))


def _most(view: ChainView, curves: Sequence[SuspectCurves], sigma: float) -> float:
    """Half the height of all plots [mm], which have it in common."""
    sizes = [np.abs(view.chains).ravel(), *(np.abs(each.chains).ravel() for each in curves)]
    return 1.1 * float(np.nanmax([2.2 * sigma, *np.concatenate(sizes)]))


def _reason_against(covariate: Covariate, rows: Array) -> str:
    """Why a covariate has no picture; empty if it has."""
    values = covariate.values[rows]
    title = TITLES[covariate.name]
    if not np.isfinite(values).any():
        return f"{title}: the marks do not say it"
    if np.nanmax(values) - np.nanmin(values) < SAME:
        return f"{title}: the same for all marks"
    return ""


def _plot(
    view: ChainView,
    covariate: Covariate,
    rows: Array,
    side: int,
    curves: Sequence[SuspectCurves],
    *,
    sigma: float,
    most: float,
    title: str,
) -> str:
    from matplotlib.figure import Figure

    name = f"{covariate.name} {SIDES[side]}"
    at, factor = shown_values(covariate, rows, side)
    figure = Figure(figsize=(WIDE, HIGH))
    axis = figure.add_axes((0.17, 0.22, 0.8, 0.65))
    limit = in_unit(most)
    axis.set_ylim(-limit, limit)
    band = in_unit(2 * sigma)
    axis.axhspan(-band, band, color=light("band"), lw=0, zorder=0)
    axis.axhline(0, color=light("soft"), lw=0.8, zorder=1)
    _draw_curves(axis, covariate, at, factor, side, curves)
    axis.plot(
        at,
        in_unit(1.0) * view.chains[:, side],
        "o",
        color=light("ink"),
        markersize=4.2 if len(at) <= MANY else 2.4,
        markeredgecolor=light("paper"),
        markeredgewidth=0.5,
        zorder=5,
    )
    _dress(axis, covariate, title)
    return inline(figure, says=f"{title}: error of the chain in {unit()}", name=name)


def shown_values(covariate: Covariate, rows: Array, side: int) -> tuple[Array, float]:
    """Return the covariate of the marks as it is drawn, and how many times its house unit
    that is.
    """
    factor = {"rad": 180 / np.pi, "mm": in_unit(1.0)}.get(covariate.unit, 1.0)
    return factor * covariate.values[rows, side], factor


def _draw_curves(
    axis: Axes,
    covariate: Covariate,
    at: Array,
    factor: float,
    side: int,
    curves: Sequence[SuspectCurves],
) -> None:
    """Draw each suspect's curve with its spread; where places have none, its points at the
    marks.
    """
    scale = in_unit(1.0)
    drawn = zip(curves, SUSPECTS, DASHES, strict=False)
    for i, (suspect, colour, dash) in enumerate(drawn):
        if covariate.name in suspect.curves:
            curve = suspect.curves[covariate.name][side]
            axis.fill_between(
                factor * curve.at,
                scale * curve.low,
                scale * curve.high,
                color=light(colour),
                alpha=0.16,
                lw=0,
                zorder=2,
            )
            axis.plot(
                factor * curve.at,
                scale * curve.middle,
                color=light(colour),
                lw=1.8,
                ls=dash,
                zorder=4,
            )
        elif len(at) <= MANY:
            axis.plot(
                at,
                scale * suspect.chains[:, side],
                "Ds^"[i],
                color=light(colour),
                fillstyle="none",
                markersize=4.5,
                markeredgewidth=1.1,
                zorder=4,
            )


def _dress(axis: Axes, covariate: Covariate, title: str) -> None:
    """Write the words and ticks of a plot."""
    ink, soft = light("ink"), light("soft")
    axis.set_title(title, fontsize=8.5, color=ink, loc="left", pad=5)
    shown_unit = {"rad": "degrees", "mm": unit(), "N": "N"}.get(covariate.unit, "")
    label = {"order": "number of the mark", "approach": "the last move went"}
    axis.set_xlabel(label.get(covariate.name, shown_unit), fontsize=7.5, color=soft, labelpad=2)
    axis.set_ylabel(unit(), fontsize=7.5, color=soft, labelpad=1)
    axis.tick_params(labelsize=7.5, colors=soft, labelcolor=soft, length=2.5)
    axis.locator_params(axis="both", nbins=5)
    if covariate.name == "approach":
        axis.set_xticks(QUARTERS, HEADINGS)
        axis.set_xlim(-200, 200)
    if covariate.name in CIRCLED:
        axis.set_xticks((0, 90, 180, 270, 360))
        axis.set_xlim(-8, 368)
    for edge in ("top", "right"):
        axis.spines[edge].set_visible(False)
    for edge in ("left", "bottom"):
        axis.spines[edge].set_color(light("rule"))
