"""A picture of a diary: the errors of each fit, and below them each number with its interval."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from datetime import datetime
from typing import TYPE_CHECKING

from plumb.pictures.saved import saved
from plumb.pictures.sheet import BAD, GOOD, INK, WIDTH

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TALL, SHORT = 2.6, 1.3  # [inch] of the errors, and of each number
COLOURS = (BAD, GOOD, INK)

Interval = tuple[float, float]


@dataclass(frozen=True)
class Run:
    """How something went over time."""

    name: str
    unit: str
    points: Sequence[tuple[datetime, float, Interval | None]]


def draw_diary(errors: Sequence[Run], numbers: Sequence[Run], *, form: str = "png") -> bytes:
    """The errors together, then every number by itself, fit by fit."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    heights = [TALL, *[SHORT] * len(numbers)]
    dates = sorted({point[0] for run in errors for point in run.points})
    figure = Figure(figsize=(WIDTH, sum(heights)), layout="constrained")
    FigureCanvasAgg(figure)
    axes = figure.subplots(len(heights), 1, squeeze=False, sharex=True, height_ratios=heights)
    first, *others = axes[:, 0]
    for run, colour in zip(errors, COLOURS, strict=True):
        _draw(first, run, dates, colour)
    first.set_ylim(bottom=0)
    first.legend(loc="upper right", frameon=False)
    first.set_title("Errors of the fits", loc="left", color=INK)
    first.set_ylabel(errors[0].unit)
    for axis, run in zip(others, numbers, strict=True):
        _draw(axis, run, dates, GOOD)
        axis.set_title(run.name, loc="left", color=INK, fontsize=10)
        axis.set_ylabel(run.unit)
        axis.ticklabel_format(axis="y", useOffset=False)
    # A fit has its place by its turn: two on a day would lie on each other.
    axes[-1, 0].set_xticks(range(len(dates)), [f"{date:%Y-%m-%d}" for date in dates])
    axes[-1, 0].set_xlim(-0.5, len(dates) - 0.5)
    return saved(figure, form)


def _draw(axis: Axes, run: Run, dates: Sequence[datetime], colour: str) -> None:
    """A run with its intervals."""
    turns = [dates.index(at) for at, _, _ in run.points]
    values = [value for _, value, _ in run.points]
    axis.plot(turns, values, "o-", color=colour, label=run.name)
    for turn, (_, _, interval) in zip(turns, run.points, strict=True):
        if interval:
            axis.plot((turn, turn), interval, color=colour, lw=2)
