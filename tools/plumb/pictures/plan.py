"""A picture of a proposal: the measured and the proposed marks on the sheet."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from plumb.pictures.scale import around, saved
from plumb.pictures.sheet import (
    BAD,
    GOOD,
    INK,
    MARGIN,
    PLAIN,
    WIDTH,
    draw_wood,
    fitting,
    sheet_figure,
    strip,
    write_title,
)
from plumb.plan.planned_visits import Visits
from plumb.settings.machine import GRAVITY

if TYPE_CHECKING:
    from matplotlib.axes import Axes


TITLE, LINE, FOOT = 0.5, 0.3, 0.2  # [inch] above the sheet, a line of the legend, below it
SENTENCE, MOST = 0.22, 40  # [inch] of a sentence, and how many there is room for
LINES = 8  # sentences below each other, before there are two columns
NEW, HEAVY, SWAPPED = GOOD, BAD, INK
EDGE = WIDTH * MARGIN / (1 + 2 * MARGIN)  # [inch] left of the sheet
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
    legend = _legend(visits, old, usual_weight)
    said = place_sentences(visits, usual_weight=usual_weight, sheet=sheet)
    rows = rows_for(len(said))
    foot = FOOT + LINE * len(legend) + SENTENCE * rows
    figure, axis = sheet_figure(around(sheet), WIDTH, head=TITLE, foot=foot)
    draw_visits(axis, visits, old, usual_weight=usual_weight, sheet=sheet)
    write_title(figure, title, left=EDGE, head=TITLE, size=15)
    below = strip(figure, foot)
    _draw_legend(below, legend, foot)
    _draw_sentences(below, said, SENTENCE * rows + FOOT / 2)
    return saved(figure, form)


def draw_visits(
    axis: Axes,
    visits: Visits,
    old: np.ndarray,
    *,
    usual_weight: float,
    sheet: tuple[float, float],
    small: float = 1.0,
) -> None:
    """Draw old marks (n, 2) [mm] and planned visits, numbered in their order; small: signs and
    numbers, of their size in a picture by itself.
    """
    draw_wood(axis, sheet, 2 * small)
    _draw_old(axis, old, small)
    for numbers, i in _by_place(visits):
        _draw_visit(axis, visits, i, numbers, usual_weight, sheet[1], small)


def _draw_old(axis: Axes, old: np.ndarray, small: float = 1.0) -> None:
    if len(old):
        axis.plot(*old.T, "o", color="white", markeredgecolor=INK, markersize=7 * small, zorder=3)


def _by_place(visits: Visits) -> list[tuple[list[int], int]]:
    """Visits that repeat each other: their numbers, and the row of the first."""
    groups: dict[tuple[float, ...], list[int]] = {}
    for i in range(len(visits)):
        alike = (*visits.targets[i], visits.sled_weights[i], float(visits.swapped[i]))
        groups.setdefault(alike, []).append(i)
    return [([i + 1 for i in rows], rows[0]) for rows in groups.values()]


def _draw_visit(
    axis: Axes,
    visits: Visits,
    i: int,
    numbers: list[int],
    usual_weight: float,
    height: float,
    small: float,
) -> None:
    at, (colour, symbol) = visits.targets[i], _look(visits, i, usual_weight)
    axis.plot(*at, symbol, color=colour, markersize=12 * small, markeredgecolor="white", zorder=5)
    for number in numbers:
        side = visits.approaches[number - 1]
        if side.any():
            axis.annotate(
                "",
                xy=at - 22 * side,
                xytext=at - SHAFT * side,
                arrowprops={"arrowstyle": "-|>", "color": colour, "lw": 1.6 * small},
                zorder=4,
            )
    down = -1 if at[1] > 0 else 1
    axis.text(
        at[0] + 0.022 * height * (1 if at[0] < 0 else -1),
        at[1] + 0.045 * height * down,
        str(numbers[0]),
        ha="left" if at[0] < 0 else "right",
        va="center",
        fontsize=12 * small,
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
    wide = (WIDTH - 2 * EDGE) / (1 if len(said) <= LINES else 2)
    size = min((fitting(each, wide - 0.15, 11, letter=PLAIN) for each in said), default=11)
    for i, sentence in enumerate(said):
        x, y = EDGE + wide * (i // rows), top - SENTENCE * (i % rows + 0.5)
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
    for i, (symbol, colour, words) in enumerate(lines):
        y = foot - 0.2 - LINE * i
        if symbol:
            edge = INK if colour == "white" else "white"
            axis.plot(EDGE + 0.1, y, symbol, color=colour, markeredgecolor=edge, markersize=10)
        axis.text(EDGE + 0.3, y, words, va="center", fontsize=12, color=INK)
