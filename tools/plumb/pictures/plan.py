"""A picture of a proposal: the measured and the proposed marks on the sheet."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from plumb.pictures.saved import saved
from plumb.pictures.sheet import EDGE, INK, MARGIN, WIDTH, WOOD
from plumb.plan.planned_visits import Visits
from plumb.settings.machine import GRAVITY

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TITLE, LINE, FOOT = 0.5, 0.3, 0.2  # [inch] above the sheet, a line of the legend, below it
NEW, HEAVY, SWAPPED = "#1f5f8b", "#8e2c22", "#6b3fa0"
SHAFT = 90.0  # [mm] of the arrow in the direction of the last move


def draw_plan(
    visits: Visits,
    old: np.ndarray,
    *,
    title: str,
    usual_weight: float,
    sheet: tuple[float, float],
    form: str = "png",
) -> bytes:
    """The sheet with old marks (n, 2) [mm] and planned visits, numbered in their order."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    width, height = sheet
    inch = WIDTH / (width * (1 + 2 * MARGIN))
    legend = _legend(visits, old, usual_weight)
    foot = FOOT + LINE * len(legend)
    tall = TITLE + inch * height * 1.06 + foot
    figure = Figure(figsize=(WIDTH, tall))
    FigureCanvasAgg(figure)
    axis = figure.add_axes((0, foot / tall, 1, inch * height * 1.06 / tall))
    axis.set_xlim(-width * (0.5 + MARGIN), width * (0.5 + MARGIN))
    axis.set_ylim(-0.53 * height, 0.53 * height)
    axis.set_axis_off()
    _draw_sheet(axis, visits, old, usual_weight, sheet)
    left = MARGIN / (1 + 2 * MARGIN)
    figure.text(left, 1 - 0.36 / tall, title, fontsize=15, fontweight="bold", color=INK)
    _draw_legend(figure.add_axes((0, 0, 1, foot / tall)), legend, foot)
    return saved(figure, form)


def _draw_sheet(
    axis: Axes, visits: Visits, old: np.ndarray, usual_weight: float, sheet: tuple[float, float]
) -> None:
    from matplotlib.patches import Rectangle

    width, height = sheet
    axis.add_patch(Rectangle((-width / 2, -height / 2), width, height, fc=WOOD, ec=EDGE, lw=2))
    if len(old):
        axis.plot(*old.T, "o", color="white", markeredgecolor=INK, markersize=7, zorder=3)
    for numbers, i in _by_place(visits):
        _draw_visit(axis, visits, i, numbers, usual_weight, height)


def _by_place(visits: Visits) -> list[tuple[list[int], int]]:
    """Visits that repeat each other: their numbers, and the row of the first."""
    groups: dict[tuple[float, ...], list[int]] = {}
    for i in range(len(visits)):
        alike = (*visits.targets[i], visits.sled_weights[i], float(visits.swapped[i]))
        groups.setdefault(alike, []).append(i)
    return [([i + 1 for i in rows], rows[0]) for rows in groups.values()]


def _draw_visit(
    axis: Axes, visits: Visits, i: int, numbers: list[int], usual_weight: float, height: float
) -> None:
    at, (colour, symbol) = visits.targets[i], _look(visits, i, usual_weight)
    axis.plot(*at, symbol, color=colour, markersize=12, markeredgecolor="white", zorder=5)
    for number in numbers:
        side = visits.approaches[number - 1]
        if side.any():
            axis.annotate(
                "",
                xy=at - 22 * side,
                xytext=at - SHAFT * side,
                arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.6},
                zorder=4,
            )
    down = -1 if at[1] > 0 else 1
    said = ", ".join(map(str, numbers[:4])) + (", ..." if len(numbers) > 4 else "")
    axis.text(
        at[0] + 0.022 * height * (1 if at[0] < 0 else -1),
        at[1] + 0.045 * height * down,
        said,
        ha="left" if at[0] < 0 else "right",
        va="center",
        fontsize=12,
        fontweight="bold",
        color=colour,
        zorder=6,
    )


def _look(visits: Visits, i: int, usual_weight: float) -> tuple[str, str]:
    """Colour and symbol of a visit."""
    if visits.swapped[i]:
        return SWAPPED, "D"
    if visits.sled_weights[i] > 1.01 * usual_weight:
        return HEAVY, "v"
    return NEW, "o"


def _legend(
    visits: Visits, old: np.ndarray, usual_weight: float
) -> list[tuple[str | None, str, str]]:
    """Symbol, colour and meaning of what is drawn; no symbol for a plain sentence."""
    lines: list[tuple[str | None, str, str]] = []
    if len(old):
        lines.append(("o", "white", "measured marks"))
    meant: dict[tuple[str, str], str] = {}
    for i in range(len(visits)):
        colour, symbol = _look(visits, i, usual_weight)
        extra = (visits.sled_weights[i] - usual_weight) / GRAVITY
        words = {
            SWAPPED: "to measure with each chain on the other's sprocket",
            HEAVY: f"to measure with {extra:.1f} kg more on the sled",
            NEW: "to measure with the sled as it is",
        }[colour]
        meant.setdefault((symbol, colour), words)
    lines += [(symbol, colour, words) for (symbol, colour), words in meant.items()]
    if visits.approaches.any():
        lines.append((None, INK, "arrow: the direction of the sled's last move"))
    return lines


def _draw_legend(axis: Axes, lines: Sequence[tuple[str | None, str, str]], foot: float) -> None:
    axis.set_xlim(0, WIDTH)
    axis.set_ylim(0, foot)
    axis.set_axis_off()
    left = WIDTH * MARGIN / (1 + 2 * MARGIN)
    for i, (symbol, colour, words) in enumerate(lines):
        y = foot - 0.2 - LINE * i
        if symbol:
            edge = INK if colour == "white" else "white"
            axis.plot(left + 0.1, y, symbol, color=colour, markeredgecolor=edge, markersize=10)
        axis.text(left + 0.3, y, words, va="center", fontsize=12, color=INK)
