"""A picture of a proposal: the measured and the proposed marks on the sheet."""

from __future__ import annotations

from collections.abc import Sequence
from textwrap import wrap
from typing import TYPE_CHECKING

import numpy as np

from plumb.model.plain import noun_of
from plumb.pictures.scale import Panel, saved, spots_of, view_of
from plumb.pictures.sheet import (
    EDGE,
    GOOD,
    INK,
    MARGIN,
    PLAIN,
    POINT,
    WIDTH,
    WOOD,
    fitting,
    label_boxes,
)
from plumb.plan.planned_visits import Visits
from plumb.plan.preview import PlanAddition, Preview
from plumb.settings.machine import GRAVITY

if TYPE_CHECKING:
    from matplotlib.axes import Axes


TITLE, LINE, FOOT = 0.5, 0.3, 0.2  # [inch] above the sheet, a line of the legend, below it
SENTENCE, MOST = 0.22, 40  # [inch] of a sentence, and how many there is room for
LINES = 8  # sentences below each other, before there are two columns
NEW, HEAVY, SWAPPED = "#0b62a4", "#c64f00", "#222222"  # apart for every eye
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
    """Return the sheet with old marks (n, 2) [mm] and planned visits, numbered in their order."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    width, height = sheet
    inch = WIDTH / (width * (1 + 2 * MARGIN))
    legend = _legend(visits, old, usual_weight)
    said = place_sentences(visits, usual_weight=usual_weight, sheet=sheet)
    rows = rows_for(len(said))
    foot = FOOT + LINE * len(legend) + SENTENCE * rows
    tall = TITLE + inch * height * 1.06 + foot
    figure = Figure(figsize=(WIDTH, tall))
    FigureCanvasAgg(figure)
    axis = figure.add_axes((0, foot / tall, 1, inch * height * 1.06 / tall))
    axis.set_xlim(-width * (0.5 + MARGIN), width * (0.5 + MARGIN))
    axis.set_ylim(-0.53 * height, 0.53 * height)
    axis.set_axis_off()
    _draw_sheet(axis, visits, old, usual_weight, sheet)
    left = MARGIN / (1 + 2 * MARGIN)
    size = fitting(title, WIDTH * (1 - 2 * left), 15)
    figure.text(left, 1 - 0.36 / tall, title, fontsize=size, fontweight="bold", color=INK)
    below = figure.add_axes((0, 0, 1, foot / tall))
    _draw_legend(below, legend, foot)
    _draw_sentences(below, said, SENTENCE * rows + FOOT / 2)
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
    axis.text(
        at[0] + 0.022 * height * (1 if at[0] < 0 else -1),
        at[1] + 0.045 * height * down,
        str(numbers[0]),
        ha="left" if at[0] < 0 else "right",
        va="center",
        fontsize=12,
        fontweight="bold",
        color=colour,
        zorder=6,
    )


def place_sentences(
    visits: Visits, *, usual_weight: float, sheet: tuple[float, float]
) -> list[str]:
    """Return what to do at each numbered place; none for more places than a page has room for."""
    groups = _by_place(visits)
    if len(groups) > MOST:
        return []
    return [_sentence(visits, numbers, i, usual_weight, sheet) for numbers, i in groups]


def _sentence(
    visits: Visits, numbers: list[int], i: int, usual_weight: float, sheet: tuple[float, float]
) -> str:
    x, y = visits.targets[i] + np.array(sheet) / 2
    said = [f"{x:.0f} mm from the left, {sheet[1] - y:.0f} mm from the top"]
    extra = (visits.sled_weights[i] - usual_weight) / GRAVITY
    if extra > 0.01 * usual_weight / GRAVITY:
        said.append(f"{extra:.1f} kg more")
    if visits.swapped[i]:
        said.append("chains swapped")
    sides = {_direction(visits.approaches[number - 1]) for number in numbers}
    said += [f"arrive {side}" for side in sorted(filter(None, sides))]
    said += [f"{len(numbers)} times"] if len(numbers) > 1 else []
    return f"{numbers[0]}: {', '.join(said)}"


def _direction(side: np.ndarray) -> str:
    """Return the direction of the last move in a word; none if it is not prescribed."""
    if not side.any():
        return ""
    across, up = side
    if abs(across) > abs(up):
        return "rightwards" if across > 0 else "leftwards"
    return "upwards" if up > 0 else "downwards"


def rows_for(count: int) -> int:
    """Sentences below each other, in a column or in two."""
    return count if count <= LINES else -(-count // 2)


def _draw_sentences(axis: Axes, said: Sequence[str], top: float) -> None:
    """Write the sentences in columns, read downwards; top [inch]."""
    rows = rows_for(len(said))
    left = WIDTH * MARGIN / (1 + 2 * MARGIN)
    wide = (WIDTH - 2 * left) / (1 if len(said) <= LINES else 2)
    size = min((fitting(each, wide - 0.15, 11, letter=PLAIN) for each in said), default=11)
    for i, sentence in enumerate(said):
        x, y = left + wide * (i // rows), top - SENTENCE * (i % rows + 0.5)
        axis.text(x, y, sentence, fontsize=size, color=INK, va="center")


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


# A picture of a preview: the planned marks, and the places of the best additions, numbered.

PREVIEW_TITLE, PREVIEW_LINE, PREVIEW_FOOT = (
    0.5,
    0.22,
    0.2,
)  # [inch] above the sheet, of a line below it, below the lines
PLACED, PLACELESS, CROWD = 3, 3, 12  # additions with places and without, and marks of each
LETTERS = 108  # of a line
NUMBER, WORDS = 12.0, 10.0  # [point]


def draw_preview(preview: Preview, *, sheet: tuple[float, float], form: str = "png") -> bytes:
    """Return the sheet with the plan and its best additions, and below it what they tell."""
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
    """Return what the plan finds, what it misses, and a sentence for each numbered addition."""
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
    without = [each for each in preview.additions if not len(each.visits)][:PLACELESS]
    return said + [f"Without a mark: {_promise(each)}." for each in without]


def with_places(preview: Preview) -> list[PlanAddition]:
    """Return the best additions whose marks are few enough to be shown: they get numbers."""
    placed = [each for each in preview.additions if 0 < len(each.visits) <= CROWD]
    return placed[:PLACED]


def numbered_places(preview: Preview) -> list[tuple[str, np.ndarray]]:
    """Return the numbers of the additions that go to a place, and the place [mm]."""
    numbers: dict[tuple[float, ...], list[int]] = {}
    for number, addition in enumerate(with_places(preview), 1):
        for target in np.unique(np.round(addition.visits.targets), axis=0):
            numbers.setdefault(tuple(target.tolist()), []).append(number)
    return [(", ".join(map(str, each)), np.array(place)) for place, each in numbers.items()]


def _promise(addition: PlanAddition) -> str:
    return f"{addition.title}, about {addition.minutes:.0f} minutes: {addition.pairs} told apart"


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
