"""How much longer than life arrows are drawn, and how far a picture reaches around its sheet."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from plumb.text.files import picture_metadata
from plumb.text.values import in_unit

if TYPE_CHECKING:
    from matplotlib.figure import Figure


Array = np.ndarray
STEPS = (1, 2, 3, 5)  # a factor or scale bar is such a number times a power of ten
BESIDE, ABOVE = 0.05, 0.3  # of the sheet's width and height: as far as arrows may leave the sheet
BELOW = 0.02  # of its height, around a sheet whose arrows stay inside
HEAD = 30.0  # [mm] around the tip of an arrow, for its head
LONG = 0.37  # of the sheet's height: the longest arrow of a few marks
OVERLAP = 1.5  # times the distance between marks: the longest arrow of many


@dataclass(frozen=True)
class View:
    """What a picture shows [mm] from the middle of the sheet."""

    left: float
    right: float
    bottom: float
    top: float

    @property
    def width(self) -> float:
        """[mm]."""
        return self.right - self.left

    @property
    def height(self) -> float:
        """[mm]."""
        return self.top - self.bottom

    def holds(self, places: Array, margin: float | Array = 0.0) -> bool:
        """Return whether places (n, 2) lie inside, so far from the edges [mm]."""
        x, y = places.T
        return bool(
            (x - margin >= self.left).all()
            and (x + margin <= self.right).all()
            and (y - margin >= self.bottom).all()
            and (y + margin <= self.top).all()
        )


def round_down(value: float) -> float:
    """Return the largest 1, 2, 3 or 5 times a power of ten that is no larger than the value."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(step * power for step in STEPS if step * power <= value * (1 + 1e-9)))


def pitch_of(count: int, sheet: tuple[float, float]) -> float:
    """Return the usual distance between marks [mm], if they are spread over the sheet."""
    return float(np.sqrt(sheet[0] * sheet[1] / max(count, 1)))


def exaggeration(panels: Sequence[Spots], sheet: tuple[float, float]) -> float:
    """Return how much longer than life arrows are drawn: as long as fits, and as their neighbours
    allow.

    Arrows may leave the sheet a little. Below life size they are never drawn for that.
    """
    largest = max(*(spots.longest for spots in panels), 1e-6)
    pitch = pitch_of(max(map(len, panels)), sheet)
    factor = round_down(min(LONG * sheet[1], OVERLAP * pitch) / largest)
    widest = around(sheet, ABOVE)
    while factor > 1 and not all(
        widest.holds(spots.tips(factor), factor * spots.spreads + HEAD) for spots in panels
    ):
        factor = round_down(0.99 * factor)
    return factor


def view_of(panels: Sequence[Spots], sheet: tuple[float, float], factor: float) -> View:
    """Return the sheet with all that is drawn on it and around it."""
    low, high = [], []
    for spots in panels:
        room = (factor * spots.spreads + HEAD)[:, None]
        tips = spots.tips(factor)
        low += [spots.places.min(axis=0) - HEAD, (tips - room).min(axis=0)]
        high += [spots.places.max(axis=0) + HEAD, (tips + room).max(axis=0)]
    edge = around(sheet)
    left, bottom = np.minimum(np.min(low, axis=0), (edge.left, edge.bottom))
    right, top = np.maximum(np.max(high, axis=0), (edge.right, edge.top))
    return View(float(left), float(right), float(bottom), float(top))


def around(sheet: tuple[float, float], above: float = BELOW) -> View:
    """Return the sheet with a little around it."""
    width, height = (0.5 + BESIDE) * sheet[0], (0.5 + above) * sheet[1]
    return View(-width, width, -height, height)


@dataclass(frozen=True)
class Scale:
    """What maps of arrows have in common that are compared with each other."""

    sheet: tuple[float, float]  # [mm]
    factor: float  # how much longer than life arrows are
    view: View
    bar: float  # a round length, in the unit in which lengths are shown

    @staticmethod
    def of(marks: Sequence[Spots], sheet: tuple[float, float]) -> Scale:
        """Return the scale at which all marks fit."""
        factor = exaggeration(marks, sheet)
        longest = max(*(spots.longest for spots in marks), 1e-6)
        return Scale(sheet, factor, view_of(marks, sheet, factor), round_down(in_unit(longest)))


# What a sheet shows: marks with their errors, repeats of a mark gathered at their middle.

NEAR = 25.0  # [mm] between marks that repeat each other, whatever their names
SAME_NAME = 60.0  # [mm] between repeats of a name; farther apart it is the mark of another board


@dataclass(frozen=True)
class Panel:
    """A sheet with its errors [mm]."""

    title: str
    predicted: Array  # (n, 2)
    errors: Array  # (n, 2) measured - predicted
    good: bool = False  # drawn in the colour of success
    names: tuple[str, ...] = ()  # (n,) of the marks, if they are known
    doubted: tuple[int, ...] = ()  # marks whose readings are wrong: they get a ring, and no scale


@dataclass(frozen=True)
class Spots:
    """The marks of a panel, each once."""

    names: tuple[str, ...]
    places: Array  # (k, 2) [mm]
    errors: Array  # (k, 2) [mm] mean of the repeats
    spreads: Array  # (k,) [mm] RMS distance of the repeats from their mean, 0 without repeats
    counts: Array  # (k,) how many readings
    doubted: Array  # (k,) bool

    def __len__(self) -> int:
        """Return how many marks."""
        return len(self.names)

    @property
    def longest(self) -> float:
        """Length of the largest mean error [mm]."""
        return float(np.hypot(*self.sure.T).max(initial=0.0))

    @property
    def sure(self) -> Array:
        """The errors, 0 where they are in doubt (k, 2) [mm]: what maps are scaled by."""
        return np.where(self.doubted[:, None], 0.0, self.errors)

    def tips(self, factor: float) -> Array:
        """Return where the arrows end (k, 2) [mm], drawn this many times life size; where they
        begin if they are in doubt, for those may lead anywhere.
        """
        tips: Array = self.places + factor * self.sure
        return tips


def spots_of(panel: Panel) -> Spots:
    """Return the marks of a panel, repeats as their mean."""
    names = panel.names or ("",) * len(panel.predicted)
    groups = _groups(names, panel.predicted)
    errors = np.array([panel.errors[rows].mean(axis=0) for rows in groups])
    spreads = [
        float(np.sqrt(np.mean(np.sum((panel.errors[rows] - mean) ** 2, axis=1))))
        for rows, mean in zip(groups, errors, strict=True)
    ]
    return Spots(
        names=tuple(names[rows[0]] for rows in groups),
        places=np.array([panel.predicted[rows].mean(axis=0) for rows in groups]),
        errors=errors,
        spreads=np.array(spreads),
        counts=np.array([len(rows) for rows in groups]),
        doubted=np.array([any(i in panel.doubted for i in rows) for rows in groups], dtype=bool),
    )


def _groups(names: tuple[str, ...], places: Array) -> list[list[int]]:
    """Return the rows of each mark: those near its first, or with its name and not far."""
    groups: list[list[int]] = []
    firsts = np.zeros((0, 2))
    for i, place in enumerate(places):
        gaps = np.hypot(*(firsts - place).T)
        limits = [SAME_NAME if names[i] and names[i] == names[rows[0]] else NEAR for rows in groups]
        near = np.flatnonzero(gaps <= np.array(limits))
        if len(near):
            groups[near[np.argmin(gaps[near])]].append(i)
        else:
            groups.append([i])
            firsts = np.vstack([firsts, place])
    return groups


# A drawn figure as the bytes of a picture.


def saved(figure: Figure, form: str) -> bytes:
    """Return the figure as png, svg or pdf; the same data give the same bytes."""
    import matplotlib as mpl

    read_as_written(figure)
    file = io.BytesIO()
    # Names inside an SVG are drawn by chance unless they get a salt.
    with mpl.rc_context({"svg.hashsalt": "plumb"}):
        figure.savefig(
            file, format=form, dpi=130, facecolor="white", metadata=picture_metadata(form)
        )
    return file.getvalue()


def pages_saved(pages: list[Figure]) -> bytes:
    """Figures as the pages of a pdf."""
    from matplotlib.backends.backend_pdf import PdfPages

    file = io.BytesIO()
    with PdfPages(file, metadata=picture_metadata("pdf")) as pdf:
        for page in pages:
            read_as_written(page)
            pdf.savefig(page, facecolor="white")
    return file.getvalue()


def read_as_written(figure: Figure) -> None:
    """Let no word be a formula: a name from a file may hold a `$`."""
    from matplotlib.text import Text

    for text in figure.findobj(Text):
        text.set_parse_math(False)
