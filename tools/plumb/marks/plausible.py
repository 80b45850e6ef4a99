"""Checks on marks that need the sheet: units, frame, and measured far from target."""

import math
from collections.abc import Callable
from dataclasses import dataclass

from plumb.marks.model import Distance, Mark, Measurements, Point, refuse_exchanged_columns
from plumb.text.errors import naming
from plumb.text.values import INCH

MOST_ERROR = 500.0  # [mm] farther from its target a mark is a slip of the pen
FARTHEST_REPEAT = 100.0  # [mm] a repeat may lie this far from the first mark, whose hole is used up
OUTSIDE = 100.0  # [mm] a target may lie beyond the sheet's edge by this much
# [mm] marks closer together than this on a sheet ten times as wide were not spread on purpose
TOO_CLOSE = 100.0
SUSPICIOUS = 120.0  # [mm] nearer than this even a chain on the wrong tooth or link may be the cause
MOST_DISTANCE_ERROR = 200.0  # [mm]

Sheet = tuple[float, float]
_INCH_HINT = 'looks like inches; write units = "inch" at the top, or millimetres'


def to_machine(point: Point, *, sheet: Sheet) -> Point:
    """Return a point counted from the sheet's top-left corner, y down [mm], in the machine
    frame.
    """
    return point[0] - sheet[0] / 2, sheet[1] / 2 - point[1]


def checked(measurements: Measurements, *, sheet: Sheet) -> Measurements:
    """Return the same measurements, if they can be what they say on a sheet of that width and
    height.
    """
    source = measurements.source
    with naming(source, ""):
        if not measurements.measured_marks and not measurements.distances:
            raise ValueError("has no measured mark; add measured positions")
    for distance in measurements.distances:
        with naming(source, f"distance {'-'.join(distance.between)}"):
            _refuse_unnamed(measurements, distance)
    for mark in measurements.marks:
        with naming(source, f"mark {mark.name}"):
            _refuse_useless(measurements, mark)
    with naming(source, ""):
        _refuse_inches(measurements, sheet)
    for mark in measurements.marks:
        with naming(source, f"mark {mark.name}"):
            _refuse_outside(mark, sheet)
            _refuse_far(measurements, mark, sheet)
    for distance in measurements.distances:
        with naming(source, f"distance {'-'.join(distance.between)}"):
            _refuse_odd(measurements, distance)
    refuse_exchanged_columns(measurements)
    return measurements


def _refuse_unnamed(measurements: Measurements, distance: Distance) -> None:
    names = {mark.name for mark in measurements.marks}
    for name in distance.between:
        if name not in names:
            raise ValueError(
                f"there is no mark named '{name}'; add a [[mark]] with that name and its target"
            )


def _refuse_useless(measurements: Measurements, mark: Mark) -> None:
    """Refuse a mark that says nothing, or whose name does not say which mark it is."""
    first = measurements.target_of(mark.name)
    is_end = any(mark.name in distance.between for distance in measurements.distances)
    if mark.measured is None and not is_end:
        raise ValueError(
            "has no measured position and no distance uses it; "
            "add measured = [x, y], or remove the mark"
        )
    if math.dist(mark.target, first) > FARTHEST_REPEAT:
        raise ValueError(
            "the same name stands twice with targets far apart; "
            f"give another name, or for a repeat a target within {FARTHEST_REPEAT:g} mm"
        )
    if is_end and mark.target != first:
        raise ValueError(
            "a distance goes to this name, but it has two places; "
            "give the second place another name"
        )


def _refuse_inches(measurements: Measurements, sheet: Sheet) -> None:
    groups: dict[str, list[Point]] = {
        "targets": [mark.target for mark in measurements.marks],
        "measured positions": [measured for _, measured in measurements.readings],
    }
    # A mark or two, read several times, are close together without being in inches.
    if len(set(groups["targets"])) < 3 or max(sheet) < 10 * TOO_CLOSE:
        return
    for what, points in groups.items():
        if len(points) < 3:
            continue
        spread = max(
            max(point[axis] for point in points) - min(point[axis] for point in points)
            for axis in (0, 1)
        )
        if spread < TOO_CLOSE:
            raise ValueError(
                f"all {what} lie within {spread:.0f} mm of each other "
                f"on a sheet {sheet[0]:.0f} mm wide; {_INCH_HINT}"
            )


def _refuse_outside(mark: Mark, sheet: Sheet) -> None:
    x, y = mark.target
    if abs(x) > sheet[0] / 2 + OUTSIDE or abs(y) > sheet[1] / 2 + OUTSIDE:
        raise ValueError(
            f"target ({x:.1f}, {y:.1f}), counted from the middle of the sheet with y up, "
            f"is off the {sheet[0]:.0f} x {sheet[1]:.0f} mm sheet; check the frame (top-left "
            "corner with y down, or middle with y up), the units and the sheet size in the settings"
        )


def _refuse_far(measurements: Measurements, mark: Mark, sheet: Sheet) -> None:
    far = far_reading(measurements, mark, sheet)
    if far:
        frame = "check the frame (top-left corner with y down, or middle with y up) and the numbers"
        remedy = far.mistake or frame
        raise ValueError(f"measured {far.error:.0f} mm away from its target; {remedy}")


@dataclass(frozen=True)
class FarReading:
    """A reading farther from its target than any machine brings a mark."""

    error: float  # [mm]
    mistake: str  # the likely mistake, or nothing
    corrected: Point | None  # [mm] what was meant, if that was the mistake


def far_reading(measurements: Measurements, mark: Mark, sheet: Sheet) -> FarReading | None:
    """Return whether a mark's reading is too far from its target to be true."""
    if mark.measured is None:
        return None
    error = math.dist(mark.target, mark.measured)
    if error <= SUSPICIOUS:
        return None
    other = _exchanged(measurements, mark, mark.measured)
    if other:
        said = f"the readings of {mark.name} and {other.name} may be exchanged"
        return FarReading(error, said, other.measured)
    mistake, meant = _likely_mistake(mark.target, mark.measured, sheet)
    if mistake or error > MOST_ERROR:
        return FarReading(error, mistake, meant)
    return None


def _exchanged(measurements: Measurements, mark: Mark, measured: Point) -> Mark | None:
    """Return the mark that was read where this mark should be, and the other way round."""
    near = math.dist(mark.target, measured) / 5
    readings = measurements.readings
    far = [place for sent, place in readings if math.dist(sent.target, place) > SUSPICIOUS]
    # Where most are far the whole file is turned round, and marks only seem exchanged.
    for other, other_measured in readings if 2 * len(far) <= len(readings) else ():
        there = math.dist(other.target, measured)
        back = math.dist(mark.target, other_measured)
        if other.target != mark.target and max(there, back) < min(TOO_CLOSE, near):
            return other
    return None


def _likely_mistake(target: Point, measured: Point, sheet: Sheet) -> tuple[str, Point | None]:
    """Return the usual slip that would explain a mark far from its target, and what was meant."""
    meant = {
        sentence: undo(*measured) for sentence, undo in _slips(sheet[0] / 2, sheet[1] / 2).items()
    }
    best = min(meant, key=lambda sentence: math.dist(target, meant[sentence]))
    left = math.dist(target, meant[best])
    explained = left < min(TOO_CLOSE, math.dist(target, measured) / 5)
    return (best, meant[best]) if explained else ("", None)


def _slips(right: float, top: float) -> dict[str, Callable[[float, float], Point]]:
    """Return the usual slips of the pen and what undoes each; the sheet ends at right and
    top [mm].
    """
    corner_inches = f"measured, from the top-left corner, {_INCH_HINT}"
    from_middle = "measured counts from the middle, target from the top-left corner; use one frame"
    from_corner = "measured counts from the top-left corner, target from the middle; use one frame"
    from_below = "measured counts from the bottom-left corner; use one frame"
    return {
        "the measured y runs the other way; check the frame": lambda x, y: (x, -y),
        "the measured x runs the other way; check the frame": lambda x, y: (-x, y),
        "x and y may be exchanged": lambda x, y: (y, x),
        "x and y, from the corner, may be exchanged": lambda x, y: (
            top - y - right,
            top - x - right,
        ),
        from_corner: lambda x, y: (x - right, top - y),
        from_middle: lambda x, y: (x + right, top - y),
        from_below: lambda x, y: (x - right, y - top),
        f"measured {_INCH_HINT}": lambda x, y: (INCH * x, INCH * y),
        corner_inches: lambda x, y: (INCH * (x + right) - right, top - INCH * (top - y)),
    }


def _refuse_odd(measurements: Measurements, distance: Distance) -> None:
    first, second = (measurements.target_of(name) for name in distance.between)
    meant = math.dist(first, second)
    if abs(meant - distance.length) > MOST_DISTANCE_ERROR:
        inches = abs(meant - INCH * distance.length) < TOO_CLOSE
        remedy = _INCH_HINT if inches else "check the names and the number"
        said = f"measured {distance.length:g} mm, but the targets are {meant:.0f} mm apart"
        raise ValueError(f"{said}; {remedy}")


# Places counted from two edges of the sheet, as a tape measures them [mm].


def from_edges(place: Point, *, sheet: Sheet, corner: str) -> Point:
    """Return a place of the machine frame, counted from the two edges that meet in a corner."""
    right, top = _is_right(corner), _is_top(corner)
    x = sheet[0] / 2 - place[0] if right else sheet[0] / 2 + place[0]
    y = sheet[1] / 2 - place[1] if top else sheet[1] / 2 + place[1]
    return x, y


def in_machine(read: Point, *, sheet: Sheet, corner: str) -> Point:
    """Return the place in the machine frame that was read from the edges of a corner."""
    x = sheet[0] / 2 - read[0] if _is_right(corner) else read[0] - sheet[0] / 2
    y = sheet[1] / 2 - read[1] if _is_top(corner) else read[1] - sheet[1] / 2
    return x, y


def _is_right(corner: str) -> bool:
    return corner.endswith("right")


def _is_top(corner: str) -> bool:
    return corner.startswith("top")
