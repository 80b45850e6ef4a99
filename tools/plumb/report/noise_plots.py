"""What a fit leaves against noise: each coordinate, and what noise alone would make of it."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plumb.fit.fit import Fit
from plumb.fit.quantiles import Quantiles, quantiles
from plumb.pictures.sheet import MANY
from plumb.report.maps import inline, light
from plumb.text.values import in_unit, unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDE, HIGH = 3.6, 2.6  # [inch]


@dataclass(frozen=True)
class NoisePlot:
    """A picture of a fit's residuals against noise, and how many coordinates are beyond it."""

    title: str
    svg: str


def noise_plots(fits: dict[str, Fit]) -> tuple[NoisePlot, ...]:
    """Return a picture of each fit to marks, by its title, all with the same axes."""
    placed = {
        title: quantiles(fitted.errors.reshape(-1, 2), fitted.noise_rms)
        for title, fitted in fits.items()
        if fitted.errors.size
    }
    most = max(map(_farthest, placed.values()), default=0.0)
    return tuple(
        NoisePlot(f"{title}: {_counted(each)}", _plot(title, each, most=1.05 * most))
        for title, each in placed.items()
    )


def _farthest(placed: Quantiles) -> float:
    """Return how far from zero dots and band reach [mm]."""
    return float(np.abs([placed.values, placed.low, placed.high]).max())


def _counted(placed: Quantiles) -> str:
    return f"{placed.beyond.sum()} of {placed.beyond.size} coordinates are beyond noise"


def _plot(title: str, placed: Quantiles, *, most: float) -> str:
    from matplotlib.figure import Figure

    figure = Figure(figsize=(WIDE, HIGH))
    axis = figure.add_axes((0.14, 0.18, 0.83, 0.77))
    scale = in_unit(1.0)
    at, low, high = scale * placed.at, scale * placed.low, scale * placed.high
    axis.set_ylim(-scale * most, scale * most)
    axis.fill_between(at, low, high, color=light("band"), lw=0, zorder=0)
    axis.plot(at, at, color=light("soft"), lw=0.8, zorder=1)
    for is_beyond, colour in ((False, "ink"), (True, "bad")):
        dots = placed.beyond == is_beyond
        axis.plot(
            at[dots],
            scale * placed.values[dots],
            "o",
            color=light(colour),
            markersize=4.2 if len(at) <= 2 * MANY else 2.4,
            zorder=3,
        )
    _dress(axis)
    return inline(figure, says=f"{title}: errors against noise", name=f"noise {title}")


def _dress(axis: Axes) -> None:
    """Write the words and ticks of a plot."""
    soft = light("soft")
    axis.set_xlabel(f"if it were noise, {unit()}", fontsize=7.5, color=soft, labelpad=2)
    axis.set_ylabel(f"error, {unit()}", fontsize=7.5, color=soft, labelpad=1)
    axis.tick_params(labelsize=7.5, colors=soft, labelcolor=soft, length=2.5)
    axis.locator_params(axis="both", nbins=5)
    for edge in ("top", "right"):
        axis.spines[edge].set_visible(False)
    for edge in ("left", "bottom"):
        axis.spines[edge].set_color(light("rule"))
