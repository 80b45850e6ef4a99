"""A map of the sheet: how far a force moves the sled, and how hard the chains pull."""

from __future__ import annotations

import io
from typing import TYPE_CHECKING

import numpy as np

from plumb.model.predict import (
    CANNOT_HANG,
    REACH_WORDS,
    TOO_SLACK,
    TOO_TIGHT,
    TOO_VERTICAL,
    USABLE,
    Array,
)
from plumb.model.reach import Survey, percent
from plumb.pictures.sheet import EDGE, INK, MARGIN, WIDTH, WOOD

if TYPE_CHECKING:
    from matplotlib.axes import Axes

TITLE, FOOT = 0.42, 0.85  # [inch] above each sheet, and below the last
GIVES = (0.005, 0.01, 0.02, 0.05, 0.1, 0.2, 0.5, 1.0, 2.0, 5.0)  # [mm/N]
PULLS = (5, 10, 15, 20, 25, 30, 40, 50, 100, 120, 150, 200, 250, 300, 400)  # [N]
# Far from a limit its lines say nothing: tight ones from half of it, slack ones up to three times.
TIGHT_FROM, SLACK_UP_TO = 0.5, 3.0
TIGHT, SLACK, SOFT = "#8e2c22", "#1f5f8b", "#6b3fa0"
ZONES = {
    TOO_TIGHT: (TIGHT, "too tight"),
    TOO_SLACK: (SLACK, "too slack"),
    TOO_VERTICAL: (SOFT, "too vertical"),
    CANNOT_HANG: ("#444444", "cannot hang"),
}


def draw_map(found: Survey, *, form: str = "png") -> bytes:
    """The map as a file: sideways give above, tensions below, limits as heavy lines."""
    # Loading matplotlib takes longer than most commands: only who draws shall wait for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    width, height = found.sheet
    inch = WIDTH / (width * (1 + 2 * MARGIN))  # per mm
    each = TITLE + inch * height * (1 + MARGIN)
    tall = 2 * each + FOOT
    figure = Figure(figsize=(WIDTH, tall))
    FigureCanvasAgg(figure)
    limits = found.limits
    titles = (
        f"How far the bit gives sideways, mm per N (limit {limits['most_give']:g})",
        f"How hard the chains pull, N (limits {limits['least_tension']:g} "
        f"and {limits['most_tension']:g})",
    )
    for i, (title, fill) in enumerate(zip(titles, (_draw_give, _draw_pulls), strict=True)):
        low = tall - (i + 1) * each
        axis = figure.add_axes((0, low / tall, 1, (each - TITLE) / tall))
        axis.set_xlim(-width * (0.5 + MARGIN), width * (0.5 + MARGIN))
        axis.set_ylim(-height * 0.5 * (1 + MARGIN), height * 0.5 * (1 + MARGIN))
        axis.set_axis_off()
        _draw_sheet(axis, found)
        fill(axis, found)
        beside = MARGIN / (1 + 2 * MARGIN)
        style = {"fontsize": 15, "fontweight": "bold", "color": INK, "va": "bottom"}
        figure.text(beside, (low + each - TITLE + 0.04) / tall, title, **style)
    _draw_legend(figure.add_axes((0, 0, 1, FOOT / tall)), found)
    file = io.BytesIO()
    # No date in the file: the same machine gives the same bytes.
    dated = {"svg": {"Date": None}, "pdf": {"CreationDate": None}}.get(form, {})
    figure.savefig(file, format=form, dpi=130, facecolor="white", metadata=dated)
    return file.getvalue()


def _grid(found: Survey, values: Array) -> Array:
    return values.reshape(len(found.y), len(found.x))


def _draw_sheet(axis: Axes, found: Survey) -> None:
    """The sheet, with what is not usable shaded by its reason."""
    from matplotlib.colors import to_rgba
    from matplotlib.patches import Rectangle

    width, height = found.sheet
    corner = (-width / 2, -height / 2)
    axis.add_patch(Rectangle(corner, width, height, fc=WOOD, ec="none"))
    verdict = _grid(found, found.reached.verdict)
    image = np.zeros((*verdict.shape, 4))
    for number, (colour, _) in ZONES.items():
        image[verdict == number] = to_rgba(colour, 0.45)
    # Each place is the middle of its cell, so the outer ones reach half a cell over the edge.
    across, down = (found.x[1] - found.x[0]) / 2, (found.y[0] - found.y[1]) / 2
    ends = (found.x[0] - across, found.x[-1] + across, found.y[-1] - down, found.y[0] + down)
    edge = Rectangle(corner, width, height, fc="none", ec=EDGE, lw=2, zorder=5)
    shown = axis.imshow(image, extent=ends, aspect="auto", interpolation="nearest", zorder=2)
    axis.add_patch(edge)
    shown.set_clip_path(edge)


def _lines(
    axis: Axes, found: Survey, values: Array, levels: list[float], limit: float, colour: str
) -> None:
    """Contours with their numbers, the limit's own left out."""
    field = _field(found, values)
    inside = [own for own in levels if own != limit and field.min() < own < field.max()]
    if inside:
        style = {"colors": colour, "linewidths": 1.2, "zorder": 3}
        drawn = axis.contour(found.x, found.y, field, levels=inside, **style)
        axis.clabel(drawn, fmt="%g", fontsize=10)


def _limit(axis: Axes, found: Survey, values: Array, limit: float, colour: str) -> None:
    """Where a limit is reached, as a heavy line."""
    field = _field(found, values)
    if field.min() < limit < field.max():
        style = {"colors": colour, "linewidths": 3.5, "zorder": 4}
        axis.contour(found.x, found.y, field, levels=[limit], **style)


def _field(found: Survey, values: Array) -> np.ma.MaskedArray:
    """Values by row and column, without the places where nothing hangs."""
    nothing = found.reached.verdict == CANNOT_HANG
    return np.ma.masked_where(_grid(found, nothing), _grid(found, values))


def _draw_give(axis: Axes, found: Survey) -> None:
    most = found.limits["most_give"]
    _lines(axis, found, found.reached.compliance[:, 0, 0], list(GIVES), most, SOFT)
    _limit(axis, found, found.reached.give, most, SOFT)


def _draw_pulls(axis: Axes, found: Survey) -> None:
    tighter, slacker = found.reached.tension.max(axis=1), found.reached.tension.min(axis=1)
    most, least = found.limits["most_tension"], found.limits["least_tension"]
    _lines(axis, found, tighter, [own for own in PULLS if own >= TIGHT_FROM * most], most, TIGHT)
    _lines(axis, found, slacker, [own for own in PULLS if own <= SLACK_UP_TO * least], least, SLACK)
    _limit(axis, found, tighter, most, TIGHT)
    _limit(axis, found, slacker, least, SLACK)


def _draw_legend(axis: Axes, found: Survey) -> None:
    """What the colours mean, and how much of the sheet is shaded in each."""
    from matplotlib.patches import Rectangle

    axis.set_xlim(0, WIDTH)
    axis.set_ylim(0, FOOT)
    axis.set_axis_off()
    left = WIDTH * MARGIN / (1 + 2 * MARGIN)
    said = {"va": "center", "fontsize": 11}
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
        axis.text(start + 0.45, 0.62, words, color=INK, **said)
    shares = found.shares
    usable = f"{percent(shares[REACH_WORDS[USABLE]])} usable"
    axis.text(left, 0.26, usable, color=INK, fontweight="bold", **said)
    place = left + step
    for number, (colour, words) in ZONES.items():
        share = shares[REACH_WORDS[number]]
        if share:
            axis.add_patch(Rectangle((place, 0.17), 0.35, 0.18, fc=colour, alpha=0.45, ec="none"))
            axis.text(place + 0.45, 0.26, f"{words} {percent(share)}", color=INK, **said)
            place += step
