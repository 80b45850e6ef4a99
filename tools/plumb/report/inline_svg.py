"""A drawn figure as SVG inside a page: no address of anything outside, no name twice."""

from __future__ import annotations

import io
import re
from collections.abc import Iterator
from contextlib import contextmanager
from html import escape
from typing import TYPE_CHECKING, Any

from plumb.pictures.saved import read_as_written
from plumb.report.palette import named

if TYPE_CHECKING:
    from matplotlib.figure import Figure

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
    """The figure as an element of a page; `says` is read to who cannot see it."""
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
    """A tag as the page needs it: its fonts are the page's, its colours have names."""
    tag = _GROUP.sub("<g", tag).replace("xlink:href", "href")
    tag = _FONT.sub(lambda font: f"font-size: {font[3]};" if font[3] else "", tag)
    return _DECIMALS.sub(r"\1", named(tag))
