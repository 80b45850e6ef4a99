"""The map of a sheet: where marks lie against where they were predicted.

A picture by itself and the report draw it here, each with its look.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plumb.model.plain import least, ranked
from plumb.pictures.scale import Panel, Scale, Spots, View, pitch_of, saved, spots_of
from plumb.text.values import UNITS, bare, shown_in, unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


Array = np.ndarray
WIDTH = 8.6  # [inch] of a picture
MARGIN = 0.05  # left and right of the sheet, of its width
TITLE, FOOT = 0.45, 0.34  # [inch] above a sheet, and of a line of words below it
FORMATS = ("png", "svg", "pdf")
WOOD, EDGE, INK = "#f3e7d3", "#8a6d3b", "#222222"
BAD, GOOD = "#c64f00", "#0b62a4"  # orange and blue: apart for every eye
MANY = 60  # marks from which a picture has no numbers
ROOMY = 200.0  # [mm] between marks that are drawn in full size
POINT = 1 / 72  # [inch]
NAME = 5.0  # [point] of a name among many
GAP = 0.65  # from a mark to its words, of the size of their type
BOLD, PLAIN = 0.68, 0.56  # width of a letter in a sentence, of the size of its type
INSIDE = 2.448  # sigmas: 95 % of all readings lie within, in two coordinates


@dataclass(frozen=True)
class Look:
    """How large a map of arrows is, and what is written into it."""

    wide: float = WIDTH  # [inch]
    small: float = 1.0  # marks and arrows, of their size in a picture by itself
    type: float = 12.0  # [point]
    has_lengths: bool = True  # next to the marks
    scale: str = "{bar} of error: arrows {factor:g} times life size"  # empty: no scale
    has_legend: bool = False  # below the scale


def draw(
    panel: Panel, *, sheet: tuple[float, float], form: str = "png", names: bool = False
) -> bytes:
    """Return the picture of a sheet as a file, in mm."""
    with shown_in("mm"):
        scale = Scale.of([spots_of(panel)], sheet)
        return saved(arrow_figure(panel, scale, Look(has_legend=True), names=names), form)


def arrow_figure(
    panel: Panel, scale: Scale, look: Look, *, names: bool = False, sigma: float | None = None
) -> Figure:
    """Return the map of a sheet. The ring at an arrow's tip shows how far repeats spread; with a
    sigma [mm], where 95 % of readings without error would lie.
    """
    spots, inch = spots_of(panel), look.wide / scale.view.width
    foot = FOOT * (bool(look.scale) + look.has_legend)
    figure, axis = sheet_figure(scale.view, look.wide, head=TITLE * bool(panel.title), foot=foot)
    draw_errors(axis, spots, scale, good=panel.good, small=look.small, sigma=sigma)
    if look.has_lengths:
        _draw_words(axis, spots, scale, inch=inch, size=look.type, names=names)
    edge = (-scale.sheet[0] / 2 - scale.view.left) * inch
    if panel.title:
        colour = GOOD if panel.good else BAD
        write_title(figure, panel.title, left=edge, head=TITLE, size=16, color=colour)
    if look.scale:
        below = strip(figure, foot)
        line = 4.0 if look.has_legend else 3.0
        said = look.scale.format(bar=f"{scale.bar:g} {unit()}", factor=scale.factor)
        draw_bar(below, scale, said, at=(edge, foot - FOOT / 2), inch=inch, size=look.type, lw=line)
        if look.has_legend:
            said = _meaning(len(spots) <= MANY, bool(spots.spreads.any()))
            size = fitting(said, look.wide - 2 * edge, look.type, letter=PLAIN)
            below.text(edge, FOOT / 2, said, fontsize=size, va="center", color=INK)
    return figure


def sheet_figure(
    view: View, wide: float, *, head: float = 0.0, foot: float = 0.0
) -> tuple[Figure, Axes]:
    """Return a figure with an axis in mm of the sheet, and these inches above and below it."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.figure import Figure

    high = wide * view.height / view.width
    tall = head + high + foot
    figure = Figure(figsize=(wide, tall))
    axis = figure.add_axes((0, foot / tall, 1, high / tall))
    show(axis, view)
    return figure, axis


def show(axis: Axes, view: View) -> None:
    """Let an axis without lines and ticks show a part of the plane."""
    axis.set_xlim(view.left, view.right)
    axis.set_ylim(view.bottom, view.top)
    axis.set_axis_off()


def strip(figure: Figure, foot: float) -> Axes:
    """Return an axis over the lower end of a figure, in inches."""
    wide, tall = figure.get_size_inches()
    axis = figure.add_axes((0, 0, 1, foot / tall))
    show(axis, View(0, wide, 0, foot))
    return axis


def write_title(
    figure: Figure, title: str, *, left: float, head: float, size: float, color: str = INK
) -> None:
    """Write a title above the sheet, as large as it fits; left, and height of its room [inch]."""
    wide, tall = figure.get_size_inches()
    size = fitting(title, wide - 2 * left, size)
    at = (left / wide, 1 - (head - 0.06) / tall)
    figure.text(*at, title, fontsize=size, fontweight="bold", color=color, va="bottom")


def fitting(words: str, width: float, size: float, *, letter: float = BOLD) -> float:
    """Return the size of type [point], this large or smaller, in which words fit a width [inch]."""
    return min(size, width / (letter * POINT * max(len(words), 1)))


def draw_wood(axis: Axes, sheet: tuple[float, float], line: float = 2.0) -> None:
    """Draw an empty sheet."""
    from matplotlib.patches import Rectangle

    corner = (-sheet[0] / 2, -sheet[1] / 2)
    axis.add_patch(Rectangle(corner, *sheet, fc=WOOD, ec=EDGE, lw=line))


def draw_errors(
    axis: Axes,
    spots: Spots,
    scale: Scale,
    *,
    good: bool,
    small: float = 1.0,
    sigma: float | None = None,
) -> None:
    """Draw a sheet with its marks, arrows and rings, as in arrow_figure."""
    show(axis, scale.view)
    draw_wood(axis, scale.sheet, 2 * small)
    part = small * float(np.clip(pitch_of(len(spots), scale.sheet) / ROOMY, 0.3, 1.0))
    axis.plot(
        *spots.places.T,
        "o",
        color="white",
        markeredgecolor=INK,
        markersize=6 * part,
        markeredgewidth=part,
        zorder=3,
    )
    axis.quiver(
        *spots.places.T,
        *(scale.factor * spots.errors).T,
        angles="xy",
        scale_units="xy",
        scale=1,
        units="inches",
        width=0.035 * part,
        headwidth=4.5,
        headlength=5.5,
        headaxislength=5,
        minlength=0.5,
        color=GOOD if good else BAD,
        zorder=4,
    )
    radii = spots.spreads if sigma is None else INSIDE * sigma / np.sqrt(spots.counts)
    radii = np.where(spots.doubted, 0.0, radii)
    _draw_rings(axis, spots.tips(scale.factor), scale.factor * radii, 0.9 * small)
    doubted = spots.places[spots.doubted]
    axis.plot(
        *doubted.T, "o", mfc="none", mec=BAD, ms=18 * small, mew=2.5 * small, zorder=6, gid="doubt"
    )


def _draw_rings(axis: Axes, tips: Array, radii: Array, line: float) -> None:
    """Draw a ring around each tip that has a radius."""
    from matplotlib.patches import Circle

    for tip, radius in zip(tips, radii, strict=True):
        if radius:
            axis.add_patch(Circle(tuple(tip), radius, fc="none", ec=INK, lw=line, zorder=5))


def _draw_words(
    axis: Axes, spots: Spots, scale: Scale, *, inch: float, size: float, names: bool
) -> None:
    """Write the length of each error next to its mark, and its name if that was asked for."""
    many = len(spots) > MANY
    if many and not names:
        return
    lengths = [bare(float(length), 1) for length in np.hypot(*spots.errors.T)]
    if many:
        words, size = list(spots.names), NAME
    else:
        named = zip(spots.names, lengths, strict=True)
        words = [f"{name}: {length}" if names and name else length for name, length in named]
    write_beside(axis, spots, words, scale, size=size, inch=inch)


def write_beside(
    axis: Axes,
    spots: Spots,
    words: Sequence[str],
    scale: Scale,
    *,
    size: float,
    inch: float,
    color: str = INK,
    weight: str = "normal",
) -> None:
    """Write words next to their marks; size [point], inch per mm."""
    letter = size * POINT / inch
    boxes = label_boxes(
        spots, words, factor=scale.factor, view=scale.view, size=letter, gap=GAP * letter
    )
    for (left, low, right, high), word in zip(boxes, words, strict=True):
        at = ((left + right) / 2, (low + high) / 2)
        drawn = axis.text(*at, word, fontsize=size, color=color, weight=weight, zorder=6)
        drawn.set(ha="center", va="center_baseline")


def _meaning(numbered: bool, repeated: bool) -> str:
    """Return what the signs of the picture mean."""
    said = ["circle: where the mark should be", "arrow: to where it was measured"]
    mean = ", of repeats their mean" if repeated else ""
    said += [f"number: {unit()}{mean}"] if numbered else []
    said += ["ring: how far repeats spread"] if repeated else []
    return "; ".join(said)


def draw_bar(
    axis: Axes,
    scale: Scale,
    said: str,
    *,
    at: tuple[float, float],
    inch: float,
    size: float,
    lw: float = 4.0,
) -> None:
    """Draw the scale's bar on a strip from this place [inch], and say next to it what it is."""
    left, y = at
    right = left + scale.bar * UNITS[unit()] * scale.factor * inch
    axis.plot([left, right], [y, y], color=INK, lw=lw, solid_capstyle="butt")
    size = fitting(said, axis.get_xlim()[1] - right - 2 * left, size, letter=PLAIN)
    axis.text(right + 0.1, y, said, fontsize=size, va="center", color=INK)


# Where a word goes next to its mark: clear of arrows, of other words and of the picture's edge.

LETTER, LINE = 0.66, 1.0  # a letter's width, a line's height: of the size of the type
SAMPLES = 24  # points of an arrow that a word should not cover
OUTSIDE, COVERED, SECOND, LATER = 1000.0, 30.0, 2.0, 0.1  # what a place costs: worst first
AROUND = [(np.cos(turn), np.sin(turn)) for turn in np.arange(8) * np.pi / 4]


def label_boxes(
    spots: Spots, words: Sequence[str], *, factor: float, view: View, size: float, gap: float
) -> Array:
    """Left, bottom, right and top [mm] of each word; size of the type and gap to the mark [mm]."""
    obstacles = _obstacles(spots, factor)
    boxes = np.zeros((0, 4))
    for place, error, word in zip(spots.places, spots.errors, words, strict=True):
        extent = np.array([LETTER * size * len(word), LINE * size])
        choices = _choices(place, error, extent, gap)
        # Only what is near can be in the way: with all else, a thousand names take long.
        low, high = np.min(choices, axis=0)[:2], np.max(choices, axis=0)[2:]
        near = obstacles[((obstacles > low) & (obstacles < high)).all(axis=1)]
        costs = [_cost(each, near, boxes, view) + _rank_cost(i) for i, each in enumerate(choices)]
        boxes = np.vstack([boxes, choices[least(costs)]])
    return boxes


def _obstacles(spots: Spots, factor: float) -> Array:
    """Points (n, 2) [mm] of all marks and arrows."""
    shares = np.linspace(0, 1, SAMPLES)[:, None, None]
    points: Array = (spots.places + shares * factor * spots.errors).reshape(-1, 2)
    return points


def _choices(place: Array, error: Array, extent: Array, gap: float) -> list[Array]:
    """Boxes around a place, those away from its arrow first, then the same farther out."""
    away = ranked(AROUND, lambda side: float(np.dot(side, error)))
    boxes = []
    for far in (1.0, 2.2):
        for side in away:
            middle = place + np.array(side) * (far * gap + extent / 2)
            boxes.append(np.concatenate([middle - extent / 2, middle + extent / 2]))
    return boxes


def _rank_cost(rank: int) -> float:
    return LATER * rank + (SECOND if rank >= len(AROUND) else 0.0)


def _cost(box: Array, obstacles: Array, boxes: Array, view: View) -> float:
    low, high = box[:2], box[2:]
    hit = int(((obstacles > low) & (obstacles < high)).all(axis=1).sum())
    over = int(((boxes[:, :2] < high) & (boxes[:, 2:] > low)).all(axis=1).sum())
    return hit + COVERED * over + OUTSIDE * (not view.holds(np.array([low, high])))
