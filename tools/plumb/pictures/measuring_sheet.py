"""A sheet of paper for the tape's readings: marks drawn and numbered, and a box for each number.

All is placed in mm on A4. What is printed keeps off the edges so far that US Letter takes it too.
"""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plumb.pictures.drawing import EDGE, INK, WOOD, read_as_written
from plumb.text.files import picture_metadata

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PAPER = (210.0, 297.0)  # [mm] A4
LEFT, TOP, WIDE, LOW = 15.0, 21.0, 180.0, 276.0  # [mm] what is printed on, on Letter too
ROW, HEAD = 8.0, 11.0  # [mm] a row of boxes, and the words above a column of them
NAME, BOX = 17.0, 20.0  # [mm] for the name of a row, and a box
GAP = 6.0  # [mm] between two columns of boxes
CROWDED = 5.0  # [mm] on the paper; holes nearer than this have no room for all names
POINT = 25.4 / 72  # [mm]
QUIET = "#777777"


@dataclass(frozen=True)
class Hole:
    """A mark to measure, as a hole in the wood."""

    name: str
    x: float  # [mm] from the sheet's left edge
    y: float  # [mm] from its top edge, downwards
    again: bool = False  # the same mark once more, a little further in


@dataclass(frozen=True)
class ReadingRow:
    """A row of boxes to fill in."""

    name: str
    planned: tuple[str, ...]  # what the tape should say; a box stands for each
    note: str = ""  # after the name


@dataclass(frozen=True)
class MeasuringSheet:
    """Contents of a printed sheet."""

    title: str
    how: tuple[str, ...]  # how to measure, a line each
    words: tuple[str, ...]  # above the boxes of a row
    holes: tuple[Hole, ...]
    readings: tuple[ReadingRow, ...]
    sheet: tuple[float, float]  # [mm] width and height of the wood


def measuring_sheet(content: MeasuringSheet) -> bytes:
    """Return the pages as a pdf."""
    from matplotlib.backends.backend_pdf import PdfPages

    file = io.BytesIO()
    with PdfPages(file, metadata=picture_metadata("pdf")) as pdf:
        for page in pages_of(content):
            read_as_written(page)
            pdf.savefig(page, facecolor="white")
    return file.getvalue()


def pages_of(content: MeasuringSheet) -> list[Figure]:
    """Return the pages, as many as the boxes need."""
    figure, axis = _page()
    low = _draw_head(axis, content)
    low = _draw_wood(axis, content, low)
    pages, left = [figure], list(content.readings)
    left = _draw_boxes(axis, content, left, top=low)
    while left:
        figure, axis = _page()
        pages.append(figure)
        title = f"{content.title}, page {len(pages)}"
        _write(axis, LEFT, TOP + 4, title, size=12, weight="bold")
        left = _draw_boxes(axis, content, left, top=TOP + 9)
    return pages


def _page() -> tuple[Figure, Axes]:
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    figure = Figure(figsize=(PAPER[0] / 25.4, PAPER[1] / 25.4))
    FigureCanvasAgg(figure)
    axis = figure.add_axes((0, 0, 1, 1))
    axis.set_xlim(0, PAPER[0])
    axis.set_ylim(PAPER[1], 0)
    axis.set_axis_off()
    return figure, axis


def _draw_head(axis: Axes, content: MeasuringSheet) -> float:
    """Title, what the owner writes once, and how to measure; returns where it ends [mm]."""
    _write(axis, LEFT, TOP + 5, content.title, size=17, weight="bold")
    y = TOP + 13.5
    for words, x, end in (
        ("Date", LEFT, LEFT + 50),
        ("Sled with router and bricks", LEFT + 56, LEFT + 124),
        ("Tape read by", LEFT + 130, LEFT + WIDE),
    ):
        _write(axis, x, y, words, size=9)
        axis.plot([x + 1.6 * len(words) + 3, end], [y + 0.6] * 2, color=QUIET, lw=0.6)
    _write(axis, LEFT + 124.5, y, "kg", size=9, left=False)
    y += 6.5
    for line in content.how:
        _write(axis, LEFT, y, line, size=9)
        y += 4.4
    return y


def _draw_wood(axis: Axes, content: MeasuringSheet, top: float) -> float:
    """Return the sheet of wood with its holes; returns where it ends [mm]."""
    from matplotlib.patches import Rectangle

    width, height = content.sheet
    edge = 7.0  # [mm] for the words along the edges
    scale = min((WIDE - edge) / width, 105.0 / height)
    left, upper = LEFT + edge, top + edge
    axis.add_patch(
        Rectangle((left, upper), scale * width, scale * height, fc=WOOD, ec=EDGE, lw=0.8)
    )
    _draw_tape(axis, content, left, upper, scale)
    for hole in content.holes:
        inside = "white" if hole.again else INK
        place = left + scale * hole.x, upper + scale * hole.y
        axis.plot(*place, "o", ms=2.6, mfc=inside, mec=INK, mew=0.6, zorder=4)
    _draw_names(axis, content, left, upper, scale)
    return upper + scale * height + 3


def _draw_names(
    axis: Axes, content: MeasuringSheet, left: float, upper: float, scale: float
) -> None:
    """Write the names of the holes below them; of many only those at the ends of the rows."""
    names = {hole.name: hole for hole in reversed(content.holes)}.values()
    step = _least_step(list(names), scale)
    size = max(4.5, min(9.0, 0.55 * step / POINT))
    ends = {min(hole.x for hole in names): "right", max(hole.x for hole in names): "left"}
    for hole in names:
        x, y = left + scale * hole.x, upper + scale * hole.y
        if step >= CROWDED:
            up = scale * (content.sheet[1] - hole.y) < size * POINT + 2
            place, side = (x, y - 1.9 if up else y + size * POINT + 1.3), "center"
        elif hole.x in ends:
            side = ends[hole.x]
            place = x + (1.5 if side == "left" else -1.5), y + 0.35 * size * POINT
        else:
            continue
        halo = {"fc": WOOD, "ec": "none", "pad": 0.8} if step >= CROWDED else None
        axis.text(
            *place, hole.name, size=size, weight="bold", color=INK, ha=side, zorder=3, bbox=halo
        )


def _least_step(holes: Sequence[Hole], scale: float) -> float:
    """[mm] on the paper between the two nearest."""
    places = scale * np.array([(hole.x, hole.y) for hole in holes])
    apart = np.hypot(*(places[:, np.newaxis] - places).T)
    np.fill_diagonal(apart, np.inf)
    return float(apart.min())


def _draw_tape(
    axis: Axes, content: MeasuringSheet, left: float, upper: float, scale: float
) -> None:
    """Draw the edges from which the tape is read, and both numbers of a hole."""
    width, height = (scale * size for size in content.sheet)
    axis.plot([left, left, left + width], [upper + height, upper, upper], color=INK, lw=2.2)
    _write(axis, left, upper - 1.8, "top edge: y counts down from here", size=8)
    axis.text(
        left - 1.8,
        upper + height,
        "left edge: x counts from here",
        size=8,
        rotation=90,
        ha="right",
        va="bottom",
        color=INK,
    )
    middle = content.sheet[0] / 2, content.sheet[1] / 2
    shown = min(
        (hole for hole in content.holes if not hole.again),
        key=lambda hole: abs(hole.x - 0.7 * middle[0]) + abs(hole.y - middle[1]),
    )
    x, y = left + scale * shown.x, upper + scale * shown.y
    for start, words, at in (
        ((left, y), "x", (left + 0.35 * (x - left), y - 1.2)),
        ((x, upper), "y", (x + 1.4, upper + 0.45 * (y - upper))),
    ):
        arrow = {"arrowstyle": "<|-|>", "color": QUIET, "lw": 0.8, "mutation_scale": 7}
        axis.annotate("", xy=(x, y), xytext=start, arrowprops=arrow, zorder=2)
        axis.text(*at, words, size=9, style="italic", color=QUIET)


def _draw_boxes(
    axis: Axes, content: MeasuringSheet, readings: list[ReadingRow], *, top: float
) -> list[ReadingRow]:
    """Rows of boxes in two columns; returns the readings that have no room on this page."""
    wide = (WIDE - GAP) / 2
    rows = int((LOW - top - HEAD) / ROW)
    fitting = min(rows, -(-len(readings) // 2))
    for column in range(2):
        mine = readings[column * fitting : (column + 1) * fitting]
        if mine:
            _draw_column(axis, content, mine, LEFT + column * (wide + GAP), top, wide)
    return readings[2 * fitting :]


def _draw_column(
    axis: Axes,
    content: MeasuringSheet,
    readings: Sequence[ReadingRow],
    left: float,
    top: float,
    wide: float,
) -> None:
    from matplotlib.patches import Rectangle

    count = len(readings[0].planned)
    boxes = left + wide - count * BOX
    step = (boxes - left - NAME) / count
    _write(axis, left, top + 9, content.words[0], size=7.5)
    for i, words in enumerate(content.words[1 : 1 + count]):
        _write(axis, left + NAME + (i + 1) * step - 2, top + 9, words, size=7.5, left=False)
    for i, words in enumerate(content.words[1 + count :]):
        _write(axis, boxes + i * BOX + 1, top + 9, words, size=8.5, weight="bold")
    for i, reading in enumerate(readings):
        y = top + HEAD + i * ROW
        _write(axis, left, y + 5.4, reading.name, size=10, weight="bold")
        _write(axis, left + 7.5, y + 5.4, reading.note, size=8)
        for k, planned in enumerate(reading.planned):
            end = left + NAME + (k + 1) * step - 2
            _write(axis, end, y + 5.4, planned, size=9, left=False, colour=QUIET)
            corner = (boxes + k * BOX, y)
            axis.add_patch(Rectangle(corner, BOX, ROW, fc="white", ec=INK, lw=0.7))


def _write(
    axis: Axes,
    x: float,
    y: float,
    words: str,
    *,
    size: float,
    weight: str = "normal",
    left: bool = True,
    colour: str = INK,
) -> None:
    """Write a line of text that begins, or ends, at x; y is its base line [mm]."""
    side = "left" if left else "right"
    axis.text(x, y, words, size=size, weight=weight, ha=side, va="baseline", color=colour)
