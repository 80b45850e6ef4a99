"""Pictures of errors on the sheet: where marks lie against where they were predicted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from plumb.pictures.saved import saved

if TYPE_CHECKING:
    from matplotlib.axes import Axes

WIDTH = 8.6  # [inch] of a picture
MARGIN = 0.05  # left and right of the sheet, of its width
TITLE, FOOT = 0.45, 0.85  # [inch] above each sheet, and below the last
FORMATS = ("png", "svg", "pdf")
STEPS = (1, 2, 3, 5)  # a factor or scale bar is such a number times a power of ten
WOOD, EDGE, INK = "#f3e7d3", "#8a6d3b", "#222222"
BAD, GOOD = "#c0392b", "#1e6b3a"


@dataclass(frozen=True)
class Panel:
    """A sheet with its errors [mm]."""

    title: str
    predicted: np.ndarray  # (n, 2)
    errors: np.ndarray  # (n, 2) measured - predicted
    good: bool = False  # drawn in the colour of success


def draw(panels: Sequence[Panel], *, sheet: tuple[float, float], form: str = "png") -> bytes:
    """The picture of sheets, each below the last, all arrows to the same scale."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    width, height = sheet
    largest = max(float(np.hypot(*panel.errors.T).max()) for panel in panels)
    factor = exaggeration(largest, sheet)
    inch = WIDTH / (width * (1 + 2 * MARGIN))  # per mm
    ranges = [_range(panel, height, factor) for panel in panels]
    tall = sum(TITLE + inch * (top - bottom) for bottom, top in ranges) + FOOT
    figure = Figure(figsize=(WIDTH, tall))
    FigureCanvasAgg(figure)
    upper = tall
    for panel, (bottom, top) in zip(panels, ranges, strict=True):
        upper -= TITLE + inch * (top - bottom)
        axis = figure.add_axes((0, upper / tall, 1, inch * (top - bottom) / tall))
        axis.set_xlim(-width * (0.5 + MARGIN), width * (0.5 + MARGIN))
        axis.set_ylim(bottom, top)
        axis.set_axis_off()
        _draw_sheet(axis, panel, sheet, factor)
        colour = GOOD if panel.good else BAD
        left = MARGIN / (1 + 2 * MARGIN)
        y = (upper + inch * (top - bottom) + 0.06) / tall
        figure.text(left, y, panel.title, fontsize=16, fontweight="bold", color=colour, va="bottom")
    _draw_scale(figure.add_axes((0, 0, 1, FOOT / tall)), factor, largest, inch)
    return saved(figure, form)


def _range(panel: Panel, height: float, factor: float) -> tuple[float, float]:
    """Lowest and highest y [mm] that a sheet and its arrows need."""
    ends = (panel.predicted + factor * panel.errors)[:, 1]
    edge = 0.52 * height
    return min(-edge, float(ends.min()) - 10), max(edge, float(ends.max()) + 10)


def exaggeration(largest: float, sheet: tuple[float, float]) -> float:
    """How much longer than life arrows are drawn: the longest fills over a third of the height."""
    return round_down(0.37 * sheet[1] / max(largest, 1e-6))


def round_down(value: float) -> float:
    """The largest 1, 2 or 5 times a power of ten that is no larger than the value."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(step * power for step in STEPS if step * power <= value * (1 + 1e-9)))


def _draw_sheet(axis: Axes, panel: Panel, sheet: tuple[float, float], factor: float) -> None:
    from matplotlib.patches import Rectangle

    width, height = sheet
    axis.add_patch(Rectangle((-width / 2, -height / 2), width, height, fc=WOOD, ec=EDGE, lw=2))
    axis.plot(*panel.predicted.T, "o", color="white", markeredgecolor=INK, markersize=6, zorder=3)
    axis.quiver(
        *panel.predicted.T,
        *(factor * panel.errors).T,
        angles="xy",
        scale_units="xy",
        scale=1,
        units="inches",
        width=0.035,
        headwidth=4.5,
        headlength=5.5,
        headaxislength=5,
        minlength=0.5,
        color=GOOD if panel.good else BAD,
        zorder=4,
    )
    for place, error in zip(panel.predicted, panel.errors, strict=True):
        _draw_number(axis, place, error, 0.03 * height, factor)


def _draw_number(
    axis: Axes, place: np.ndarray, error: np.ndarray, gap: float, factor: float
) -> None:
    """The length of an error next to its mark, clear of arrow and edge."""
    left = place[0] > 100 or (place[0] > -100 and error[0] > 0)
    in_the_way = abs(error[0]) > abs(error[1]) and (error[0] < 0) == left
    sideways = not (in_the_way and abs(error[0]) * factor > gap)
    across = (-gap if left else gap) if sideways else 0
    up = 0 if sideways else (gap if place[1] < 0 else -gap)
    axis.text(
        place[0] + across,
        place[1] + up,
        f"{np.hypot(*error):.1f}",
        ha="center" if not sideways else "right" if left else "left",
        va="center" if sideways else "bottom" if up > 0 else "top",
        fontsize=12,
        color=INK,
    )


def _draw_scale(axis: Axes, factor: float, largest: float, inch: float) -> None:
    """A bar of a round length below the last sheet, and what the arrows mean."""
    axis.set_xlim(0, WIDTH)
    axis.set_ylim(0, FOOT)
    axis.set_axis_off()
    bar = round_down(max(largest, 1e-6))
    left = WIDTH * MARGIN / (1 + 2 * MARGIN)
    right = left + bar * factor * inch
    axis.plot([left, right], [0.6, 0.6], color=INK, lw=4, solid_capstyle="butt")
    write = partial(axis.text, va="center", fontsize=12, color=INK)
    write(right + 0.12, 0.6, f"{bar:g} mm of error: arrows {factor:g} times life size")
    meaning = "circle: where the mark should be; arrow: to where it was measured; number: mm"
    write(left, 0.27, meaning)
