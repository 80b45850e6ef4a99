"""Small pictures of fields over the sheet as SVG text: the same numbers give the same bytes."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from html import escape

import numpy as np
from plumb.pictures.drawing import EDGE, INK, WOOD, round_down

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
        lines.append(text(BESIDE, tall * i + 20, label, size=15, bold=True))
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
        text(left, top - ABOVE + 40, picture.heading, size=12.5),
        f'<rect x="{_n(left)}" y="{_n(top)}" width="{_n(width)}" height="{_n(height)}" '
        f'fill="{WOOD}" stroke="{EDGE}" stroke-width="1.5"/>',
    ]
    starts = _on_paper(picture.sent, middle)
    if picture.errors is None:
        said = text(middle[0], top + height + 22, picture.note, size=12.5, anchor="middle")
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
    return [line, text(right + 8, height + 4, said, size=12.5)]


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


def text(
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
