"""Small pictures of fields over the sheet as SVG text: the same numbers give the same bytes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from plumb.pictures.scale import Panel, Scale, Spots, View, round_down, saved, spots_of
from plumb.pictures.sheet import (
    BAD,
    EDGE,
    GOOD,
    INK,
    WOOD,
    draw_bar,
    draw_errors,
    fitting,
    show,
    strip,
)

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


Array = np.ndarray
SCALE = 0.14  # [px/mm] of the sheet
LONGEST = 40.0  # [px] of an arrow
BESIDE, ABOVE, BELOW = 36.0, 72.0, 56.0  # [px] around each sheet
HEAD = 6.5  # [px] of an arrow; shorter arrows have none
DOT = 2.0  # [px] radius
ARROW, FAINT = "#c0392b", "#d9a59c"
FONT = 'font-family="Helvetica, Arial, sans-serif"'


@dataclass(frozen=True)
class Picture:
    """One sheet with its arrows."""

    heading: str
    sent: Array  # (rows, columns, 2) [mm]
    errors: Array | None  # (rows, columns, 2) [mm]; None: nothing to see
    note: str = ""  # said instead of arrows


def drawing(
    title: str, rows: Sequence[tuple[str, Sequence[Picture]]], *, sheet: tuple[float, float]
) -> str:
    """Return the text of an SVG: labelled rows of sheets [mm], each to its scale."""
    wide, tall = SCALE * sheet[0] + 2 * BESIDE, SCALE * sheet[1] + ABOVE + BELOW
    width = wide * max(len(pictures) for _, pictures in rows)
    height = tall * len(rows)
    lines = [
        f'<svg xmlns="http://www.w3.org/2000/svg" width="{_n(width)}" height="{_n(height)}" '
        f'viewBox="0 0 {_n(width)} {_n(height)}" role="img">',
        f"<title>{escape(title)}</title>",
        f'<rect width="{_n(width)}" height="{_n(height)}" fill="white"/>',
    ]
    for i, (label, pictures) in enumerate(rows):
        lines.append(_text(BESIDE, tall * i + 20, label, size=15, bold=True))
        for j, picture in enumerate(pictures):
            middle = ((j + 0.5) * wide, tall * i + ABOVE + SCALE * sheet[1] / 2)
            lines += _sheet(picture, sheet, middle)
    return "\n".join([*lines, "</svg>", ""])


def factor_for(errors: Array) -> float:
    """Return how much longer than life the arrows of these errors [mm] are drawn."""
    return round_down(LONGEST / (SCALE * float(np.linalg.norm(errors, axis=-1).max())))


def _sheet(picture: Picture, sheet: tuple[float, float], middle: tuple[float, float]) -> list[str]:
    """Return one sheet around a middle [px]."""
    width, height = SCALE * sheet[0], SCALE * sheet[1]
    left, top = middle[0] - width / 2, middle[1] - height / 2
    lines = [
        _text(left, top - ABOVE + 40, picture.heading, size=12.5),
        f'<rect x="{_n(left)}" y="{_n(top)}" width="{_n(width)}" height="{_n(height)}" '
        f'fill="{WOOD}" stroke="{EDGE}" stroke-width="1.5"/>',
    ]
    starts = _on_paper(picture.sent, middle)
    if picture.errors is None:
        said = _text(middle[0], top + height + 22, picture.note, size=12.5, anchor="middle")
        return [*lines, _dots(starts), said]
    factor = factor_for(picture.errors)
    ends = _on_paper(picture.sent + factor * picture.errors, middle)
    bent = "".join("M" + "L".join(_pair(end) for end in row) for row in ends)
    return [
        *lines,
        f'<path d="{bent}" fill="none" stroke="{FAINT}"/>',
        _dots(starts),
        *_arrows(starts.reshape(-1, 2), ends.reshape(-1, 2)),
        *_scale_bar(picture.errors, factor, left, top + height + BELOW - 20),
    ]


def _scale_bar(errors: Array, factor: float, left: float, height: float) -> list[str]:
    """Return a bar of a round length, and the exaggeration."""
    bar = round_down(float(np.linalg.norm(errors, axis=-1).max()))
    right = left + SCALE * factor * bar
    line = (
        f'<path d="M{_n(left)} {_n(height - 4)}v8m0 -4H{_n(right)}m0 -4v8" fill="none" '
        f'stroke="{INK}" stroke-width="1.6"/>'
    )
    said = f"{bar:g} mm; arrows {factor:g} times life size"
    return [line, _text(right + 8, height + 4, said, size=12.5)]


def _dots(places: Array) -> str:
    """Circles where marks were sent."""
    # Two half circles each: a path for all is much shorter than a circle each.
    rings = "".join(
        f"M{_n(x - DOT)} {_n(y)}a{DOT:g} {DOT:g} 0 1 0 {2 * DOT:g} 0a{DOT:g} {DOT:g} 0 1 0 "
        f"{-2 * DOT:g} 0"
        for x, y in places.reshape(-1, 2)
    )
    return f'<path d="{rings}" fill="white" stroke="{INK}"/>'


def _arrows(starts: Array, ends: Array) -> list[str]:
    """Arrows [px] (n, 2), without a head if too short, and none below a pixel."""
    lines, heads = "", ""
    for start, end in zip(starts, ends, strict=True):
        length = float(np.hypot(*(end - start)))
        if length < 1:
            continue
        unit = (end - start) / length
        neck = end - HEAD * unit if length > HEAD else end
        lines += f"M{_pair(start)}L{_pair(neck)}"
        if length > HEAD:
            across = 0.42 * HEAD * np.array([-unit[1], unit[0]])
            heads += f"M{_pair(end)}L{_pair(neck + across)}L{_pair(neck - across)}z"
    return [
        f'<path d="{lines}" fill="none" stroke="{ARROW}" stroke-width="1.6"/>',
        f'<path d="{heads}" fill="{ARROW}"/>',
    ]


def _on_paper(places: Array, middle: tuple[float, float]) -> Array:
    """Return places [mm], y up, on paper [px], y down."""
    flipped: Array = places * np.array([1.0, -1.0])
    return np.array(middle) + SCALE * flipped


def _text(
    x: float, y: float, said: str, *, size: float, bold: bool = False, anchor: str = "start"
) -> str:
    weight = ' font-weight="bold"' if bold else ""
    place = "" if anchor == "start" else f' text-anchor="{anchor}"'
    return (
        f'<text x="{_n(x)}" y="{_n(y)}" {FONT} font-size="{size:g}"{weight}{place} fill="{INK}">'
        f"{escape(said)}</text>"
    )


def _pair(place: Array) -> str:
    return f"{_n(place[0])} {_n(place[1])}"


def _n(value: float) -> str:
    """Return a coordinate to a tenth of a pixel, without a needless sign or point."""
    return f"{round(float(value), 1) + 0.0:g}"


# How the error falls: small sheets next to each other, and below each a bar as high as its RMS.

Box = tuple[float, float, float, float]
WIDE = 3.0  # [inch] of a small sheet with what is around it
HEADING, TITLE, BARS, FOOT, LEFT = 0.55, 0.5, 1.5, 0.5, 0.15  # [inch] from top to bottom, and left
ROW = 5  # sheets next to each other; more go below them
TALLEST, BROAD = 1.15, 0.8  # [inch] height of the highest bar, width of each
LETTERS = 22  # of a line above a sheet
SMALL = 0.5  # of the signs of a picture of a single sheet


@dataclass(frozen=True)
class Stair:
    """A sheet and the error left on it."""

    panel: Panel
    rms: float  # [mm]


def draw_staircase(
    stairs: Sequence[Stair], *, heading: str, sheet: tuple[float, float], form: str = "png"
) -> bytes:
    """Return the picture of a fall, all arrows and bars to the same scale."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.figure import Figure

    plan = _layout(stairs, sheet)
    figure = Figure(figsize=(plan.wide, plan.tall))
    size = fitting(heading, plan.wide - 2 * LEFT, 17)
    left, y = LEFT / plan.wide, 1 - HEADING / 2 / plan.tall
    figure.text(left, y, heading, fontsize=size, fontweight="bold", color=INK, va="center")
    for i, stair in enumerate(stairs):
        _draw_stair(figure, plan, i, stair)
    said = (
        f"{plan.scale.bar:g} mm of error; arrows, {plan.scale.factor:g} times life size, go from "
        "where marks should be to where they were measured"
    )
    below = strip(figure, FOOT)
    draw_bar(below, plan.scale, said, at=(LEFT, FOOT / 2), inch=plan.inch, size=11)
    return saved(figure, form)


def columns_for(count: int) -> int:
    """Return how many sheets stand next to each other, so that rows are about as long."""
    rows = -(-count // ROW)
    return -(-count // rows)


@dataclass(frozen=True)
class _Layout:
    """Where the stairs of a picture go."""

    marks: list[Spots]
    scale: Scale
    columns: int
    highest: float  # [mm] RMS

    @property
    def inch(self) -> float:
        """Per mm of the sheet."""
        return (WIDE - 2 * LEFT) / self.scale.view.width

    @property
    def step(self) -> float:
        """[inch] of a row."""
        return TITLE + self.inch * self.scale.view.height + BARS

    @property
    def wide(self) -> float:
        """[inch]."""
        return self.columns * WIDE

    @property
    def tall(self) -> float:
        """[inch]."""
        rows = -(-len(self.marks) // self.columns)
        return HEADING + rows * self.step + FOOT

    def box(self, i: int, low: float, height: float, edge: float) -> Box:
        """Return a part of a stair as shares of the picture: left, bottom, width, height."""
        left = WIDE * (i % self.columns) + edge
        bottom = self.tall - HEADING - self.step * (i // self.columns + 1) + low
        return (
            left / self.wide,
            bottom / self.tall,
            (WIDE - 2 * edge) / self.wide,
            height / self.tall,
        )


def _layout(stairs: Sequence[Stair], sheet: tuple[float, float]) -> _Layout:
    marks = [spots_of(stair.panel) for stair in stairs]
    highest = max(*(stair.rms for stair in stairs), 1e-6)
    return _Layout(marks, Scale.of(marks, sheet), columns_for(len(stairs)), highest)


def _draw_stair(figure: Figure, plan: _Layout, i: int, stair: Stair) -> None:
    panel, colour = stair.panel, GOOD if stair.panel.good else BAD
    axis = figure.add_axes(plan.box(i, BARS, plan.step - BARS - TITLE, LEFT))
    draw_errors(axis, plan.marks[i], plan.scale, good=panel.good, small=SMALL)
    lines = wrap(panel.title, LETTERS)
    left, bottom, width, height = plan.box(i, plan.step - TITLE, TITLE, LEFT)
    figure.text(
        left + width / 2,
        bottom + height / 2,
        "\n".join(lines),
        fontsize=fitting(max(lines, key=len), WIDE - 2 * LEFT, 12),
        fontweight="bold",
        color=colour,
        ha="center",
        va="center",
    )
    _draw_bar(figure.add_axes(plan.box(i, 0, BARS, 0)), stair.rms, plan.highest, colour)


def _draw_bar(axis: Axes, rms: float, highest: float, colour: str) -> None:
    """Draw a bar on the ground, its number above it."""
    show(axis, View(0, WIDE, 0, BARS))
    height = bar_height(rms, highest)
    axis.bar(WIDE / 2, height, BROAD, color=colour)
    axis.plot([0, WIDE], [0, 0], color=INK, lw=1.5, clip_on=False)
    said = f"{rms:.{1 if rms >= 0.95 else 2}f} mm RMS"
    axis.text(WIDE / 2, height + 0.06, said, ha="center", va="bottom", fontsize=13, color=INK)


def bar_height(rms: float, highest: float) -> float:
    """[inch] of the bar of an RMS, where the highest bar is of another [mm]."""
    return TALLEST * rms / highest
