"""Places counted from two edges of the sheet, as a tape measures them [mm]."""

from __future__ import annotations

from plumb.marks.model import Point
from plumb.marks.plausible import Sheet

CORNERS = ("top-left", "top-right", "bottom-left", "bottom-right")


def from_edges(place: Point, *, sheet: Sheet, corner: str) -> Point:
    """A place of the machine frame, counted from the two edges that meet in a corner."""
    right, top = _is_right(corner), _is_top(corner)
    x = sheet[0] / 2 - place[0] if right else sheet[0] / 2 + place[0]
    y = sheet[1] / 2 - place[1] if top else sheet[1] / 2 + place[1]
    return x, y


def in_machine(read: Point, *, sheet: Sheet, corner: str) -> Point:
    """The place in the machine frame that was read from the edges of a corner."""
    x = sheet[0] / 2 - read[0] if _is_right(corner) else read[0] - sheet[0] / 2
    y = sheet[1] / 2 - read[1] if _is_top(corner) else read[1] - sheet[1] / 2
    return x, y


def _is_right(corner: str) -> bool:
    return corner.endswith("right")


def _is_top(corner: str) -> bool:
    return corner.startswith("top")
