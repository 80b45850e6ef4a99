"""What later rounds of marks do not share with the first: chains zeroed again, another sheet.

Each such round adds unknowns to those of the frame: how far the zeros of both chains moved, or
how the sheet lies against the first.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cache
from typing import NamedTuple

import numpy as np

from plumb import _core
from plumb.fit.observations import ZERO_COLUMNS, Observations, loaded
from plumb.model.predict import NAMES
from plumb.model.sketches import SKETCHES, Sketch, Strands

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


# Where the sled hangs when sketches make its chains longer, with slopes.
#
# The machine pays out what it believes in, so a chain that is `extra` longer by the sketch counts
# as so much less paid out. The extra depends on the place and the place on the extra: settled in a
# few rounds, since an extra of millimetres changes little over millimetres.

SKETCH_NAMES = tuple(name for sketch in SKETCHES for name in sketch.parameter_names)
ROUNDS = 4  # each leaves about a thousandth of what was left
PLACE_STEP = 0.5  # [mm] for differences by the place
_SHARE = 1e-3  # of a parameter's usual size, for differences by it

# Chains paid out (r, 2) to places (r, 2), slopes by the machine's values (r, 2, v), FOUND (r,).
Hang = Callable[[Observations], tuple[Array, Array, Array]]


@dataclass(frozen=True)
class Sketched:
    """Places under sketches."""

    where: Array  # (r, 2) [mm]
    by_value: Array  # (r, 2, v)
    by_name: Mapping[str, Array]  # (r, 2) by each sketch parameter that was asked for
    outcome: Array  # (r,) FOUND where the sled can hang


def with_sketches(
    values: Array,
    outside: Mapping[str, float],
    rows: Observations,
    hang: Hang,
    *,
    over_top: bool,
    usual_weight: float,
    names: Sequence[str],
) -> Sketched:
    """Return places of a machine with `values` and the sketches' parameters in `outside`.

    How an extra itself changes with the machine's values is left out of the slopes: it is a small
    part of a small part, and a fit comes to rest all the same.
    """
    asked = [sketch for sketch in SKETCHES if _asked(sketch, outside, names)]
    where, by_value, outcome = hang(rows)
    if not asked:
        return Sketched(where, by_value, {}, outcome)

    def strands(places: Array) -> Strands:
        return strands_at(values, rows, places, over_top=over_top, usual_weight=usual_weight)

    def added(sketch: Sketch, parameters: Array, seen: Strands) -> Array:
        """Chain more (r, 2) [mm] by a sketch, by what it adds and by the push."""
        chain = np.zeros_like(seen.places)
        if sketch.extra:
            chain = chain + np.asarray(sketch.extra(parameters, seen), dtype=float)
        if sketch.push and parameters.any():
            force = np.asarray(sketch.push(parameters, seen), dtype=float)
            chain = chain + _pushed(
                values, rows, seen.places, force, over_top=over_top, usual_weight=usual_weight
            )
        return chain

    def extra(places: Array) -> Array:
        seen = strands(places)
        each = [added(sketch, _parameters(sketch, outside), seen) for sketch in present]
        return np.asarray(np.sum(each, axis=0), dtype=float)

    present = [sketch for sketch in asked if _parameters(sketch, outside).any()]
    gives = -np.eye(2)
    if present:
        for _ in range(ROUNDS):
            where, by_value, outcome = hang(replace(rows, chains=rows.chains - extra(where)))
    # A chain that is a millimetre longer acts as one with a millimetre less out at 12 o'clock.
    by_extra = by_value[:, :, list(ZERO_COLUMNS)] @ gives
    if present:
        turned = np.linalg.inv(np.eye(2) - by_extra @ _by_place(extra, where))
        by_value, by_extra = turned @ by_value, turned @ by_extra
    seen = strands(where)
    by_name = {
        name: np.einsum("nij,nj->ni", by_extra, _by_parameter(added, sketch, i, outside, seen))
        for sketch in asked
        for i, name in enumerate(sketch.parameter_names)
        if name in names
    }
    return Sketched(where, by_value, by_name, outcome)


def _asked(sketch: Sketch, outside: Mapping[str, float], names: Sequence[str]) -> bool:
    return any(name in names or outside.get(name) for name in sketch.parameter_names)


def _parameters(sketch: Sketch, outside: Mapping[str, float]) -> Array:
    return np.array([outside.get(name, 0.0) for name in sketch.parameter_names])


def _by_parameter(
    added: Callable[[Sketch, Array, Strands], Array],
    sketch: Sketch,
    i: int,
    outside: Mapping[str, float],
    seen: Strands,
) -> Array:
    """Slope (r, 2) [mm per unit] of the extra chain by a parameter."""
    step = _SHARE * sketch.parameters[i].typical
    parameters = _parameters(sketch, outside)
    ends = []
    for signed in (step, -step):
        moved = parameters.copy()
        moved[i] += signed
        ends.append(added(sketch, moved, seen))
    slope: Array = (ends[0] - ends[1]) / (2 * step)
    return slope


def _by_place(extra: Callable[[Array], Array], where: Array) -> Array:
    """Slopes (r, 2 chains, 2 of place) of the extra chain."""
    columns = []
    for axis in np.eye(2):
        ahead, behind = where + PLACE_STEP * axis, where - PLACE_STEP * axis
        columns.append((extra(ahead) - extra(behind)) / (2 * PLACE_STEP))
    return np.stack(columns, axis=2)


def _pushed(
    values: Array,
    rows: Observations,
    where: Array,
    force: Array,
    *,
    over_top: bool,
    usual_weight: float,
) -> Array:
    """Chain more (r, 2) [mm] that a sled at `where` takes under a force (r, 2) [N]."""
    chain = np.zeros((len(where), 2))
    for weight in np.unique(rows.sled_weights):
        mine = rows.sled_weights == weight
        loaded_values, _ = loaded(values, weight, usual_weight)
        points, pushes = np.ascontiguousarray(where[mine]), np.ascontiguousarray(force[mine])
        pushed, _ = _core.pushed_lengths(loaded_values, over_top, points, pushes)
        still, _ = _core.pushed_lengths(loaded_values, over_top, points, 0 * pushes)
        chain[mine] = pushed - still
    return chain


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
    return Strands(free, cosine, sine, tension, length, where)
