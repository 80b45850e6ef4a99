"""The report's maps of the sheet: arrows, chains, fingerprints, reach and the error to expect."""

from __future__ import annotations

import io
import re
from html import escape
from typing import TYPE_CHECKING

import numpy as np

from plumb.diagnosis.expected_error import ExpectedError
from plumb.fit.compare import ChainView
from plumb.model.reach import Survey
from plumb.pictures.plan import draw_visits
from plumb.pictures.reach import draw_give, draw_pulls, draw_zones
from plumb.pictures.scale import (
    Panel,
    Scale,
    around,
    pitch_of,
    read_as_written,
    round_down,
    spots_of,
)
from plumb.pictures.sheet import (
    BAD,
    EDGE,
    GOOD,
    INK,
    MANY,
    WOOD,
    Look,
    arrow_figure,
    draw_wood,
    sheet_figure,
)
from plumb.plan.planned_visits import Visits
from plumb.text.values import in_unit, signed, unit

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure


Array = np.ndarray
WIDE = 4.4  # [inch] of a map
TYPE = 8.5  # [point]
LARGE = Look(wide=WIDE, small=0.8, type=TYPE)
STAIR = Look(wide=2.5, small=0.5, has_lengths=False, scale="")
FINGERPRINT = Look(wide=2.5, small=0.5, type=TYPE, has_lengths=False, scale="{bar} (x{factor:g})")
NAMED, LETTERS = 30, 4  # marks up to which each has its name at the arrow, and of a name
LARGEST, CLOSE = 0.09, 0.4  # radius of a chain map's largest circle: of the sheet, and of a pitch
LEVELS = 7  # of the error to expect


def arrow_map(
    panel: Panel, scale: Scale, look: Look, *, name: str, says: str, sigma: float | None = None
) -> str:
    """Return a sheet with arrows; with a sigma [mm], each has the ring in which 95 % of readings
    without error would lie.
    """
    few = len(set(panel.names)) <= NAMED and max(map(len, panel.names), default=0) <= LETTERS
    return inline(arrow_figure(panel, scale, look, names=few, sigma=sigma), says=says, name=name)


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
    figure, axis = sheet_figure(around(sheet), WIDE)
    draw_wood(axis, sheet, 1.5)
    widest = min(LARGEST * sheet[1], CLOSE * pitch_of(len(spots), sheet))
    radii = widest * np.sqrt(np.abs(sizes) / max(largest, 1e-9))
    for place, size, radius in zip(places, sizes, radii, strict=True):
        _draw_circle(axis, place, radius, longer=size > 0)
        if len(sizes) <= MANY:
            at = (place[0], place[1] - radius - 12)
            axis.text(*at, signed(size, 1), ha="center", va="top", fontsize=TYPE, color=INK)
    return inline(figure, says=says, name=name)


def _draw_circle(axis: Axes, place: Array, radius: float, *, longer: bool) -> None:
    """Draw a circle: filled where the chain is longer than the model says, hollow where it is
    shorter.
    """
    from matplotlib.patches import Circle

    colour = BAD if longer else GOOD
    fill = colour if longer else "none"
    axis.add_patch(Circle((place[0], place[1]), radius, fc=fill, ec=colour, lw=1.3, zorder=3))


def expected_map(expected: ExpectedError, *, sheet: tuple[float, float], name: str) -> str:
    """Return the error to expect, in steps of a round number, darker where it is larger."""
    foot = 0.6
    shown = np.ma.masked_invalid(in_unit(1.0) * expected.sigma)
    figure, axis = sheet_figure(around(sheet), WIDE, foot=foot)
    draw_wood(axis, sheet, 1.5)
    most = max(float(shown.max()), 1e-6)
    step = round_down(most / (LEVELS - 2)) or most
    levels = np.arange(0.0, most + step, step)
    filled = axis.contourf(expected.x, expected.y, shown, levels=levels, cmap="viridis_r", zorder=2)
    tall = figure.get_size_inches()[1]
    bar = figure.add_axes((0.12, 0.33 / tall, 0.76, 0.13 / tall))
    scale = figure.colorbar(filled, cax=bar, orientation="horizontal")
    scale.outline.set_visible(False)
    bar.tick_params(labelsize=TYPE, colors=INK, length=2)
    bar.set_xlabel(f"one sigma of the place, {unit()}", fontsize=TYPE, color=INK)
    return inline(figure, says="map of the error to expect", name=name)


def reach_maps(survey: Survey, *, name: str) -> tuple[str, str]:
    """Return how far the bit gives, and how hard the chains pull."""
    drawn = []
    for part, draw, says in (
        ("give", draw_give, "map of the give in mm per N"),
        ("pulls", draw_pulls, "map of the tensions in N"),
    ):
        figure, axis = sheet_figure(around(survey.sheet), WIDE)
        draw_zones(axis, survey)
        draw(axis, survey)
        drawn.append(inline(figure, says=says, name=f"{name} {part}"))
    return drawn[0], drawn[1]


def plan_map(
    visits: Visits, old: Array, *, usual_weight: float, sheet: tuple[float, float], name: str
) -> str:
    """Return where visits are proposed, numbered, among the marks (n, 2) [mm] there are."""
    figure, axis = sheet_figure(around(sheet), WIDE)
    draw_visits(axis, visits, old, usual_weight=usual_weight, sheet=sheet, small=0.7)
    return inline(figure, says=f"{len(visits)} places to measure", name=name)


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


def inline(figure: Figure, *, says: str, name: str) -> str:
    """Return the figure as an element of a page; `says` is read to who cannot see it, `name` tells
    its parts from those of other figures.
    """
    import matplotlib as mpl

    read_as_written(figure)
    file = io.StringIO()
    # Letters stay letters.
    with mpl.rc_context({"svg.hashsalt": f"plumb {name}", "svg.fonttype": "none"}):
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
