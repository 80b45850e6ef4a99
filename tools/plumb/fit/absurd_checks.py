"""Numbers that no real machine has: a slip of the pen, or another unit, and no measurement."""

from __future__ import annotations

from collections.abc import Sequence

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


def refuse_absurd(checks: Sequence[Checked], settings: MachineSettings) -> None:
    """Raise InputError for a number that cannot have been measured on such a machine."""
    for check in checks:
        if check.name in parameter_words():
            _refuse_size(check)
        elif check.name in FRAME_FIELDS:
            _refuse_frame(check, settings)


def _refuse_size(check: Checked) -> None:
    """An effect's size against what was met in workshops."""
    known = plausible_range(check.name)
    largest = FARTHEST * max(abs(known.low), abs(known.high))
    if abs(check.value) - SURE * check.sigma <= largest:
        return
    unit = parameter_words()[check.name]["unit"]
    meant = "a share of the whole: 0.1 mm per metre is 0.0001" if unit == "1" else f"in {unit}"
    raise InputError(
        f"{_said(check)}: real machines have {known.low:g} to {known.high:g}; VALUE is {meant}"
    )


def _refuse_frame(check: Checked, settings: MachineSettings) -> None:
    """A number of the frame against the settings."""
    stated = dict(settings.frame)[check.name]
    sigma = {**PRIORS, **WIDE}.get(check.name, 0.0)
    allowed = max(FRAME_SHARE * abs(stated), FRAME_SIGMAS * sigma)
    if abs(check.value - stated) - SURE * check.sigma > allowed:
        raise InputError(
            f"{_said(check)}: that is far from the {stated:g} of the settings; check the number, "
            "its unit (mm, N), and that the settings are those of this machine"
        )


def _said(check: Checked) -> str:
    return f"{to_do('--checked', page='known')} {check.name}={check.value:g}"
