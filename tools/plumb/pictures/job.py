"""A job on its sheet: where it lies, and from near the finished piece; what is wrong in orange."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plumb.job.wood import Piece
from plumb.pictures.scale import View, around, saved
from plumb.pictures.sheet import (
    BAD,
    GOOD,
    INK,
    MARGIN,
    WIDTH,
    WOOD,
    draw_wood,
    fitting,
    show,
    strip,
)
from plumb.text.values import worded

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.colors import Colormap
    from matplotlib.figure import Figure


Array = np.ndarray
TITLE, FOOT = 0.45, 0.8  # [inch]
AROUND = 0.08  # of the job's size, left free around it
POINT = 0.1  # [mm] of sheet; a way that is shorter leads straight down
LEAST = 20.0  # [mm] of wood that is shown from near
TALLEST = 1.0  # height of the near view over its width
DEEP = "#8f6236"  # the deepest wood
# Colour, width [point] and style of each kind of way, from below.
STROKES = {"rapid": ("#9a9a9a", 0.6, "--"), "cut": (GOOD, 0.7, "-"), "bad": (BAD, 2.4, "-")}


@dataclass(frozen=True)
class Drawn:
    """What the picture shows."""

    title: str
    is_good: bool
    sheet: tuple[float, float]  # [mm]
    ways: Mapping[str, Sequence[Array]]  # "rapid", "cut" and "bad": (k, 2) [mm] each
    labels: Sequence[tuple[float, float, str]]  # x, y [mm], words
    piece: Piece | None  # None where nothing is cut


def draw_job(job: Drawn, *, form: str = "png") -> bytes:
    """Return the picture as a file: the whole sheet above, the job from near below."""
    from matplotlib.figure import Figure

    view = around(job.sheet)
    upper = WIDTH * view.height / view.width
    low, high = _near(job)
    lower = WIDTH * min(TALLEST, float((high[1] - low[1]) / (high[0] - low[0])))
    tall = TITLE + upper + lower + FOOT
    figure = Figure(figsize=(WIDTH, tall))
    sheet = figure.add_axes((0, (FOOT + lower) / tall, 1, upper / tall))
    show(sheet, view)
    near = figure.add_axes((MARGIN, FOOT / tall, 1 - 2 * MARGIN, lower / tall))
    show(near, View(low[0], high[0], low[1], high[1]))
    near.set_aspect("equal")
    for axis, scale in ((sheet, 0.6), (near, 1.0)):
        _draw_ways(axis, job, scale)
    _draw_frame(sheet, low, high)
    for x, y, words in job.labels:
        near.text(x, y, words, fontsize=9, color=INK, ha="center", va="center", zorder=6)
    colour = GOOD if job.is_good else BAD
    size = fitting(job.title, WIDTH * (1 - 2 * MARGIN), 16)
    place = (MARGIN, 1 - 0.3 / tall)
    figure.text(*place, job.title, fontsize=size, fontweight="bold", color=colour, va="center")
    _draw_legend(figure, job.piece)
    return saved(figure, form)


def _shades() -> Colormap:
    """From the face of the sheet to the deepest cut."""
    from matplotlib.colors import LinearSegmentedColormap

    return LinearSegmentedColormap.from_list("depth", [WOOD, DEEP])


def _draw_depth(axis: Axes, piece: Piece) -> None:
    """Shade the wood by how deep it is cut."""
    (left, low), (right, high) = piece.corners
    extent = (left, right, low, high)
    depth = np.ma.masked_equal(-piece.heights, 0)
    axis.imshow(
        depth, cmap=_shades(), vmin=0, vmax=piece.deepest, extent=extent, origin="lower", zorder=1.5
    )


def _draw_legend(figure: Figure, piece: Piece | None) -> None:
    """Say what the colours mean, and how deep each shade is."""
    axis = strip(figure, FOOT)
    left = WIDTH * MARGIN
    meaning = "blue: the bit in the wood; grey: above the sheet; orange: wrong, or not usable"
    axis.text(left, 0.22, meaning, fontsize=11, color=INK, va="center")
    if piece:
        shades = np.linspace(0, 1, 64)[None]
        axis.imshow(shades, cmap=_shades(), extent=(left, left + 2, 0.48, 0.66), aspect="auto")
        words = f"depth of the finished piece, 0 to {worded(piece.deepest)}"
        axis.text(left + 2.1, 0.57, words, fontsize=11, color=INK, va="center")


def _near(job: Drawn) -> tuple[Array, Array]:
    """Lower left and upper right corner [mm] of the near view."""
    ways = [*job.ways["cut"], *job.ways["bad"]] or [*job.ways["rapid"]] or [np.zeros((1, 2))]
    places = np.vstack([*ways, *([job.piece.corners] if job.piece else [])])
    low, high = places.min(axis=0), places.max(axis=0)
    half = np.maximum((high - low) / 2 * (1 + 2 * AROUND), LEAST / 2)
    # No flatter than a quarter and no higher than it is wide.
    half = np.maximum(half, [half[1] / TALLEST, half[0] / 4])
    middle = (low + high) / 2
    return middle - half, middle + half


def _draw_ways(axis: Axes, job: Drawn, scale: float) -> None:
    from matplotlib.collections import LineCollection

    draw_wood(axis, job.sheet)
    if job.piece:
        _draw_depth(axis, job.piece)
    for order, (kind, (colour, stroke, style)) in enumerate(STROKES.items(), start=2):
        lines = LineCollection(
            job.ways[kind], colors=colour, linewidths=scale * stroke, linestyles=style
        )
        lines.set_zorder(order)
        axis.add_collection(lines)
    # Straight down is no line from above.
    for way in job.ways["bad"]:
        if np.ptp(way, axis=0).max() < POINT:
            axis.plot(*way[0], "o", color=BAD, markersize=10 * scale, zorder=5)


def _draw_frame(axis: Axes, low: Array, high: Array) -> None:
    """Show a part of the sheet from near."""
    from matplotlib.patches import Rectangle

    width, height = high - low
    axis.add_patch(Rectangle(tuple(low), width, height, fc="none", ec=INK, lw=0.8, zorder=5))
