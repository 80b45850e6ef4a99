"""Pictures of sheets with errors as arrows. Same data give the same bytes."""

from __future__ import annotations

import io
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from plumb.fit.compare import Comparison
from plumb.text.errors import InputError
from plumb.text.files import picture_metadata
from plumb.words.comparison import picture_title

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Array = np.ndarray
Corners = tuple[tuple[float, float], tuple[float, float]]  # lower left and upper right [mm]
FORMATS = ("png", "svg", "pdf")
WOOD, DEEP, EDGE, INK = "#f3e7d3", "#8f6236", "#8a6d3b", "#222222"
BAD, GOOD = "#c64f00", "#0b62a4"  # orange and blue: apart for every eye
WIDTH, SMALL = 8.6, 3.0  # [inch] of a sheet by itself, and of one among others
ROW = 5  # sheets next to each other; more go below them
TITLE, LINE = 0.45, 0.3  # [inch] above a sheet, and of a line of words below all
AROUND = 0.05  # of the sheet's width, left free on each side
HEAD = 30.0  # [mm] around the tip of an arrow, for its head
LONG, OVERLAP = 0.37, 1.5  # the longest arrow: of the sheet's height, of the way between marks
CLOSE = 25.0  # [mm] between marks that repeat each other
MANY = 60  # marks above which a picture has no numbers
LETTER = 0.68 / 72  # [inch] width of a letter, of the size of its type
STEPS = (1, 2, 3, 5)  # a factor is such a number times a power of ten


@dataclass(frozen=True)
class Panel:
    """A sheet, and the errors that are drawn on it [mm]."""

    title: str
    predicted: Array  # (n, 2)
    errors: Array  # (n, 2) measured - predicted
    good: bool = False  # drawn in the colour of success


def picture_form(path: str) -> str:
    """Return the form of a picture by its name's ending."""
    form = Path(path).suffix.lower().lstrip(".")
    if form not in FORMATS:
        raise InputError(f"--picture {path}: end the name with .{', .'.join(FORMATS)}")
    return form


def panel_of(comparison: Comparison) -> Panel:
    """Return the comparison as a panel of a picture."""
    if not comparison.marks:
        raise InputError("--picture: there are distances only, so no errors to draw on a sheet")
    return Panel(
        title=picture_title(comparison),
        predicted=np.array([mark.predicted for mark in comparison.marks]),
        errors=np.array([mark.error for mark in comparison.marks]),
    )


def draw(
    panels: Sequence[Panel], *, sheet: tuple[float, float], heading: str = "", form: str = "png"
) -> bytes:
    """Return the picture as a file, all arrows to a single scale."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.figure import Figure

    columns = columns_for(len(panels))
    wide = WIDTH if columns == 1 else SMALL
    factor = factor_for(panels, sheet)
    view = view_of(panels, sheet, factor)
    high = wide * (view[1][1] - view[0][1]) / (view[1][0] - view[0][0])
    head, foot, row = TITLE * bool(heading), LINE + 0.1, TITLE + high
    tall = head + row * -(-len(panels) // columns) + foot
    figure = Figure(figsize=(wide * columns, tall))
    _write(figure, heading, 0.0, tall - head / 2, wide * columns, size=17)
    for i, panel in enumerate(panels):
        low, left = tall - head - row * (i // columns + 1), wide * (i % columns)
        colour = GOOD if panel.good else BAD
        size = 15 if wide == WIDTH else 11
        _write(figure, panel.title, left, low + high + TITLE / 2, wide, size=size, color=colour)
        share = (left / figure.get_figwidth(), low / tall, 1 / columns, high / tall)
        axis = figure.add_axes(share)
        axis.set(xlim=(view[0][0], view[1][0]), ylim=(view[0][1], view[1][1]))
        axis.set_axis_off()
        _draw_panel(axis, panel, sheet, factor=factor, small=wide / WIDTH)
    legend = _scale_words(panels, factor)
    _write(figure, legend, 0.0, foot / 2, wide * columns, size=12, weight="normal")
    return saved(figure, form)


def columns_for(count: int) -> int:
    """Return how many sheets stand next to each other, so that rows are about as long."""
    return -(-count // -(-count // ROW))


def factor_for(panels: Sequence[Panel], sheet: tuple[float, float]) -> float:
    """Return how much longer than life arrows are: as long as fits, and as neighbours allow."""
    most = max(len(panel.errors) for panel in panels)
    pitch = np.sqrt(sheet[0] * sheet[1] / max(most, 1))
    return round_down(min(LONG * sheet[1], OVERLAP * pitch) / _longest(panels))


def view_of(panels: Sequence[Panel], sheet: tuple[float, float], factor: float) -> Corners:
    """Return the sheet with all arrows on it and around it."""
    ends = [panel.predicted + factor * panel.errors for panel in panels]
    half = np.array([(0.5 + AROUND) * sheet[0], 0.5 * sheet[1] + AROUND * sheet[0]])
    places = np.vstack([-half, half, *(end - HEAD for end in ends), *(end + HEAD for end in ends)])
    (left, low), (right, top) = places.min(axis=0), places.max(axis=0)
    return (float(left), float(low)), (float(right), float(top))


def round_down(value: float) -> float:
    """Return the largest 1, 2, 3 or 5 times a power of ten that is no larger than the value."""
    power = 10.0 ** np.floor(np.log10(value))
    return float(max(step * power for step in STEPS if step * power <= value * (1 + 1e-9)))


def _longest(panels: Sequence[Panel]) -> float:
    lengths = np.hypot(*np.vstack([panel.errors for panel in panels]).T)
    return max(float(lengths.max(initial=0.0)), 1e-6)


def _scale_words(panels: Sequence[Panel], factor: float) -> str:
    return (
        "Circle: where a mark should be; arrow: to where it was measured, "
        f"{factor:g} times life size. The longest is {_longest(panels):.2f} mm."
    )


def _draw_panel(
    axis: Axes, panel: Panel, sheet: tuple[float, float], *, factor: float, small: float
) -> None:
    from matplotlib.patches import Rectangle

    axis.add_patch(
        Rectangle((-sheet[0] / 2, -sheet[1] / 2), *sheet, fc=WOOD, ec=EDGE, lw=2 * small)
    )
    _draw_arrows(axis, panel, factor=factor, small=small)
    if small == 1.0:
        _draw_lengths(axis, panel)


def _draw_arrows(axis: Axes, panel: Panel, *, factor: float, small: float) -> None:
    part = small * float(np.clip(9 / np.sqrt(len(panel.errors)), 0.3, 1.0))
    axis.plot(*panel.predicted.T, "o", color="white", mec=INK, ms=6 * part, mew=part, zorder=3)
    axis.quiver(
        *panel.predicted.T,
        *(factor * panel.errors).T,
        angles="xy",
        scale_units="xy",
        scale=1,
        units="inches",
        width=0.035 * part,
        headwidth=4.5,
        headlength=5.5,
        headaxislength=5,
        minlength=0.5,
        color=GOOD if panel.good else BAD,
        zorder=4,
    )


def _draw_lengths(axis: Axes, panel: Panel) -> None:
    """Write the length of each error behind its mark; of marks that lie close together, that of the
    first.
    """
    lengths = np.hypot(*panel.errors.T)
    if len(lengths) > MANY:
        return
    written: list[Array] = []
    for place, error, length in zip(panel.predicted, panel.errors, lengths, strict=True):
        if any(np.hypot(*(place - other)) < CLOSE for other in written):
            continue
        written.append(place)
        x, y = -error / length if length > 0 else (0.0, -1.0)
        axis.annotate(
            f"{length:.1f}",
            place,
            (14 * x, 14 * y),
            textcoords="offset points",
            fontsize=11,
            color=INK,
            ha="left" if x > 0.5 else "right" if x < -0.5 else "center",
            va="center",
            zorder=6,
        )


def _write(
    figure: Figure,
    said: str,
    left: float,
    y: float,
    wide: float,
    *,
    size: float,
    color: str = INK,
    weight: str = "bold",
) -> None:
    """Write lines into a width [inch] from this place, as large as they fit."""
    width, tall = figure.get_size_inches()
    margin = AROUND * wide / (1 + 2 * AROUND)
    longest = max(map(len, said.split("\n")))
    size = min(size, (wide - 2 * margin) / (LETTER * max(longest, 1)))
    at = ((left + margin) / width, y / tall)
    figure.text(*at, said, fontsize=size, fontweight=weight, color=color, va="center")


def saved(figure: Figure, form: str) -> bytes:
    """Return the figure as png, svg or pdf; the same data give the same bytes."""
    import matplotlib as mpl
    from matplotlib.text import Text

    # Let no word be a formula: a name from a file may hold a `$`.
    for text in figure.findobj(Text):
        text.set_parse_math(False)
    file = io.BytesIO()
    # Names inside an SVG are drawn by chance unless they get a salt.
    with mpl.rc_context({"svg.hashsalt": "plumb"}):
        figure.savefig(
            file, format=form, dpi=130, facecolor="white", metadata=picture_metadata(form)
        )
    return file.getvalue()
