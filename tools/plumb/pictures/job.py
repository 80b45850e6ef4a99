"""A job on its sheet: where it lies, and its cuts from near, with what is wrong in orange."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plumb.pictures.saved import saved
from plumb.pictures.sheet import BAD, EDGE, GOOD, INK, MARGIN, WIDTH, WOOD, fitting

if TYPE_CHECKING:
    from matplotlib.axes import Axes

Array = np.ndarray
JOB_TITLE, JOB_FOOT = 0.45, 0.5  # [inch]
AROUND = 0.08  # of the job's size, left free around it
LEAST = 20.0  # [mm] of wood that is shown from near
TALLEST = 1.0  # height of the near view over its width
# Colour, width [point] and style of each kind of way, from below.
STROKES = {"rapid": ("#9a9a9a", 0.6, "--"), "cut": (GOOD, 1.0, "-"), "bad": (BAD, 2.4, "-")}


@dataclass(frozen=True)
class Drawn:
    """What the picture shows."""

    title: str
    is_good: bool
    sheet: tuple[float, float]  # [mm]
    ways: Mapping[str, Sequence[Array]]  # "rapid", "cut" and "bad": (k, 2) [mm] each
    labels: Sequence[tuple[float, float, str]]  # x, y [mm], words


def draw_job(job: Drawn, *, form: str = "png") -> bytes:
    """The picture as a file: the whole sheet above, the job from near below."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    width, height = job.sheet
    across = width * (1 + 2 * MARGIN)
    upper = WIDTH * height * (1 + MARGIN) / across
    low, high = _near(job)
    lower = WIDTH * min(TALLEST, float((high[1] - low[1]) / (high[0] - low[0])))
    tall = JOB_TITLE + upper + lower + JOB_FOOT
    figure = Figure(figsize=(WIDTH, tall))
    FigureCanvasAgg(figure)
    sheet = figure.add_axes((0, (JOB_FOOT + lower) / tall, 1, upper / tall))
    sheet.set_xlim(-across / 2, across / 2)
    sheet.set_ylim(-height * (1 + MARGIN) / 2, height * (1 + MARGIN) / 2)
    near = figure.add_axes((MARGIN, JOB_FOOT / tall, 1 - 2 * MARGIN, lower / tall))
    near.set_xlim(low[0], high[0])
    near.set_ylim(low[1], high[1])
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
    meaning = "blue: cut; grey: above the sheet; orange: wrong, or not usable"
    figure.text(MARGIN, 0.2 / tall, meaning, fontsize=11, color=INK, va="center")
    return saved(figure, form)


def _near(job: Drawn) -> tuple[Array, Array]:
    """Lower left and upper right corner [mm] of the near view."""
    ways = [*job.ways["cut"], *job.ways["bad"]] or [*job.ways["rapid"]] or [np.zeros((1, 2))]
    places = np.vstack(ways)
    low, high = places.min(axis=0), places.max(axis=0)
    half = np.maximum((high - low) / 2 * (1 + 2 * AROUND), LEAST / 2)
    # No flatter than a quarter and no higher than it is wide.
    half = np.maximum(half, [half[1] / TALLEST, half[0] / 4])
    middle = (low + high) / 2
    return middle - half, middle + half


def _draw_ways(axis: Axes, job: Drawn, scale: float) -> None:
    from matplotlib.collections import LineCollection
    from matplotlib.patches import Rectangle

    width, height = job.sheet
    axis.set_axis_off()
    wood = Rectangle((-width / 2, -height / 2), width, height, fc=WOOD, ec=EDGE, lw=2, zorder=0)
    axis.add_patch(wood)
    for order, (kind, (colour, stroke, style)) in enumerate(STROKES.items(), start=1):
        lines = LineCollection(
            job.ways[kind], colors=colour, linewidths=scale * stroke, linestyles=style
        )
        lines.set_zorder(order)
        axis.add_collection(lines)


def _draw_frame(axis: Axes, low: Array, high: Array) -> None:
    """What of the sheet is shown from near."""
    from matplotlib.patches import Rectangle

    width, height = high - low
    axis.add_patch(Rectangle(tuple(low), width, height, fc="none", ec=INK, lw=0.8, zorder=5))
