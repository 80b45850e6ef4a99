"""The expected error of marks before anything is measured, by what is known of the machine.

Each number of the frame is wrong by its stated error, and each effect that the settings leave out
may be there in its typical size, all independent of each other.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from math import inf
from typing import Any

import numpy as np

from plumb.fit.compare import best_pose
from plumb.fit.fit import PRIORS, Checked
from plumb.fit.observations import SHEET_ROTATION, rms
from plumb.model.catalogue import parameter_words
from plumb.model.plain import plain_range
from plumb.model.predict import (
    FOUND,
    NAMES,
    Array,
    believed_lengths,
    frame_words,
    places_with_slopes,
    values_of,
)
from plumb.settings.machine import FRAME_FIELDS, MachineSettings
from plumb.text.answers import Internal, in_json
from plumb.text.errors import InputError, to_do
from plumb.text.values import Unit

# [mm, N] how far a number may be off that no fit moves, before the owner measured it.
WIDE = {"rotation_radius": 5.0, "sled_weight": 15.0}
COLUMNS, ROWS, MARGIN = 7, 5, 100.0  # of the places that are looked at; [mm] from the edge


@dataclass(frozen=True)
class Expected:
    """Usual error, RMS over the sheet [mm]."""

    frame: Internal[float]  # by the frame's numbers and where the sheet lies
    shape: Internal[float]  # by the same, the sheet laid at its best
    effects: Internal[float]  # by effects that the settings leave out, the sheet laid at its best

    @in_json
    def whole_mm(self) -> float:
        """All of it, as a tape from the sheet's edges reads it."""
        return float(np.hypot(self.frame, self.effects))

    @in_json
    def among_marks_mm(self) -> float:
        """All of it, the sheet laid at its best."""
        return float(np.hypot(self.shape, self.effects))


def expected_priors(known: Mapping[str, float]) -> dict[str, float]:
    """Return how far each number of the frame may be off, with those that the owner knows
    better.
    """
    frame = {name: sigma for name, sigma in known.items() if "." not in name}
    return {**PRIORS, **WIDE, **frame}


def expected_sentence(expected: Expected | None, unit: Unit) -> str:
    """Return what is normal, for people; empty if no mark can be made."""
    if expected is None:
        return ""
    return (
        "Before anything is corrected, marks may well be off by "
        f"{unit.worded(expected.among_marks_mm, 1)} among each other, and all together by "
        f"{unit.worded(expected.whole_mm, 0)} where the sheet hangs otherwise. That is normal."
    )


def expected_error(
    settings: MachineSettings, priors: Mapping[str, float], *, at: Array | None = None
) -> Expected:
    """Return how far marks will be off, all over the sheet or at places (n, 2) [mm].

    Raises ValueError where the controller cannot go.
    """
    model = settings.as_plumb_model()
    targets = places_over(settings.sheet) if at is None else at
    where, slopes, outcome = places_with_slopes(
        values_of(model),
        over_top=model.feed == "top",
        chains=believed_lengths(settings, targets),
    )
    good = outcome == FOUND
    where, slopes = where[good], slopes[good]
    of_frame = [
        slopes[:, :, NAMES.index(name)] * priors[name]
        for name in FRAME_FIELDS
        if priors.get(name) and name in NAMES
    ]
    turned = np.column_stack([-where[:, 1], where[:, 0]]) * priors.get(SHEET_ROTATION, 0.0)
    of_effects = [
        slopes[:, :, NAMES.index(name)] * abs(float(words["typical"]))
        for name, words in parameter_words().items()
        if name in NAMES and not settings.effect(*name.split("."))
    ]
    return Expected(
        frame=_together([*of_frame, turned]),
        shape=_together([_shape(where, moved) for moved in of_frame]),
        effects=_together([_shape(where, moved) for moved in of_effects]),
    )


def expected_anywhere(settings: MachineSettings, priors: Mapping[str, float]) -> Expected | None:
    """Return how far marks will be off all over the sheet; None where no sled hangs there."""
    try:
        expected = expected_error(settings, priors)
    except ValueError:
        return None
    return expected if np.isfinite(expected.whole_mm) else None


def places_over(sheet: tuple[float, float]) -> Array:
    """Return places (n, 2) [mm] all over a sheet."""
    width, height = sheet
    x = np.linspace(-width / 2 + MARGIN, width / 2 - MARGIN, COLUMNS)
    y = np.linspace(height / 2 - MARGIN, -height / 2 + MARGIN, ROWS)
    places: Array = np.stack(np.meshgrid(x, y), axis=-1).reshape(-1, 2)
    return places


def _shape(where: Array, moved: Array) -> Array:
    """Return what is left of a motion (n, 2) when the sheet is shifted and turned back."""
    pose = best_pose(where, where + moved)
    return pose.errors if pose else np.zeros_like(moved)


def _together(several: list[Array]) -> float:
    """RMS of independent motions (n, 2), added up."""
    return float(np.sqrt(sum(rms(moved) ** 2 for moved in several)))


# Which sizes a real machine can have: one rule for the fit, the diagnosis and the proposals.
#
# The catalogue's range is what was met in workshops. A value in it is plausible. What was met is no
# wall, so an interval is refused only where all of it lies beyond MARGIN times the range: of 18
# made-up boards with a size 1.25 times the largest, the range itself refused the truth in 11.

OUTSIDE = 1.5
ROUNDING = 1e-3  # of the larger end: what is held at zero comes out about zero


@dataclass(frozen=True)
class PlausibleRange:
    """From the smallest to the largest value that was met; infinite where no limit is known."""

    low: float = -np.inf
    high: float = np.inf

    @property
    def limits(self) -> tuple[float | None, float | None]:
        """Both ends; None where no limit is known."""
        low, high = (end if np.isfinite(end) else None for end in (self.low, self.high))
        return low, high

    def holds(self, value: float) -> bool:
        """Return whether a value is plausible."""
        ends = [abs(end) for end in (self.low, self.high) if np.isfinite(end)]
        tiny = ROUNDING * max(ends, default=0.0)
        return bool(self.low - tiny <= value <= self.high + tiny)

    def is_near(self, low: float | Array, high: float | Array) -> Any:
        """Return whether an interval (or each of many) reaches what a real machine may have."""
        least = self.low * OUTSIDE if self.low < 0 else self.low / OUTSIDE
        most = self.high / OUTSIDE if self.high < 0 else self.high * OUTSIDE
        return (np.asarray(high) >= least) & (np.asarray(low) <= most)


@cache
def plausible_range(name: str) -> PlausibleRange:
    """Return the range of a parameter, or of a number of the frame, by its full name."""
    words = {frame["name"]: frame for frame in frame_words()} | parameter_words()
    if name not in words:
        return PlausibleRange()
    return PlausibleRange(words[name]["low"], words[name]["high"])


def range_said(name: str, unit: Unit) -> str:
    """Return the same in words; empty: no limit is known."""
    low, high = plausible_range(name).limits
    return "" if low is None or high is None else plain_range(name, low, high, unit)


# Numbers that no real machine has: a slip of the pen, or another unit, and no measurement.

FARTHEST = 3.0  # times the largest size that was met: a size beyond it is no measurement
SURE = 2.0  # [sigmas] by which a poor measurement may lie beyond
FRAME_SHARE, FRAME_SIGMAS = 0.1, 10.0  # a number of the frame may lie this far from the settings
SMALLEST = 1 / 3  # of a length or a weight of the settings


def refuse_absurd(checks: Sequence[Checked], settings: MachineSettings) -> None:
    """Raise InputError for a number that cannot have been measured on such a machine."""
    for check in checks:
        if is_absurd(check, settings):
            said = f" {check.name}={check.value:g}: {_why(check, settings)}"
            raise InputError(to_do("--checked", page="known") + said)


def is_absurd(check: Checked, settings: MachineSettings) -> bool:
    """Return whether a number cannot have been measured on such a machine."""
    low, high = _possible(check.name, settings)
    surely = SURE * check.sigma
    return not low <= check.value + surely or not check.value - surely <= high


def _possible(name: str, settings: MachineSettings) -> tuple[float, float]:
    """From the smallest to the largest value that a measurement may have."""
    met = plausible_range(name)
    if name in parameter_words():
        # An effect's size against what was met in workshops.
        largest = FARTHEST * max(abs(met.low), abs(met.high))
        return -largest, largest
    if name not in FRAME_FIELDS:
        return -inf, inf
    stated = dict(settings.frame)[name]
    allowed = max(FRAME_SHARE * abs(stated), FRAME_SIGMAS * {**PRIORS, **WIDE}.get(name, 0.0))
    smallest = SMALLEST * stated if met.low >= 0 else -inf
    return max(stated - allowed, smallest), stated + allowed


def _why(check: Checked, settings: MachineSettings) -> str:
    if check.name in FRAME_FIELDS:
        return (
            f"that is far from the {dict(settings.frame)[check.name]:g} of the settings; check the "
            "number, its unit (mm, N), and that the settings are those of this machine"
        )
    unit, met = parameter_words()[check.name]["unit"], plausible_range(check.name)
    meant = "as a share of the whole: 0.1 mm per metre is 0.0001" if unit == "1" else f"in {unit}"
    return f"real machines have {met.low:g} to {met.high:g}; write it {meant}"
