"""A picture of a preview: the planned marks, and the places of the best additions, numbered."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from plumb.model.plain import noun_of
from plumb.pictures.labels import label_boxes
from plumb.pictures.panel import Panel, spots_of
from plumb.pictures.saved import saved
from plumb.pictures.scale import view_of
from plumb.pictures.sheet import EDGE, GOOD, INK, MARGIN, POINT, WIDTH, WOOD, fitting
from plumb.plan.preview import PlanAddition, Preview

if TYPE_CHECKING:
    from matplotlib.axes import Axes

PREVIEW_TITLE, PREVIEW_LINE, PREVIEW_FOOT = (
    0.5,
    0.22,
    0.2,
)  # [inch] above the sheet, of a line below it, below the lines
PLACED, PLACELESS, CROWD = 3, 3, 12  # additions with places and without, and marks of each
LETTERS = 108  # of a line
NUMBER, WORDS = 12.0, 10.0  # [point]


def draw_preview(preview: Preview, *, sheet: tuple[float, float], form: str = "png") -> bytes:
    """The sheet with the plan and its best additions, and below it what they tell."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    inch = WIDTH / (sheet[0] * (1 + 2 * MARGIN))
    lines = [line for said in sentences_of(preview) for line in wrap(said, LETTERS)]
    foot = PREVIEW_FOOT + PREVIEW_LINE * len(lines)
    low = inch * sheet[1] * 1.06
    tall = PREVIEW_TITLE + low + foot
    figure = Figure(figsize=(WIDTH, tall))
    FigureCanvasAgg(figure)
    axis = figure.add_axes((0, foot / tall, 1, low / tall))
    axis.set_xlim(-sheet[0] * (0.5 + MARGIN), sheet[0] * (0.5 + MARGIN))
    axis.set_ylim(-0.53 * sheet[1], 0.53 * sheet[1])
    axis.set_axis_off()
    _draw_places(axis, preview, sheet, inch)
    left = MARGIN / (1 + 2 * MARGIN)
    title = f"What these {preview.marks} marks could tell, read to {preview.sigma:g} mm"
    size = fitting(title, WIDTH * (1 - 2 * left), 15)
    figure.text(left, 1 - 0.36 / tall, title, fontsize=size, fontweight="bold", color=INK)
    for i, line in enumerate(lines):
        y = (foot - 0.1 - PREVIEW_LINE * (i + 0.5)) / tall
        figure.text(left, y, line, fontsize=WORDS, color=INK, va="center")
    return saved(figure, form)


def sentences_of(preview: Preview) -> list[str]:
    """What the plan finds, what it misses, and a sentence for each numbered addition."""
    seen = [outline for outline in preview.outlines if _is_seen(outline.smallest)]
    missed = [outline for outline in preview.outlines if not _is_seen(outline.smallest)]
    said = [
        f"{what}: {', '.join(noun_of(outline.effect) for outline in outlines)}."
        for what, outlines in (
            ("Found in their usual size", seen),
            ("Not found in their usual size", missed),
        )
        if outlines
    ]
    pairs = f"{preview.pairs} of {preview.matrix.size}"
    said += [
        f"Of all causes against each other, {pairs} are told apart.",
        "More would be with what follows; numbers show where on the sheet:",
    ]
    said += [f"{i}: {_promise(each)}." for i, each in enumerate(with_places(preview), 1)]
    without = [each for each in preview.additions if not len(each.option.visits)][:PLACELESS]
    return said + [f"Without a mark: {_promise(each)}." for each in without]


def with_places(preview: Preview) -> list[PlanAddition]:
    """The best additions whose marks are few enough to be shown: they get numbers."""
    placed = [each for each in preview.additions if 0 < len(each.option.visits) <= CROWD]
    return placed[:PLACED]


def numbered_places(preview: Preview) -> list[tuple[str, np.ndarray]]:
    """The numbers of the additions that go to a place, and the place [mm]."""
    numbers: dict[tuple[float, ...], list[int]] = {}
    for number, addition in enumerate(with_places(preview), 1):
        for target in np.unique(np.round(addition.option.visits.targets), axis=0):
            numbers.setdefault(tuple(target.tolist()), []).append(number)
    return [(", ".join(map(str, each)), np.array(place)) for place, each in numbers.items()]


def _promise(addition: PlanAddition) -> str:
    option = addition.option
    return f"{option.title}, about {option.minutes:.0f} minutes: {addition.pairs} told apart"


def _is_seen(smallest: float | None) -> bool:
    return smallest is not None and smallest <= 1


def _draw_places(axis: Axes, preview: Preview, sheet: tuple[float, float], inch: float) -> None:
    from matplotlib.patches import Rectangle

    width, height = sheet
    axis.add_patch(Rectangle((-width / 2, -height / 2), width, height, fc=WOOD, ec=EDGE, lw=2))
    if len(preview.targets):
        axis.plot(*preview.targets.T, "o", color="white", markeredgecolor=INK, markersize=7)
    numbered = numbered_places(preview)
    if numbered:
        _draw_numbers(axis, numbered, sheet, inch)


def _draw_numbers(
    axis: Axes, numbered: Sequence[tuple[str, np.ndarray]], sheet: tuple[float, float], inch: float
) -> None:
    places = np.array([place for _, place in numbered])
    axis.plot(*places.T, "D", color=GOOD, markersize=7, markeredgecolor="white", zorder=4)
    # Two places of an addition next to each other share its number.
    spots = spots_of(Panel("", places, 0 * places, names=tuple(said for said, _ in numbered)))
    view = view_of([spots], sheet, 1.0)
    boxes = label_boxes(
        spots, spots.names, factor=1.0, view=view, size=NUMBER * POINT / inch, gap=9 * POINT / inch
    )
    for (left, bottom, right, top), said in zip(boxes, spots.names, strict=True):
        at = ((left + right) / 2, (bottom + top) / 2)
        axis.text(
            *at, said, ha="center", va="center_baseline", fontsize=NUMBER, weight="bold", color=GOOD
        )
