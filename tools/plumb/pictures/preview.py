"""A heat map of a preview: which effect a plan could tell from which."""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from plumb.pictures.saved import saved
from plumb.pictures.sheet import EDGE, INK, WIDTH, WOOD
from plumb.plan.preview import APART, Preview

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TITLE, LEFT, TOP, FOOT, GAP = 0.55, 1.55, 1.35, 0.3, 0.25  # [inch]
SHEET = 2.0  # [inch] of the sheet with the planned marks, to the right of the cells
MOST = 6.0  # [sigmas] from which a cell is as green as it gets


def draw_preview(preview: Preview, *, sheet: tuple[float, float], form: str = "png") -> bytes:
    """The cells in sigmas with the planned marks below them."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.colors import LinearSegmentedColormap
    from matplotlib.figure import Figure

    side = WIDTH - LEFT - 2 * GAP
    low = SHEET * sheet[1] / sheet[0]
    tall = TITLE + TOP + side + FOOT + low + GAP
    figure = Figure(figsize=(WIDTH, tall))
    FigureCanvasAgg(figure)
    axis = figure.add_axes((LEFT / WIDTH, (FOOT + low + GAP) / tall, side / WIDTH, side / tall))
    shades = LinearSegmentedColormap.from_list("apart", ["#c0392b", "#f6e3b4", "#1e6b3a"])
    axis.imshow(preview.matrix, cmap=shades, vmin=0, vmax=MOST, aspect="equal")
    _write_cells(axis, preview)
    title = f"What these {preview.marks} marks could tell, read to {preview.sigma:g} mm"
    figure.text(GAP / WIDTH, 1 - 0.4 / tall, title, fontsize=15, fontweight="bold", color=INK)
    small = figure.add_axes((LEFT / WIDTH, GAP / tall, SHEET / WIDTH, low / tall))
    _draw_targets(small, preview.targets, sheet)
    said = (
        "number: reading errors of what the row's effect, in its usual",
        "size, draws and neither frame nor column's effect can imitate",
        "on the diagonal: with the frame alone",
        f"told apart: {APART:g} or more",
    )
    for i, line in enumerate(said):
        y = (GAP + low - 0.05 - 0.25 * i) / tall
        figure.text((LEFT + SHEET + GAP) / WIDTH, y, line, fontsize=10.5, color=INK, va="top")
    return saved(figure, form)


def _write_cells(axis: Axes, preview: Preview) -> None:
    count = len(preview.effects)
    axis.set_xticks(range(count), preview.effects, rotation=60, ha="left", fontsize=10)
    axis.set_yticks(range(count), preview.effects, fontsize=11)
    axis.xaxis.tick_top()
    axis.tick_params(length=0)
    for spine in axis.spines.values():
        spine.set_visible(False)
    for i in range(count):
        for j in range(count):
            value = float(preview.matrix[i, j])
            dark = value < 0.18 * MOST or value > 0.8 * MOST
            axis.text(
                j,
                i,
                shown(value),
                ha="center",
                va="center",
                fontsize=10,
                fontweight="bold" if i == j else "normal",
                color="white" if dark else INK,
            )


def shown(value: float) -> str:
    """Sigmas for people: a decimal below ten, none above."""
    return f"{value:.1f}" if value < 9.95 else f"{value:.0f}" if value < 99.5 else "99+"


def _draw_targets(axis: Axes, targets: np.ndarray, sheet: tuple[float, float]) -> None:
    from matplotlib.patches import Rectangle

    width, height = sheet
    axis.set_xlim(-0.51 * width, 0.51 * width)
    axis.set_ylim(-0.52 * height, 0.52 * height)
    axis.set_axis_off()
    axis.add_patch(Rectangle((-width / 2, -height / 2), width, height, fc=WOOD, ec=EDGE, lw=1.5))
    if len(targets):
        axis.plot(*targets.T, "o", color="white", markeredgecolor=INK, markersize=4)
