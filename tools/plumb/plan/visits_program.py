"""The G-code for planned visits: a touch of the bit at each, come to from the prescribed side."""

from __future__ import annotations

import textwrap
from collections.abc import Iterator, Sequence

import numpy as np

from plumb.grid.options import DEPTH, Grid
from plumb.marks.model import Mark
from plumb.plan.planned_visits import Visits
from plumb.settings.machine import GRAVITY

Array = np.ndarray
USUAL = Grid()  # heights, feeds and the way into a mark, as a grid has them


FIRST_LINE = "(Plumb: the best marks to measure next)"
LEAST = 1e-6  # [N] a smaller change of the weight is none
COMMENT = 70  # characters: a client sends no line that is longer than the machine's buffer


def program(visits: Visits, *, usual_weight: float, do: Sequence[str] = ()) -> str:
    """The G-code for planned visits.

    It waits (M0) where another weight is to hang on the sled or the chains change places, and at
    the end until all is as it was; `usual_weight` [N] is that of the sled by itself. `do`: what to
    do first, as comments.
    """
    lines = [FIRST_LINE, "(X0 Y0 middle of sheet, Z0 surface; leave the router off)"]
    for sentence in do:
        bare = sentence.replace("(", "").replace(")", "")
        lines += [f"({line})" for line in textwrap.wrap(bare, COMMENT)]
    lines += ["G21", "G90", f"G0 Z{USUAL.safe_height:g}"]
    weight, swapped = usual_weight, False
    each = zip(visits.names, visits.sled_weights, visits.swapped, visit_lines(visits), strict=True)
    for name, next_weight, next_swapped, touched in each:
        lines += _chains_change(swapped, next_swapped)
        lines += _weight_changes(weight, float(next_weight), usual_weight)
        weight, swapped = float(next_weight), bool(next_swapped)
        lines += [f"(mark {name.replace('(', '').replace(')', '')})", *touched]
    lines += ["(back to the middle)", "G0 X0 Y0"]
    lines += _weight_changes(weight, usual_weight, usual_weight)
    return "\n".join([*lines, *_chains_change(swapped, False), ""])


def _weight_changes(weight: float, next_weight: float, usual: float) -> list[str]:
    """The pause in which another weight [N] is hung on the sled; no line for the same."""
    if abs(next_weight - weight) <= LEAST:
        return []
    kilograms = (next_weight - usual) / GRAVITY
    if abs(next_weight - usual) <= LEAST:
        return ["(take off what hangs on the sled)", "M0"]
    return [f"(let {kilograms:.1f} kg more hang on the sled, low and in the middle)", "M0"]


def _chains_change(swapped: bool, next_swapped: bool) -> list[str]:
    """The pause in which the chains change places; no line if they stay."""
    if swapped == next_swapped:
        return []
    return [
        "(hang each chain on the other's sprocket, the same link at 12 o'clock)"
        if next_swapped
        else "(hang each chain on its sprocket again, the same link at 12 o'clock)",
        "M0",
    ]


def visit_lines(visits: Visits) -> Iterator[list[str]]:
    """The lines for each visit; between two of them somebody may hang a weight on the sled."""
    for target, side in zip(visits.targets, visits.approaches, strict=True):
        yield touch(target, _lead_in(side))


def touch(target: Array, lead_in: Array) -> list[str]:
    """The lines for a mark at a target [mm], entered along a vector [mm]."""
    x, y = target - lead_in
    return [
        f"G0 Z{USUAL.safe_height:g}",
        f"G0 X{x:.3f} Y{y:.3f}",
        f"G1 X{target[0]:.3f} Y{target[1]:.3f} F{USUAL.feed:g}",
        f"G1 Z{-DEPTH[USUAL.mode]:g} F{USUAL.plunge_feed:g}",
        f"G0 Z{USUAL.safe_height:g}",
    ]


def way_into(mark: Mark) -> tuple[float, float]:
    """Where [mm] the sled goes straight into a mark from."""
    lead_in = _lead_in(np.array(mark.approach or (0.0, 0.0)))
    return mark.target[0] - float(lead_in[0]), mark.target[1] - float(lead_in[1])


def _lead_in(side: Array) -> Array:
    """The way into a mark [mm] for a unit vector; the usual way if the side does not matter."""
    usual = np.array(USUAL.approach)
    return np.asarray(side * np.hypot(*usual)) if side.any() else usual
