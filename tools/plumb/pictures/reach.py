"""A map of the sheet: how far a force moves the sled, and how hard the chains pull."""

from __future__ import annotations

from collections.abc import Sequence
from functools import partial
from typing import TYPE_CHECKING, TypeVar

import numpy as np
from numpy.typing import NDArray

from plumb.model.predict import CANNOT_HANG, REACH_WORDS, TOO_SLACK, TOO_TIGHT, TOO_VERTICAL, USABLE
from plumb.model.reach import Survey, percent
from plumb.pictures.scale import around, saved
from plumb.pictures.sheet import (
    EDGE,
    INK,
    MARGIN,
    WIDTH,
    WOOD,
    show,
    strip,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes


TITLE, FOOT = 0.42, 0.85  # [inch] above each sheet, and below the last
GIVES = (0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0)  # [mm/N]
PULLS = (5, 10, 15, 20, 25, 30, 40, 50, 100, 120, 150, 200, 250, 300, 400)  # [N]
# Far from a limit its lines say nothing: tight from half of it, slack up to three times.
TIGHT_FROM, SLACK_UP_TO = 0.5, 3.0
TIGHT, SLACK, SOFT = "#8e2c22", "#1f5f8b", "#6b3fa0"
Array = np.ndarray
Number = TypeVar("Number", bound=np.generic)
ZONES = {
    TOO_TIGHT: (TIGHT, "too tight"),
    TOO_SLACK: (SLACK, "too slack"),
    TOO_VERTICAL: (SOFT, "too vertical"),
    CANNOT_HANG: ("#444444", "cannot hang"),
}


def draw_map(survey: Survey, *, form: str = "png") -> bytes:
    """Return the map as a file: sideways give above, tensions below, limits as heavy lines."""
    from matplotlib.figure import Figure

    view = around(survey.sheet)
    high = TITLE + WIDTH * view.height / view.width
    tall = 2 * high + FOOT
    figure = Figure(figsize=(WIDTH, tall))
    limits = survey.limits
    titles = (
        f"How far the bit gives sideways, mm per N (limit {limits['most_give']:g})",
        f"How hard the chains pull, N (limits {limits['least_tension']:g} "
        f"and {limits['most_tension']:g})",
    )
    for i, (title, fill) in enumerate(zip(titles, (draw_give, draw_pulls), strict=True)):
        low = tall - (i + 1) * high
        axis = figure.add_axes((0, low / tall, 1, (high - TITLE) / tall))
        show(axis, view)
        draw_zones(axis, survey)
        fill(axis, survey)
        left = MARGIN / (1 + 2 * MARGIN)
        y = (low + high - TITLE + 0.04) / tall
        figure.text(left, y, title, fontsize=15, fontweight="bold", color=INK, va="bottom")
    _draw_legend(strip(figure, FOOT), survey)
    return saved(figure, form)


def _grid(survey: Survey, values: NDArray[Number]) -> NDArray[Number]:
    """Values of all places by row and column."""
    return values.reshape(len(survey.y), len(survey.x))


def draw_zones(axis: Axes, survey: Survey) -> None:
    """Draw the sheet, with what is not usable shaded by its reason."""
    from matplotlib.colors import to_rgba
    from matplotlib.patches import Rectangle

    width, height = survey.sheet
    corner = (-width / 2, -height / 2)
    axis.add_patch(Rectangle(corner, width, height, fc=WOOD, ec="none"))
    verdict = _grid(survey, survey.reached.verdict)
    image = np.zeros((*verdict.shape, 4))
    for number, (colour, _) in ZONES.items():
        image[verdict == number] = to_rgba(colour, 0.45)
    # Each place is the middle of its cell, so outer cells reach half a cell over the edge.
    across, down = (survey.x[1] - survey.x[0]) / 2, (survey.y[0] - survey.y[1]) / 2
    ends = (survey.x[0] - across, survey.x[-1] + across, survey.y[-1] - down, survey.y[0] + down)
    edge = Rectangle(corner, width, height, fc="none", ec=EDGE, lw=2, zorder=5)
    shown = axis.imshow(image, extent=ends, aspect="auto", interpolation="nearest", zorder=2)
    axis.add_patch(edge)
    shown.set_clip_path(edge)


def _lines(
    axis: Axes, survey: Survey, values: Array, levels: Sequence[float], limit: float, colour: str
) -> None:
    """Contours with their numbers, without that of the limit."""
    field = _field(survey, values)
    inside = [level for level in levels if level != limit and field.min() < level < field.max()]
    if inside:
        drawn = axis.contour(
            survey.x, survey.y, field, levels=inside, colors=colour, linewidths=1.2, zorder=3
        )
        axis.clabel(drawn, fmt="%g", fontsize=10)


def _limit(axis: Axes, survey: Survey, values: Array, limit: float, colour: str) -> None:
    """Draw where a limit is reached, as a heavy line."""
    field = _field(survey, values)
    if field.min() < limit < field.max():
        axis.contour(
            survey.x, survey.y, field, levels=[limit], colors=colour, linewidths=3.5, zorder=4
        )


def _field(survey: Survey, values: Array) -> np.ma.MaskedArray:
    """Values by row and column, without the places where nothing hangs."""
    nothing = survey.reached.verdict == CANNOT_HANG
    return np.ma.masked_where(_grid(survey, nothing), _grid(survey, values))


def draw_give(axis: Axes, survey: Survey) -> None:
    """Draw how far the bit gives sideways: lines of equal give [mm/N]."""
    most = survey.limits["most_give"]
    _lines(axis, survey, survey.reached.compliance[:, 0, 0], list(GIVES), most, SOFT)
    _limit(axis, survey, survey.reached.give, most, SOFT)


def draw_pulls(axis: Axes, survey: Survey) -> None:
    """Draw how hard the chains pull: lines of equal tension [N]."""
    tighter, slacker = survey.reached.tension.max(axis=1), survey.reached.tension.min(axis=1)
    most, least = survey.limits["most_tension"], survey.limits["least_tension"]
    _lines(
        axis, survey, tighter, [level for level in PULLS if level >= TIGHT_FROM * most], most, TIGHT
    )
    _lines(
        axis,
        survey,
        slacker,
        [level for level in PULLS if level <= SLACK_UP_TO * least],
        least,
        SLACK,
    )
    _limit(axis, survey, tighter, most, TIGHT)
    _limit(axis, survey, slacker, least, SLACK)


def _draw_legend(axis: Axes, survey: Survey) -> None:
    """Say what the colours mean, and how much of the sheet is shaded in each."""
    from matplotlib.patches import Rectangle

    left = WIDTH * MARGIN / (1 + 2 * MARGIN)
    write = partial(axis.text, va="center", fontsize=11, color=INK)
    meaning = (
        (TIGHT, "the tighter chain"),
        (SLACK, "the slacker chain"),
        (SOFT, "give sideways"),
        (INK, "heavy: the limit"),
    )
    step = (WIDTH - 2 * left) / len(meaning)
    for i, (colour, words) in enumerate(meaning):
        start = left + i * step
        heavy = 3.5 if colour == INK else 1.2
        axis.plot([start, start + 0.35], [0.62, 0.62], color=colour, lw=heavy)
        write(start + 0.45, 0.62, words)
    shares = survey.shares
    usable = f"{percent(shares[REACH_WORDS[USABLE]])} usable"
    write(left, 0.26, usable, fontweight="bold")
    place = left + step
    for number, (colour, words) in ZONES.items():
        share = shares[REACH_WORDS[number]]
        if share:
            axis.add_patch(Rectangle((place, 0.17), 0.35, 0.18, fc=colour, alpha=0.45, ec="none"))
            write(place + 0.45, 0.26, f"{words} {percent(share)}")
            place += step
