"""Differences between rounds of marks: chains zeroed again, another sheet.

Each such round adds unknowns to those of the frame: how far the zeros of both chains moved, or
how the sheet lies against the first.
"""

import re
from collections.abc import Callable, Iterable, Mapping
from dataclasses import dataclass
from functools import cache
from typing import NamedTuple

import numpy as np

from plumb import _core
from plumb.fit.observations import Observations, loaded
from plumb.model.predict import NAMES

Array = np.ndarray
ZERO_AXES = ("left", "right")
POSE_AXES = ("x", "y", "rotation")
# Standard deviations: a link or a tooth more or less is 6.35 mm; a sheet lies like the first.
ZERO_SIGMA = 10.0  # [mm]
POSE_SIGMAS = (20.0, 20.0, 0.02)  # [mm, mm, rad]
_ZERO = re.compile(r"zero(\d+)\.(left|right)")
_POSE = re.compile(r"sheet(\d+)\.(x|y|rotation)")


class RoundUnknown(NamedTuple):
    """An unknown of a later round."""

    group: int  # which zero group or sheet group
    axis: int  # index into ZERO_AXES or POSE_AXES


def round_priors(rows: Observations) -> dict[str, float]:
    """Return standard deviations [mm, rad] of all unknowns that later rounds have, by name."""
    priors: dict[str, float] = {}
    for group in range(1, _groups(rows.zero_groups)):
        priors |= {f"zero{group + 1}.{axis}": ZERO_SIGMA for axis in ZERO_AXES}
    # Distances between marks of one sheet do not feel where it lies.
    placed = set(rows.sheet_groups[rows.mark_rows].tolist())
    for group in range(1, _groups(rows.sheet_groups)):
        if group in placed:
            names = (f"sheet{group + 1}.{axis}" for axis in POSE_AXES)
            priors |= dict(zip(names, POSE_SIGMAS, strict=True))
    return priors


def unit_of(name: str) -> str | None:
    """Return the unit of an unknown of a round; None if it is none."""
    unknown = zero_of(name) or pose_of(name)
    if unknown is None:
        return None
    return "rad" if name.endswith(".rotation") else "mm"


def notes_on(names: Iterable[str]) -> list[str]:
    """Return a sentence for each group of round unknowns among these names."""
    groups = sorted({name.partition(".")[0] for name in names if unit_of(name)})
    meaning = {
        "zero": "how much more chain is out at 12 o'clock since the chains were zeroed again",
        "sheet": "how the new sheet lies against the first",
    }
    return [
        f"{group}: {meaning[group.rstrip('0123456789')]}; no setting holds it" for group in groups
    ]


@cache
def zero_of(name: str) -> RoundUnknown | None:
    """Return the chain zero that a name stands for."""
    return _parsed(_ZERO, ZERO_AXES, name)


@cache
def pose_of(name: str) -> RoundUnknown | None:
    """Return the part of a sheet's pose that a name stands for."""
    return _parsed(_POSE, POSE_AXES, name)


def zeros_of(outside: Mapping[str, float], rows: Observations) -> Array:
    """Return what each zero group adds to left and right chain zero, (groups, 2) [mm]."""
    return _filled(outside, _groups(rows.zero_groups), 2, zero_of)


def poses_of(outside: Mapping[str, float], rows: Observations) -> Array:
    """Return how each sheet lies against the first, (groups, 3): x, y [mm], rotation [rad]."""
    return _filled(outside, _groups(rows.sheet_groups), 3, pose_of)


def _groups(numbers: Array) -> int:
    return int(numbers.max(initial=0)) + 1


def last_turn_of(names: Iterable[str]) -> str:
    """Return the number that says how the last sheet is turned against the first; empty if none
    does.
    """
    turns = {
        unknown.group: name
        for name in names
        if (unknown := pose_of(name)) and POSE_AXES[unknown.axis] == "rotation"
    }
    return turns[max(turns)] if turns else ""


def _parsed(pattern: re.Pattern[str], axes: tuple[str, ...], name: str) -> RoundUnknown | None:
    match = pattern.fullmatch(name)
    return RoundUnknown(int(match[1]) - 1, axes.index(match[2])) if match else None


def _filled(
    outside: Mapping[str, float],
    groups: int,
    axes: int,
    parse: Callable[[str], RoundUnknown | None],
) -> Array:
    values_of_groups = np.zeros((groups, axes))
    for name, value in outside.items():
        unknown = parse(name)
        if unknown is not None:
            values_of_groups[unknown] = value
    return values_of_groups


@dataclass(frozen=True)
class Strands:
    """Both strands of each visit; columns are left and right."""

    span: Array  # (n, 2) [mm] free chain between sprocket and ring
    across: Array  # (n, 2) [1] cosine of the strand's angle below the horizontal
    down: Array  # (n, 2) [1] its sine
    tension: Array  # (n, 2) [N]
    length: Array  # (n, 2) [mm] chain beyond the sprocket by all effects of the machine


def strands_at(
    values: Array, rows: Observations, where: Array, *, over_top: bool, usual_weight: float
) -> Strands:
    """Return both strands of a sled at `where` (r, 2) [mm], as heavy as on each visit."""
    count = len(where)
    shown = {name: np.zeros((count, 2)) for name in ("free", "cosine", "sine", "pull", "length")}
    for weight in np.unique(rows.sled_weights):
        mine = rows.sled_weights == weight
        loaded_values, _ = loaded(values, weight, usual_weight)
        points = np.ascontiguousarray(where[mine])
        for name, column in _core.strands(loaded_values, over_top, points).items():
            if name in shown:
                shown[name][mine] = column
        shown["pull"][mine] *= loaded_values[NAMES.index("sled_weight")]
    free, cosine, sine, tension, length = shown.values()
    return Strands(free, cosine, sine, tension, length)
