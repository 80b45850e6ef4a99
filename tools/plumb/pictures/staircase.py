"""How the error falls: small sheets next to each other, and below each a bar as high as its RMS."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from textwrap import wrap
from typing import TYPE_CHECKING

from plumb.pictures.panel import Panel, Spots, spots_of
from plumb.pictures.saved import saved
from plumb.pictures.scale import View, exaggeration, round_down, view_of
from plumb.pictures.sheet import BAD, GOOD, INK, PLAIN, draw_errors, fitting

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

Box = tuple[float, float, float, float]
WIDE = 3.0  # [inch] of a small sheet with what is around it
HEADING, TITLE, BARS, FOOT, LEFT = 0.55, 0.5, 1.5, 0.5, 0.15  # [inch] from top to bottom, and left
ROW = 5  # sheets next to each other; more go below them
TALLEST, BROAD = 1.15, 0.8  # [inch] height of the highest bar, width of each
LETTERS = 22  # of a line above a sheet
SMALL = 0.5  # of the signs of a picture of a single sheet


@dataclass(frozen=True)
class Stair:
    """A sheet and the error left on it."""

    panel: Panel
    rms: float  # [mm]


def draw_staircase(
    stairs: Sequence[Stair], *, heading: str, sheet: tuple[float, float], form: str = "png"
) -> bytes:
    """The picture of a fall, all arrows and bars to the same scale."""
    # Loading matplotlib takes longer than most commands: only a drawing waits for it.
    from matplotlib.backends.backend_agg import FigureCanvasAgg
    from matplotlib.figure import Figure

    plan = _layout(stairs, sheet)
    figure = Figure(figsize=(plan.wide, plan.tall))
    FigureCanvasAgg(figure)
    size = fitting(heading, plan.wide - 2 * LEFT, 17)
    left, y = LEFT / plan.wide, 1 - HEADING / 2 / plan.tall
    figure.text(left, y, heading, fontsize=size, fontweight="bold", color=INK, va="center")
    for i, stair in enumerate(stairs):
        _draw_stair(figure, plan, i, stair)
    _draw_foot(figure.add_axes((0, 0, 1, FOOT / plan.tall)), plan)
    return saved(figure, form)


def columns_for(count: int) -> int:
    """How many sheets stand next to each other, so that rows are about as long."""
    rows = -(-count // ROW)
    return -(-count // rows)


@dataclass(frozen=True)
class _Layout:
    """Where the stairs of a picture go."""

    marks: list[Spots]
    sheet: tuple[float, float]  # [mm]
    factor: float
    view: View
    columns: int
    highest: float  # [mm] RMS

    @property
    def inch(self) -> float:
        """Per mm of the sheet."""
        return (WIDE - 2 * LEFT) / self.view.width

    @property
    def step(self) -> float:
        """[inch] of a row."""
        return TITLE + self.inch * self.view.height + BARS

    @property
    def wide(self) -> float:
        """[inch]."""
        return self.columns * WIDE

    @property
    def tall(self) -> float:
        """[inch]."""
        rows = -(-len(self.marks) // self.columns)
        return HEADING + rows * self.step + FOOT

    def box(self, i: int, low: float, height: float, edge: float) -> Box:
        """A part of a stair as shares of the picture: left, bottom, width, height."""
        left = WIDE * (i % self.columns) + edge
        bottom = self.tall - HEADING - self.step * (i // self.columns + 1) + low
        return (
            left / self.wide,
            bottom / self.tall,
            (WIDE - 2 * edge) / self.wide,
            height / self.tall,
        )


def _layout(stairs: Sequence[Stair], sheet: tuple[float, float]) -> _Layout:
    marks = [spots_of(stair.panel) for stair in stairs]
    factor = exaggeration(marks, sheet)
    view = view_of(marks, sheet, factor)
    highest = max(*(stair.rms for stair in stairs), 1e-6)
    return _Layout(marks, sheet, factor, view, columns_for(len(stairs)), highest)


def _draw_stair(figure: Figure, plan: _Layout, i: int, stair: Stair) -> None:
    panel, colour = stair.panel, GOOD if stair.panel.good else BAD
    axis = figure.add_axes(plan.box(i, BARS, plan.step - BARS - TITLE, LEFT))
    draw_errors(
        axis,
        plan.marks[i],
        plan.view,
        sheet=plan.sheet,
        factor=plan.factor,
        good=panel.good,
        small=SMALL,
    )
    lines = wrap(panel.title, LETTERS)
    left, bottom, width, height = plan.box(i, plan.step - TITLE, TITLE, LEFT)
    figure.text(
        left + width / 2,
        bottom + height / 2,
        "\n".join(lines),
        fontsize=fitting(max(lines, key=len), WIDE - 2 * LEFT, 12),
        fontweight="bold",
        color=colour,
        ha="center",
        va="center",
    )
    _draw_bar(figure.add_axes(plan.box(i, 0, BARS, 0)), stair.rms, plan.highest, colour)


def _draw_bar(axis: Axes, rms: float, highest: float, colour: str) -> None:
    """A bar on the ground, its number above it."""
    axis.set_xlim(0, WIDE)
    axis.set_ylim(0, BARS)
    axis.set_axis_off()
    height = bar_height(rms, highest)
    axis.bar(WIDE / 2, height, BROAD, color=colour)
    axis.plot([0, WIDE], [0, 0], color=INK, lw=1.5, clip_on=False)
    said = f"{rms:.{1 if rms >= 0.95 else 2}f} mm RMS"
    axis.text(WIDE / 2, height + 0.06, said, ha="center", va="bottom", fontsize=13, color=INK)


def bar_height(rms: float, highest: float) -> float:
    """[inch] of the bar of an RMS, where the highest bar is of another [mm]."""
    return TALLEST * rms / highest


def _draw_foot(axis: Axes, plan: _Layout) -> None:
    """A bar of a round length, and what the arrows mean."""
    axis.set_xlim(0, plan.wide)
    axis.set_ylim(0, FOOT)
    axis.set_axis_off()
    length = round_down(max(*(spots.longest for spots in plan.marks), 1e-6))
    right = LEFT + length * plan.factor * plan.inch
    axis.plot([LEFT, right], [FOOT / 2] * 2, color=INK, lw=4, solid_capstyle="butt")
    said = (
        f"{length:g} mm of error; arrows, {plan.factor:g} times life size, go from where marks "
        "should be to where they were measured"
    )
    size = fitting(said, plan.wide - right - 2 * LEFT, 11, letter=PLAIN)
    axis.text(right + 0.12, FOOT / 2, said, fontsize=size, color=INK, va="center")
