"""`groundcontrol.ini`: the settings that move the sled, read from the file of the published
programs.
"""

from __future__ import annotations

import math
from collections.abc import Mapping
from dataclasses import dataclass, replace
from decimal import Decimal
from difflib import get_close_matches
from os import PathLike

from plumb.settings.machine import (
    SLED_WEIGHT,
    MachineSettings,
    PublishedSettings,
    find_fault,
    is_tuned,
    radius_in_published,
    tuned_numbers,
)
from plumb.text.errors import InputError, naming
from plumb.text.ini import IniText, parse_ini, read_ini, with_values
from plumb.text.values import number_in

MASLOW, ADVANCED = "Maslow Settings", "Advanced Settings"

# Which key of the file each of our settings comes from.
SOURCES = {
    "motor_gap": (MASLOW, "motorSpacingX"),
    "sheet_width": (MASLOW, "bedWidth"),
    "sheet_height": (MASLOW, "bedHeight"),
    "motor_offset": (MASLOW, "motorOffsetY"),
    "rotation_radius": (ADVANCED, "rotationRadius"),
    "gear_teeth": (ADVANCED, "gearTeeth"),
    "link_pitch": (ADVANCED, "chainPitch"),
    "chain_sag_correction": (ADVANCED, "chainSagCorrection"),
    "feed": (ADVANCED, "chainOverSprocket"),
    "kinematics": (ADVANCED, "kinematicsType"),
    # The next keys came later or belong to one program only, so a file may lack them.
    "left_tolerance": (ADVANCED, "leftChainTolerance"),
    "right_tolerance": (ADVANCED, "rightChainTolerance"),
    "chain_length": (ADVANCED, "chainLength"),
    "chain_elasticity": (ADVANCED, "chainElasticity"),
    "holey_sled_weight": (MASLOW, "sledWeight"),
    "top_beam_tilt": (ADVANCED, "topBeamTilt"),
}
# Other keys of the same files that look like a misspelt key of this list.
NEIGHBOURS = (
    "chainExtendLength",
    "sledWidth",
    "sledHeight",
    "sledCG",
    "bedDepth",
    "homeX",
    "homeY",
)


def read_settings_ini(path: str | PathLike[str]) -> MachineSettings:
    """Return the settings of a groundcontrol.ini; it belongs to the stock controller."""
    return published_settings(_settings_text(path))


def published_settings(ini: IniText) -> MachineSettings:
    """Return the settings that the entries of a client's file hold."""
    _refuse_other_kinematics(ini)
    height = _needed(ini, "sheet_height")
    weight = _optional(ini, "holey_sled_weight")
    settings = MachineSettings(
        motor_gap=_needed(ini, "motor_gap"),
        motor_height=height / 2 + _needed(ini, "motor_offset"),
        rotation_radius=_needed(ini, "rotation_radius"),
        sheet_width=_needed(ini, "sheet_width"),
        sheet_height=height,
        feed=_feed(ini),
        sprocket_radius=_needed(ini, "gear_teeth") * _needed(ini, "link_pitch") / (2 * math.pi),
        sled_weight=weight if weight is not None and weight > 0 else SLED_WEIGHT,
        controller="stock",
        published=PublishedSettings(
            chain_sag_correction=_needed(ini, "chain_sag_correction"),
            left_tolerance=_with_default(ini, "left_tolerance", 0.0),
            right_tolerance=_with_default(ini, "right_tolerance", 0.0),
            chain_elasticity=_optional(ini, "chain_elasticity"),
            holey_sled_weight=weight,
            chain_length=_with_default(ini, "chain_length", 3360.0),
            top_beam_tilt=_with_default(ini, "top_beam_tilt", 0.0),
        ),
    )
    fault = find_fault(settings)
    if fault:
        raise InputError(ini.source, fault[1], place=_place_of(ini, fault[0]))
    return settings


def _settings_text(path: str | PathLike[str]) -> IniText:
    """Return the ini file, if it holds settings."""
    ini = read_ini(path)
    if ini.find("numpositions", section="global"):
        raise InputError(
            path, "holds marks, not settings", remedy="give SETTINGS first, then MARKS"
        )
    sections = {section.lower() for section in ini.sections}
    if not sections & {MASLOW.lower(), ADVANCED.lower()}:
        raise InputError(
            path,
            f"has no section [{MASLOW}]",
            remedy="give the groundcontrol.ini from your home folder or a machine.toml",
        )
    return ini


def _refuse_other_kinematics(ini: IniText) -> None:
    kind = _word(ini, "kinematics", {"triangular": "triangular", "quadrilateral": "quadrilateral"})
    if kind == "quadrilateral":
        raise InputError(
            ini.source,
            "Quadrilateral means a sled on two brackets, which the lab does not know",
            place=_place_of(ini, "kinematics"),
            remedy="if your sled hangs on a ring or a linkage, write kinematicsType = Triangular",
        )


def _feed(ini: IniText) -> str:
    return _word(ini, "feed", {"top": "top", "bottom": "bottom"})


def _word(ini: IniText, name: str, meaning: dict[str, str]) -> str:
    """Return a word out of a few, case ignored."""
    section, key = SOURCES[name]
    entry = ini.find(key, section=section)
    if entry is None:
        raise _missing(ini, name)
    if entry.value.lower() not in meaning:
        words = " or ".join(word.capitalize() for word in meaning)
        raise InputError(
            ini.source, f"'{entry.value}' is not known", place=entry.place, remedy=f"write {words}"
        )
    return meaning[entry.value.lower()]


def _needed(ini: IniText, name: str) -> float:
    """Return a number that the file must have."""
    value = _number(ini, name)
    if value is None:
        raise _missing(ini, name)
    return value


def _with_default(ini: IniText, name: str, default: float) -> float:
    """Return a number that the file may lack, and then is the default."""
    value = _optional(ini, name)
    return default if value is None else value


def _optional(ini: IniText, name: str) -> float | None:
    """Return a number that the file may lack; a misspelt key is not a missing key."""
    value = _number(ini, name)
    if value is not None:
        return value
    near = _misspelt(ini, SOURCES[name][1])
    if near:
        raise InputError(
            ini.source,
            f"unknown key; did you mean {SOURCES[name][1]}?",
            place=near,
            remedy="correct it or remove the line",
        )
    return None


def _number(ini: IniText, name: str) -> float | None:
    section, key = SOURCES[name]
    entry = ini.find(key, section=section)
    if entry is None:
        return None
    with naming(ini.source, entry.place):
        return number_in(entry.value)


def _missing(ini: IniText, name: str) -> Exception:
    section, key = SOURCES[name]
    near = _misspelt(ini, key)
    hint = f" (is {near} misspelt?)" if near else ""
    return InputError(
        ini.source,
        f"{key} is missing in [{section}]{hint}",
        remedy=f"add {key} = ... below [{section}]",
    )


def _misspelt(ini: IniText, key: str) -> str | None:
    """Return the place of an entry whose key is unknown and nearly this key."""
    taken = {known.lower() for _, known in SOURCES.values()}
    taken |= {known.lower() for known in NEIGHBOURS}
    others = {entry.key.lower(): entry for entry in ini.entries if entry.key.lower() not in taken}
    near = get_close_matches(key.lower(), others, 1, cutoff=0.85)
    return others[near[0]].place if near else None


def _place_of(ini: IniText, name: str) -> str:
    """Return the line and key a setting came from."""
    if name == "sled_weight":
        name = "holey_sled_weight"
    if name == "sprocket_radius":
        return "gearTeeth x chainPitch / (2 pi)"
    section, key = SOURCES[name]
    entry = ini.find(key, section=section)
    return entry.place if entry else f"[{section}] {key}"


# Settings back into a `groundcontrol.ini`: the keys that change, and what cannot be said there.

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
    """Return the keys that express these settings for the published firmware, in its units."""
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
    """Return this machine with the published firmware, which gets of it what its numbers
    can say.
    """
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
    """Return everything in our model that no key of the published firmware can hold."""
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


def changed_ini(original_path: str | PathLike[str], changes: Mapping[Key, float | str]) -> bytes:
    """Return the bytes of an ini file with some values replaced; equal numbers leave their line
    alone.
    """
    ini = read_ini(original_path)
    needed: dict[Key, str] = {}
    for (section, key), value in changes.items():
        place = f"[{section}] {key}"
        entry = ini.find(key, section=section)
        if isinstance(value, str):
            if any(sign in value for sign in "\r\n"):
                raise InputError(
                    original_path,
                    "the new value has a line break",
                    place=place,
                    remedy="write it on a single line",
                )
            new = value
        else:
            if not math.isfinite(value):
                raise InputError(original_path, f"{value} is not a usable number", place=place)
            new = number_for_firmware(value)
        if entry is None or not same_number(entry.value, value):
            needed[section, key] = new
    text = with_values(ini, needed)
    parse_ini(text, source=str(original_path))
    return text.encode("utf-8", "surrogateescape")


def number_for_firmware(value: float) -> str:
    """Return a number as the published firmware can read it: no exponent, at most nine digits."""
    if abs(value) >= 10**MOST_DIGITS:
        raise ValueError(f"{value:g} has more digits than the published firmware can read")
    if abs(value) < NOTHING:
        return "0"
    text = f"{Decimal(f'{value:.{MOST_DIGITS}g}'):f}"
    return text.rstrip("0").rstrip(".") if "." in text else text


def same_number(old: str, new: float | str) -> bool:
    """Return whether a value of the file says the same already."""
    if isinstance(new, str):
        return old == new
    try:
        return math.isclose(float(old), new, rel_tol=SAME, abs_tol=NOTHING)
    except ValueError:
        return False
