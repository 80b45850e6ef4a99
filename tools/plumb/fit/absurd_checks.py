"""Numbers that no real machine has: a slip of the pen, or another unit, and no measurement."""

from __future__ import annotations

from collections.abc import Sequence
from math import inf

from plumb.fit.expected import WIDE
from plumb.fit.plausible import plausible_range
from plumb.fit.problem import PRIORS, Checked
from plumb.model.catalogue import parameter_words
from plumb.settings.machine import FRAME_FIELDS, MachineSettings
from plumb.text.errors import InputError
from plumb.text.readers import to_do

FARTHEST = 3.0  # times the largest size that was met: a size beyond it is no measurement
SURE = 2.0  # [sigmas] by which a poor measurement may lie beyond
FRAME_SHARE, FRAME_SIGMAS = 0.1, 10.0  # a number of the frame may lie this far from the settings
SMALLEST = 1 / 3  # of a length or a weight of the settings


def refuse_absurd(checks: Sequence[Checked], settings: MachineSettings) -> None:
    """Raise InputError for a number that cannot have been measured on such a machine."""
    for check in checks:
        if is_absurd(check, settings):
            raise InputError(f"{_said(check)}: {_why(check, settings)}")


def is_absurd(check: Checked, settings: MachineSettings) -> bool:
    """Whether a number cannot have been measured on such a machine."""
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
    meant = "a share of the whole: 0.1 mm per metre is 0.0001" if unit == "1" else f"in {unit}"
    return f"real machines have {met.low:g} to {met.high:g}; VALUE is {meant}"


def _said(check: Checked) -> str:
    return f"{to_do('--checked', page='known')} {check.name}={check.value:g}"
