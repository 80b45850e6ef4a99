"""Pictures of errors on the sheet: where marks lie against where they were predicted."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from functools import partial
from typing import TYPE_CHECKING

import numpy as np

from plumb.model.plain import least, ranked
from plumb.pictures.scale import (
    Panel,
    Spots,
    View,
    exaggeration,
    pitch_of,
    round_down,
    saved,
    spots_of,
    view_of,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes


Array = np.ndarray
WIDTH = 8.6  # [inch] of a picture
MARGIN = 0.05  # left and right of the sheet, of its width
TITLE, FOOT = 0.45, 0.85  # [inch] above each sheet, and below the last
FORMATS = ("png", "svg", "pdf")
WOOD, EDGE, INK = "#f3e7d3", "#8a6d3b", "#222222"
BAD, GOOD = "#c64f00", "#0b62a4"  # orange and blue: apart for every eye
MANY = 60  # marks from which a picture has no numbers
ROOMY = 200.0  # [mm] between marks that are drawn in full size
POINT = 1 / 72  # [inch]
NUMBER, NAME = 12.0, 5.0  # [point] of a number, and of a name among many
BOLD, PLAIN = 0.68, 0.56  # width of a letter in a sentence, of the size of its type


def draw(
    panels: Sequence[Panel],
    *,
    sheet: tuple[float, float],
    form: str = "png",
    names: bool = False,
) -> bytes:
    """Return the picture of sheets, each below the last, all arrows to the same scale."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    marks = [spots_of(panel) for panel in panels]
    factor = exaggeration(marks, sheet)
    views = [view_of([spots], sheet, factor) for spots in marks]
    left, right = min(view.left for view in views), max(view.right for view in views)
    views = [View(left, right, view.bottom, view.top) for view in views]
    inch = WIDTH / (right - left)  # per mm
    tall = sum(TITLE + inch * view.height for view in views) + FOOT
    figure = Figure(figsize=(WIDTH, tall))
    FigureCanvasAgg(figure)
    edge = (-sheet[0] / 2 - left) * inch
    upper = tall
    for panel, spots, view in zip(panels, marks, views, strict=True):
        upper -= TITLE + inch * view.height
        axis = figure.add_axes((0, upper / tall, 1, inch * view.height / tall))
        draw_errors(axis, spots, view, sheet=sheet, factor=factor, good=panel.good)
        _draw_words(axis, spots, view, factor=factor, inch=inch, names=names)
        size = fitting(panel.title, WIDTH - 2 * edge, 16)
        y = (upper + inch * view.height + 0.06) / tall
        colour = GOOD if panel.good else BAD
        write = partial(figure.text, fontweight="bold", color=colour, va="bottom")
        write(edge / WIDTH, y, panel.title, fontsize=size)
    repeated = any(spots.spreads.any() for spots in marks)
    scale = _Scale(factor, max(spots.longest for spots in marks), inch, edge)
    numbered = min(map(len, marks)) <= MANY
    _draw_scale(figure.add_axes((0, 0, 1, FOOT / tall)), scale, _meaning(numbered, repeated))
    return saved(figure, form)


def fitting(words: str, width: float, size: float, *, letter: float = BOLD) -> float:
    """Return the size of type [point], this large or smaller, in which words fit a width [inch]."""
    return min(size, width / (letter * POINT * max(len(words), 1)))


def draw_errors(
    axis: Axes,
    spots: Spots,
    view: View,
    *,
    sheet: tuple[float, float],
    factor: float,
    good: bool,
    small: float = 1.0,
    rings: Array | None = None,
) -> None:
    """Draw a sheet with its marks and arrows; small: of the size of a single picture; rings (k,)
    [mm] around their tips: if not given, how far repeats spread.
    """
    from matplotlib.patches import Rectangle

    axis.set_xlim(view.left, view.right)
    axis.set_ylim(view.bottom, view.top)
    axis.set_axis_off()
    width, height = sheet
    wood = Rectangle((-width / 2, -height / 2), width, height, fc=WOOD, ec=EDGE, lw=2 * small)
    axis.add_patch(wood)
    part = small * float(np.clip(pitch_of(len(spots), sheet) / ROOMY, 0.3, 1.0))
    axis.plot(
        *spots.places.T,
        "o",
        color="white",
        markeredgecolor=INK,
        markersize=6 * part,
        markeredgewidth=part,
        zorder=3,
    )
    colour = GOOD if good else BAD
    axis.quiver(
        *spots.places.T,
        *(factor * spots.errors).T,
        angles="xy",
        scale_units="xy",
        scale=1,
        units="inches",
        width=0.035 * part,
        headwidth=4.5,
        headlength=5.5,
        headaxislength=5,
        minlength=0.5,
        color=colour,
        zorder=4,
    )
    radii = factor * (spots.spreads if rings is None else rings)
    _draw_rings(axis, spots.tips(factor), radii, 0.9 * small * (1.0 if rings is None else part))


def _draw_rings(axis: Axes, tips: Array, radii: Array, line: float) -> None:
    """Draw a ring around each tip that has a radius."""
    from matplotlib.patches import Circle

    for tip, radius in zip(tips, radii, strict=True):
        if radius:
            axis.add_patch(Circle(tuple(tip), radius, fc="none", ec=INK, lw=line, zorder=5))


def _draw_words(
    axis: Axes, spots: Spots, view: View, *, factor: float, inch: float, names: bool
) -> None:
    """Write the length of each error next to its mark, and its name if that was asked for."""
    many = len(spots) > MANY
    if many and not names:
        return
    lengths = [f"{length:.1f}" for length in np.hypot(*spots.errors.T)]
    if many:
        words = list(spots.names)
    else:
        named = zip(spots.names, lengths, strict=True)
        words = [f"{name}: {length}" if names and name else length for name, length in named]
    points = NAME if many else NUMBER
    gap = (0.6 if many else 1.0) * 8 * POINT / inch
    boxes = label_boxes(spots, words, factor=factor, view=view, size=points * POINT / inch, gap=gap)
    for (left, low, right, high), word in zip(boxes, words, strict=True):
        at = ((left + right) / 2, (low + high) / 2)
        axis.text(*at, word, ha="center", va="center_baseline", fontsize=points, color=INK)


def _meaning(numbered: bool, repeated: bool) -> str:
    """Return what the signs of the picture mean."""
    said = ["circle: where the mark should be", "arrow: to where it was measured"]
    said += ["number: mm"] if numbered else []
    said += ["ring: how far repeats spread"] if repeated else []
    return "; ".join(said)


@dataclass(frozen=True)
class _Scale:
    """What the bar below the sheets shows."""

    factor: float
    largest: float  # [mm] error
    inch: float  # per mm
    left: float  # [inch] of the sheet's edge


def _draw_scale(axis: Axes, scale: _Scale, meaning: str) -> None:
    """Draw a bar of a round length below the last sheet, and say what the arrows mean."""
    axis.set_xlim(0, WIDTH)
    axis.set_ylim(0, FOOT)
    axis.set_axis_off()
    bar = round_down(max(scale.largest, 1e-6))
    left = scale.left
    right = left + bar * scale.factor * scale.inch
    axis.plot([left, right], [0.6, 0.6], color=INK, lw=4, solid_capstyle="butt")
    write = partial(axis.text, va="center", color=INK)
    said = f"{bar:g} mm of error: arrows {scale.factor:g} times life size"
    write(right + 0.12, 0.6, said, fontsize=12)
    write(left, 0.27, meaning, fontsize=fitting(meaning, WIDTH - 2 * left, 12, letter=PLAIN))


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
