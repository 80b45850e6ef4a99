"""`groundcontrol.ini`: the settings that move the sled, read from the file of the published
programs."""

from __future__ import annotations

import math
from difflib import get_close_matches
from os import PathLike

from plumb.settings.limits import find_fault
from plumb.settings.machine import SLED_WEIGHT, MachineSettings, PublishedSettings
from plumb.text.errors import naming, refusal
from plumb.text.ini import IniText, read_ini
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
    """The settings of a groundcontrol.ini; it belongs to the stock controller."""
    return published_settings(_settings_text(path))


def published_settings(ini: IniText) -> MachineSettings:
    """The settings that the entries of a client's file hold."""
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
        raise refusal(ini.source, fault[1], place=_place_of(ini, fault[0]))
    return settings


def _settings_text(path: str | PathLike[str]) -> IniText:
    """The ini file, if it holds settings."""
    ini = read_ini(path)
    if ini.find("numpositions", section="global"):
        raise refusal(path, "holds marks, not settings", remedy="give SETTINGS first, then MARKS")
    sections = {section.lower() for section in ini.sections}
    if not sections & {MASLOW.lower(), ADVANCED.lower()}:
        raise refusal(
            path,
            f"has no section [{MASLOW}]",
            remedy="give the groundcontrol.ini from your home folder or a machine.toml",
        )
    return ini


def _refuse_other_kinematics(ini: IniText) -> None:
    kind = _word(ini, "kinematics", {"triangular": "triangular", "quadrilateral": "quadrilateral"})
    if kind == "quadrilateral":
        raise refusal(
            ini.source,
            "Quadrilateral means a sled on two brackets, which the lab does not know",
            place=_place_of(ini, "kinematics"),
            remedy="if your sled hangs on a ring or a linkage, write kinematicsType = Triangular",
        )


def _feed(ini: IniText) -> str:
    return _word(ini, "feed", {"top": "top", "bottom": "bottom"})


def _word(ini: IniText, name: str, meaning: dict[str, str]) -> str:
    """A word out of a few, case ignored."""
    section, key = SOURCES[name]
    entry = ini.find(key, section=section)
    if entry is None:
        raise _missing(ini, name)
    if entry.value.lower() not in meaning:
        words = " or ".join(word.capitalize() for word in meaning)
        raise refusal(
            ini.source, f"'{entry.value}' is not known", place=entry.place, remedy=f"write {words}"
        )
    return meaning[entry.value.lower()]


def _needed(ini: IniText, name: str) -> float:
    """A number that the file must have."""
    value = _number(ini, name)
    if value is None:
        raise _missing(ini, name)
    return value


def _with_default(ini: IniText, name: str, default: float) -> float:
    """A number that the file may lack, and then is the default."""
    value = _optional(ini, name)
    return default if value is None else value


def _optional(ini: IniText, name: str) -> float | None:
    """A number that the file may lack; a misspelt key is not a missing key."""
    value = _number(ini, name)
    if value is not None:
        return value
    near = _misspelt(ini, SOURCES[name][1])
    if near:
        raise refusal(
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
    return refusal(
        ini.source,
        f"{key} is missing in [{section}]{hint}",
        remedy=f"add {key} = ... below [{section}]",
    )


def _misspelt(ini: IniText, key: str) -> str | None:
    """The place of an entry whose key is unknown and nearly this key."""
    taken = {known.lower() for _, known in SOURCES.values()}
    taken |= {known.lower() for known in NEIGHBOURS}
    others = {entry.key.lower(): entry for entry in ini.entries if entry.key.lower() not in taken}
    near = get_close_matches(key.lower(), others, 1, cutoff=0.85)
    return others[near[0]].place if near else None


def _place_of(ini: IniText, name: str) -> str:
    """The line and key a setting came from."""
    if name == "sled_weight":
        name = "holey_sled_weight"
    if name == "sprocket_radius":
        return "gearTeeth x chainPitch / (2 pi)"
    section, key = SOURCES[name]
    entry = ini.find(key, section=section)
    return entry.place if entry else f"[{section}] {key}"
