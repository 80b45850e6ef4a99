"""The report's maps of the sheet: arrows, chains, fingerprints, reach and the error to expect."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from html import escape
from typing import TYPE_CHECKING, Any

import numpy as np

from plumb.diagnosis.expected_error import ExpectedError
from plumb.fit.compare import ChainView
from plumb.model.reach import Survey
from plumb.pictures.reach import draw_give, draw_pulls, draw_zones
from plumb.pictures.scale import (
    Panel,
    Spots,
    View,
    exaggeration,
    pitch_of,
    read_as_written,
    round_down,
    spots_of,
    view_of,
)
from plumb.pictures.sheet import BAD, EDGE, GOOD, INK, MANY, WOOD, draw_errors, label_boxes
from plumb.text.values import UNITS, bare, in_unit, unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


Array = np.ndarray
WIDE, SMALL = 4.4, 2.5  # [inch] of a large map, and of a small map
FOOT = 0.34  # [inch] below a map, for its scale
TYPE = 8.5  # [point]
NAMED = 30  # marks up to which each has its name at the arrow
INSIDE = 2.448  # sigmas: 95 % of all readings lie within, in two coordinates
LARGEST, CLOSE = 0.09, 0.4  # radius of a chain map's largest circle: of the sheet, and of a pitch
LEVELS = 7  # of the error to expect


@dataclass(frozen=True)
class Scale:
    """What all arrow maps of a report have in common."""

    sheet: tuple[float, float]  # [mm]
    factor: float  # how much longer than life arrows are
    view: View
    longest: float  # [mm]

    @staticmethod
    def of(panels: Sequence[Panel], sheet: tuple[float, float]) -> Scale:
        """Return the scale at which all panels fit."""
        marks = [spots_of(panel) for panel in panels]
        factor = exaggeration(marks, sheet)
        longest = max(spots.longest for spots in marks)
        return Scale(sheet, factor, view_of(marks, sheet, factor), longest)


def arrow_map(panel: Panel, scale: Scale, *, sigma: float, name: str, says: str) -> str:
    """Return a sheet with arrows, each with the ring in which 95 % of readings without error would
    lie.
    """
    spots = spots_of(panel)
    rings = INSIDE * sigma / np.sqrt(spots.counts)
    with drawing(name):
        figure, axis = _sheet(scale.view, wide=WIDE)
        draw_errors(
            axis,
            spots,
            scale.view,
            sheet=scale.sheet,
            factor=scale.factor,
            good=panel.good,
            small=0.8,
            rings=rings,
        )
        _write_lengths(axis, spots, scale)
        _draw_scale(figure, scale)
    return inline(figure, says=says, name=name)


def small_map(panel: Panel, scale: Scale, *, name: str, says: str) -> str:
    """Return the same without words, for a place among others."""
    with drawing(name):
        figure, axis = _sheet(scale.view, wide=SMALL, foot=0.0)
        draw_errors(
            axis,
            spots_of(panel),
            scale.view,
            sheet=scale.sheet,
            factor=scale.factor,
            good=panel.good,
            small=0.5,
        )
    return inline(figure, says=says, name=name)


def chain_map(
    view: ChainView, side: int, *, sheet: tuple[float, float], largest: float, name: str, says: str
) -> str:
    """Return how much longer or shorter a chain is at each mark than the model says: circles whose
    area is the size; repeats count as their mean.
    """
    known = np.flatnonzero(np.isfinite(view.chains).all(axis=1))
    names = tuple(view.names[i] for i in known)
    spots = spots_of(Panel("", view.places[known], view.chains[known], names=names))
    places, sizes = spots.places, spots.errors[:, side]
    with drawing(name):
        figure, axis = _sheet(_whole(sheet), wide=WIDE, foot=0.0)
        _draw_wood(axis, sheet)
        widest = min(LARGEST * sheet[1], CLOSE * pitch_of(len(spots), sheet))
        radii = widest * np.sqrt(np.abs(sizes) / max(largest, 1e-9))
        for place, size, radius in zip(places, sizes, radii, strict=True):
            _draw_circle(axis, place, radius, longer=size > 0)
            if len(sizes) <= MANY:
                digits = 1 if unit() == "mm" else 2
                said = f"{in_unit(size):+z.{digits}f}"
                at = (place[0], place[1] - radius - 12)
                axis.text(*at, said, ha="center", va="top", fontsize=TYPE, color=light("ink"))
    return inline(figure, says=says, name=name)


def fingerprint_map(places: Array, errors: Array, *, sheet: tuple[float, float], name: str) -> str:
    """Return what an effect does to places all over the sheet, each at the scale that fits."""
    panel = Panel("", places, errors)
    scale = Scale.of([panel], sheet)
    with drawing(name):
        figure, axis = _sheet(scale.view, wide=SMALL)
        spots = spots_of(panel)
        draw_errors(
            axis, spots, scale.view, sheet=sheet, factor=scale.factor, good=False, small=0.5
        )
        _draw_scale(figure, scale, brief=True)
    return inline(figure, says="arrows over the sheet", name=name)


def expected_map(expected: ExpectedError, *, sheet: tuple[float, float], name: str) -> str:
    """Return the error to expect, in steps of a round number, darker where it is larger."""
    whole, height = _whole(sheet), FOOT + 0.25
    shown = np.ma.masked_invalid(in_unit(1.0) * expected.sigma)
    with drawing(name):
        figure, axis = _sheet(whole, wide=WIDE, foot=height)
        _draw_wood(axis, sheet)
        most = max(float(shown.max()), 1e-6)
        step = round_down(most / (LEVELS - 2)) or most
        levels = np.arange(0.0, most + step, step)
        filled = axis.contourf(
            expected.x, expected.y, shown, levels=levels, cmap="viridis_r", zorder=2
        )
        inch = WIDE / whole.width
        tall = inch * whole.height + height
        bar = figure.add_axes((0.12, 0.33 / tall, 0.76, 0.13 / tall))
        scale = figure.colorbar(filled, cax=bar, orientation="horizontal")
        scale.outline.set_visible(False)
        bar.tick_params(labelsize=TYPE, colors=light("ink"), length=2)
        bar.set_xlabel(f"one sigma of the place, {unit()}", fontsize=TYPE, color=light("ink"))
    return inline(figure, says="map of the error to expect", name=name)


def reach_maps(survey: Survey, *, name: str) -> tuple[str, str]:
    """Return how far the bit gives, and how hard the chains pull."""
    drawn = []
    for part, draw in (("give", draw_give), ("pulls", draw_pulls)):
        with drawing(f"{name} {part}"):
            figure, axis = _sheet(_whole(survey.sheet), wide=WIDE, foot=0.0)
            draw_zones(axis, survey)
            draw(axis, survey)
        says = {"give": "map of the give in mm per N", "pulls": "map of the tensions in N"}[part]
        drawn.append(inline(figure, says=says, name=f"{name} {part}"))
    return drawn[0], drawn[1]


def _sheet(view: View, *, wide: float, foot: float = FOOT) -> tuple[Figure, Axes]:
    """Return a figure with an axis in mm of the sheet, and a strip below."""
    from matplotlib.figure import Figure

    high = wide * view.height / view.width
    figure = Figure(figsize=(wide, high + foot))
    axis = figure.add_axes((0, foot / (high + foot), 1, high / (high + foot)))
    axis.set_xlim(view.left, view.right)
    axis.set_ylim(view.bottom, view.top)
    axis.set_axis_off()
    return figure, axis


def _whole(sheet: tuple[float, float]) -> View:
    """Return the sheet with a little around it."""
    across, up = 0.52 * sheet[0], 0.54 * sheet[1]
    return View(-across, across, -up, up)


def _draw_wood(axis: Axes, sheet: tuple[float, float]) -> None:
    from matplotlib.patches import Rectangle

    corner = (-sheet[0] / 2, -sheet[1] / 2)
    wood = Rectangle(corner, *sheet, fc=light("wood"), ec=light("edge"), lw=1.5)
    axis.add_patch(wood)


def _draw_circle(axis: Axes, place: Array, radius: float, *, longer: bool) -> None:
    """Draw a circle: filled where the chain is longer than the model says, hollow where it is
    shorter.
    """
    from matplotlib.patches import Circle

    colour = light("bad") if longer else light("good")
    fill = colour if longer else "none"
    axis.add_patch(Circle((place[0], place[1]), radius, fc=fill, ec=colour, lw=1.3, zorder=3))


def _write_lengths(axis: Axes, spots: Spots, scale: Scale) -> None:
    """Write the length of each error next to its mark, after its name where there is room."""
    if len(spots) > MANY:
        return
    lengths = [bare(float(length), 1) for length in np.hypot(*spots.errors.T)]
    few = len(spots) <= NAMED and max(map(len, spots.names)) <= 4
    words = [
        f"{name}: {length}" if few and name else length
        for name, length in zip(spots.names, lengths, strict=True)
    ]
    mm = scale.view.width / WIDE / 72  # of a point
    boxes = label_boxes(
        spots, words, factor=scale.factor, view=scale.view, size=TYPE * mm, gap=5 * mm
    )
    for (left, low, right, high), word in zip(boxes, words, strict=True):
        at = ((left + right) / 2, (low + high) / 2)
        axis.text(
            *at,
            word,
            ha="center",
            va="center_baseline",
            fontsize=TYPE,
            color=light("ink"),
            zorder=6,
        )


def _draw_scale(figure: Figure, scale: Scale, *, brief: bool = False) -> None:
    """Draw a bar of a round length below the sheet, and say how much longer than life it is."""
    wide, tall = figure.get_size_inches()
    axis = figure.add_axes((0, 0, 1, FOOT / tall))
    axis.set_xlim(0, wide)
    axis.set_ylim(0, FOOT)
    axis.set_axis_off()
    length = round_down(in_unit(max(scale.longest, 1e-6)))
    inch = wide / scale.view.width  # of paper for a mm of the sheet
    left = (-scale.sheet[0] / 2 - scale.view.left) * inch
    right = left + length * UNITS[unit()] * scale.factor * inch
    axis.plot([left, right], [FOOT / 2] * 2, color=light("ink"), lw=3, solid_capstyle="butt")
    said = f"{length:g} {unit()}"
    said += (
        f" (x{scale.factor:g})" if brief else f" of error: arrows {scale.factor:g} times life size"
    )
    axis.text(right + 0.08, FOOT / 2, said, va="center", fontsize=TYPE, color=light("ink"))


def plan_map(new: Array, old: Array, *, sheet: tuple[float, float], name: str) -> str:
    """Return where marks are proposed (n, 2) [mm], among the marks there are."""
    with drawing(name):
        figure, axis = _sheet(_whole(sheet), wide=WIDE, foot=0.0)
        _draw_wood(axis, sheet)
        soft, colour = light("soft"), light("good")
        axis.plot(*old.T, "o", color="none", markeredgecolor=soft, markersize=5, zorder=3)
        axis.plot(*new.T, "D", color=colour, markersize=7, zorder=4)
    return inline(figure, says=f"{len(new)} places to measure", name=name)


# A drawn figure as SVG inside a page: no address of anything outside, no name twice.

GROWS = 1.25 * 4 / 3  # [pixel per point] as far as a picture grows with its place
_HEAD = re.compile(r"\A.*?<svg[^>]*?viewBox=\"([^\"]*)\"[^>]*>", re.DOTALL)
_METADATA = re.compile(r"<metadata>.*?</metadata>", re.DOTALL)
_STYLE = re.compile(r"<style[^>]*>.*?</style>", re.DOTALL)
_TAG = re.compile(r"<[^>]*>")
_GROUP = re.compile(r"\A<g id=\"[^\"]*\"")
_FONT = re.compile(r"font-family: [^;\"]*(; )?|font: (\d+ )?([\d.]+px) [^;\"]*(;|(?=\"))")
# More decimals than a printer shows: two below ten points, and one above.
_DECIMALS = re.compile(r"(?<![\d.])(\d\.\d{2}|\d{2,}\.\d)\d+")


@contextmanager
def drawing(name: str) -> Iterator[Any]:
    """While figures are made: letters stay letters, and `name` tells their parts from those of
    other figures."""
    import matplotlib as mpl

    with mpl.rc_context({"svg.hashsalt": f"plumb {name}", "svg.fonttype": "none"}):
        yield


def inline(figure: Figure, *, says: str, name: str) -> str:
    """Return the figure as an element of a page; `says` is read to who cannot see it."""
    from matplotlib.backends.backend_svg import FigureCanvasSVG

    FigureCanvasSVG(figure)
    read_as_written(figure)
    file = io.StringIO()
    with drawing(name):
        figure.savefig(file, format="svg", transparent=True, metadata={"Date": None})
    drawn = file.getvalue()
    head = _HEAD.match(drawn)
    assert head, "matplotlib writes a viewBox"
    body = drawn[head.end() :]
    for pattern in (_METADATA, _STYLE):
        body = pattern.sub("", body)
    body = _TAG.sub(lambda tag: _plain(tag[0]), body)
    width = float(head[1].split()[2])
    return (
        f'<svg viewBox="{head[1]}" role="img" aria-label="{escape(says)}" '
        f'style="max-width:{GROWS * width:.0f}px">{body.strip()}'
    )


def _plain(tag: str) -> str:
    """Return a tag as the page needs it: its fonts are the page's, its colours have names."""
    tag = _GROUP.sub("<g", tag).replace("xlink:href", "href")
    tag = _FONT.sub(lambda font: f"font-size: {font[3]};" if font[3] else "", tag)
    return _DECIMALS.sub(r"\1", named(tag))


# The colours of the report, on light and on dark paper; apart for every eye.
#
# Pictures are drawn in the light colours; the page knows each by its name, so that the same picture
# goes with both kinds of paper.

# By name: on light paper, on dark paper.
COLOURS: dict[str, tuple[str, str]] = {
    "paper": ("#ffffff", "#15171a"),
    "panel": ("#f7f5f1", "#1f2226"),
    "ink": (INK, "#ebe9e4"),
    "soft": ("#57534c", "#b9b5ac"),
    "rule": ("#d6d2c8", "#43474d"),
    "band": ("#e6e3db", "#33373d"),
    "wood": (WOOD, "#2d2721"),
    "edge": (EDGE, "#b08f5b"),
    "bad": (BAD, "#ff9f61"),
    "good": (GOOD, "#79bcf3"),
    "alarm": ("#a83f00", "#ffa66b"),  # words
    # Explanations: green, purple and brown, each with its stroke.
    "first": ("#00795a", "#4fd0a8"),
    "second": ("#96387a", "#f0a0d4"),
    "third": ("#7a5c00", "#e0c25c"),
    # The zones of the reach.
    "tight": ("#8e2c22", "#f08a7e"),
    "slack": ("#1f5f8b", "#74bdea"),
    "upright": ("#6b3fa0", "#bd9cf0"),
    "nothing": ("#444444", "#9a9a9a"),
}
SUSPECTS = ("first", "second", "third")
DASHES = ("solid", (0, (3.5, 3)), (0, (1, 2)))  # of their curves, for who sees no colours


def light(name: str) -> str:
    """Return the colour in which a picture is drawn."""
    return COLOURS[name][0]


def named(svg: str) -> str:
    """Return the text of a picture with the names of its colours, which the page gives their
    values.
    """
    for name, (colour, _) in COLOURS.items():
        svg = svg.replace(f": {colour}", f": var(--{name})")
    return svg


def style() -> str:
    """Return the names and values for the page's style: light, then dark on screens that ask for
    it.
    """
    bright, dark = (
        "".join(f"--{name}:{both[i]};" for name, both in COLOURS.items()) for i in (0, 1)
    )
    return (
        f":root{{color-scheme:light dark;{bright}}}\n"
        f"@media screen and (prefers-color-scheme:dark){{:root{{{dark}}}}}"
    )
