"""Settings back into a `groundcontrol.ini`: the keys that change, and what cannot be said there."""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from decimal import Decimal
from os import PathLike

from plumb.settings.ini import SOURCES
from plumb.settings.machine import MachineSettings, PublishedSettings, radius_in_published
from plumb.settings.published import is_tuned, tuned_numbers
from plumb.text.errors import refusal
from plumb.text.files import write_whole
from plumb.text.ini import parse_ini, read_ini, with_values

Key = tuple[str, str]
# The published firmware collects all digits of a number in one 32-bit integer and knows no
# exponent; more digits would overflow silently.
MOST_DIGITS = 9
SAME = 1e-9  # relative; two values closer than this are the same in nine digits
NOTHING = 1e-15  # smaller numbers mean zero for every setting there is


@dataclass(frozen=True)
class Unsaid:
    """A setting that the published firmware cannot express, with a sentence for the user."""

    name: str
    sentence: str


@dataclass(frozen=True)
class GroundControlChanges:
    """Values by (section, key) as a groundcontrol.ini holds them, and what is lost on the way."""

    values: dict[Key, float]
    unsaid: tuple[Unsaid, ...]


def groundcontrol_changes(settings: MachineSettings) -> GroundControlChanges:
    """The keys that express these settings for the published firmware, in its units."""
    ours = settings.as_plumb_model()
    published = published_machine(ours)
    said = {
        "motor_gap": published.motor_gap,
        "motor_offset": published.motor_offset,
        **tuned_numbers(ours.effects),
        "rotation_radius": published.rotation_radius,
    }
    # Rounded far below what any of them means, so that 1072.6 - 609.6 is 463 again.
    values = {SOURCES[name]: round(value, 10) for name, value in said.items()}
    return GroundControlChanges(values=values, unsaid=_unsaid(ours))


def published_machine(settings: MachineSettings) -> MachineSettings:
    """This machine with the published firmware, which gets of it what its numbers can say."""
    ours = settings.as_plumb_model()
    chains = tuned_numbers(ours.effects)
    left, right = chains["left_tolerance"] / 100, chains["right_tolerance"] / 100
    return replace(
        ours,
        controller="stock",
        rotation_radius=ours.rotation_radius * radius_in_published(left, right),
        published=replace(PublishedSettings(), **chains),
    )


def _unsaid(ours: MachineSettings) -> tuple[Unsaid, ...]:
    """Everything in our model that no key of the published firmware can hold."""
    lost = []
    if ours.motor_center_x:
        lost.append(
            Unsaid(
                "motor_center_x",
                f"the motors sit {ours.motor_center_x:g} mm off the middle: move the sheet instead",
            )
        )
    for name, parameters in ours.effects.items():
        for parameter, value in parameters.items():
            if value and not is_tuned(name, parameter):
                lost.append(
                    Unsaid(
                        f"{name}.{parameter}",
                        f"{name} {parameter} = {value:g} has no setting in the published firmware",
                    )
                )
    return tuple(lost)


def write_groundcontrol_ini(
    path: str | PathLike[str],
    original_path: str | PathLike[str],
    changes: Mapping[Key, float | str],
) -> None:
    """Copy an ini file with some values replaced and every other byte as it was."""
    write_whole(path, changed_ini(original_path, changes))


def changed_ini(original_path: str | PathLike[str], changes: Mapping[Key, float | str]) -> bytes:
    """The bytes of an ini file with some values replaced; equal numbers leave their line alone."""
    ini = read_ini(original_path)
    needed: dict[Key, str] = {}
    for (section, key), value in changes.items():
        place = f"[{section}] {key}"
        entry = ini.find(key, section=section)
        if isinstance(value, str):
            if any(sign in value for sign in "\r\n"):
                raise refusal(
                    original_path,
                    "the new value has a line break",
                    place=place,
                    remedy="write it on a single line",
                )
            new = value
        else:
            if not math.isfinite(value):
                raise refusal(original_path, f"{value} is not a usable number", place=place)
            new = number_for_firmware(value)
        if entry is None or not same_number(entry.value, value):
            needed[section, key] = new
    text = with_values(ini, needed)
    parse_ini(text, source=str(original_path))
    return text.encode("utf-8", "surrogateescape")


def number_for_firmware(value: float) -> str:
    """A number as the published firmware can read it: no exponent, at most nine digits."""
    if abs(value) >= 10**MOST_DIGITS:
        raise ValueError(f"{value:g} has more digits than the published firmware can read")
    if abs(value) < NOTHING:
        return "0"
    text = f"{Decimal(f'{value:.{MOST_DIGITS}g}'):f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def same_number(old: str, new: float | str) -> bool:
    """Whether a value of the file says the same already."""
    if isinstance(new, str):
        return old == new
    try:
        return math.isclose(float(old), new, rel_tol=SAME, abs_tol=NOTHING)
    except ValueError:
        return False
