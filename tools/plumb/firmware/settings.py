"""The firmware's settings by $-number: what there are, and what they mean to the kinematics."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass

from plumb import _core
from plumb.settings.machine import MachineSettings, frame_of


@dataclass(frozen=True)
class Setting:
    """A row of the firmware's table."""

    number: int
    name: str
    unit: str
    kind: str  # "bool", "u8", "u16" or "float"
    access: str  # "listed", or "hidden" and "kept": not in the dump, set by B codes alone
    usual: float
    low: float
    high: float
    touches: list[str]  # what is worked out again, of TOUCHES in the page of settings
    step: int  # 0: any value; 255: any but zero; else whole values in steps from low
    key: str  # section and key of the published programs, or ""
    sentence: str
    change: str  # what is not as in the published firmware, or ""


def every_setting() -> list[Setting]:
    """All settings in the order of the firmware's dump."""
    return [Setting(**row) for row in _core.settings_table()]


def machine_of(numbers: Mapping[int, float], *, sheet: tuple[float, float]) -> MachineSettings:
    """The machine with which the firmware computes when these settings are not at their defaults.

    Raises ValueError in the firmware's words for a setting that it refuses.
    """
    effective = _core.effective(dict(numbers))
    effects: dict[str, dict[str, float]] = {}
    for name, value in effective["effects"].items():
        effect, _, parameter = name.partition(".")
        if value:
            effects.setdefault(effect, {})[parameter] = _plain(value)
    return MachineSettings(
        sheet_width=sheet[0],
        sheet_height=sheet[1],
        feed="top" if effective["over_top"] else "bottom",
        effects=effects,
        **frame_of({name: _plain(value) for name, value in effective["frame"].items()}),
    )


def _plain(value: float) -> float:
    """A number with the seven digits that the firmware's float holds."""
    return float(f"{value:.7g}")


def format_value(value: float) -> str:
    """A value as the firmware's dump writes it."""
    return _core.format_value(value)
