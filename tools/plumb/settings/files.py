"""Settings in the files of the published programs, read and written back; a `machine.toml` is read
from here too.
"""

import hashlib
import json
import math
import os
import re
from collections.abc import Iterator, Mapping
from contextlib import suppress
from dataclasses import dataclass, replace
from decimal import Decimal
from difflib import get_close_matches
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, BeforeValidator, Field

from plumb.settings.machine import (
    PUBLISHED_LIMITS,
    SLED_WEIGHT,
    Feed,
    Known,
    MachineSettings,
    PublishedSettings,
    SettingsFile,
    holds_marks,
    is_tuned,
    radius_in_published,
    read_machine_toml,
    refuse_impossible,
    tuned_numbers,
)
from plumb.text.errors import InputError, Source
from plumb.text.files import (
    CODE,
    IniEntry,
    IniText,
    parse_ini,
    parsed,
    read_bytes,
    read_ini,
    read_text,
    with_values,
)
from plumb.text.tables import read_table
from plumb.text.values import number_in

Key = tuple[str, str]  # section and key of a file
MASLOW, ADVANCED = "Maslow Settings", "Advanced Settings"
Typed = Annotated[float, BeforeValidator(number_in)]


def _word(value: str) -> str:
    if value.lower() == "quadrilateral":
        raise ValueError(
            "Quadrilateral means a sled on two brackets, which the lab does not know; "
            "if your sled hangs on a ring or a linkage, write kinematicsType = Triangular"
        )
    return value.lower()


def _key(section: str, name: str, usual: Any = ...) -> Any:
    """Return where a setting is in the file; `usual`: its value in a file that lacks it."""
    return Field(usual, title=name, description=section)


class Published(BaseModel):
    """The machine according to the file of a client.

    Keys that have a usual value came later or belong to one program only.
    """

    kinematics: Annotated[Literal["triangular"], BeforeValidator(_word)] = _key(
        ADVANCED, "kinematicsType"
    )
    motor_gap: Typed = _key(MASLOW, "motorSpacingX")
    sheet_width: Typed = _key(MASLOW, "bedWidth")
    sheet_height: Typed = _key(MASLOW, "bedHeight")
    motor_offset: Typed = _key(MASLOW, "motorOffsetY")
    rotation_radius: Typed = _key(ADVANCED, "rotationRadius")
    gear_teeth: Typed = _key(ADVANCED, "gearTeeth")
    link_pitch: Typed = _key(ADVANCED, "chainPitch")
    chain_sag_correction: Typed = _key(ADVANCED, "chainSagCorrection")
    feed: Annotated[Feed, BeforeValidator(_word)] = _key(ADVANCED, "chainOverSprocket")
    left_tolerance: Typed = _key(ADVANCED, "leftChainTolerance", 0.0)
    right_tolerance: Typed = _key(ADVANCED, "rightChainTolerance", 0.0)
    chain_length: Typed = _key(ADVANCED, "chainLength", 3360.0)
    chain_elasticity: Typed | None = _key(ADVANCED, "chainElasticity", None)
    holey_sled_weight: Typed | None = _key(MASLOW, "sledWeight", None)
    top_beam_tilt: Typed = _key(ADVANCED, "topBeamTilt", 0.0)


# Which key of the file each of our settings comes from.
SOURCES: dict[str, Key] = {
    name: (str(field.description), str(field.title))
    for name, field in Published.model_fields.items()
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


def read_settings_ini(path: Source) -> MachineSettings:
    """Return the settings of a groundcontrol.ini; it belongs to the stock controller."""
    ini = read_ini(path)
    if ini.find("numpositions", section="global"):
        raise holds_marks(path)
    sections = {section.lower() for section in ini.sections}
    if not sections & {MASLOW.lower(), ADVANCED.lower()}:
        raise InputError(
            path,
            f"has no section [{MASLOW}]",
            remedy="give the groundcontrol.ini from your home folder or a machine.toml",
        )
    return published_settings(ini)


def published_settings(ini: IniText) -> MachineSettings:
    """Return the settings that the entries of a client's file hold."""
    entries = _entries(ini)
    said = read_table(
        Published,
        {name: entry.value for name, entry in entries.items()},
        ini.source,
        place=lambda path: entries[str(path[0])].place,
    )
    numbers = said.model_dump()
    weight = said.holey_sled_weight
    settings = MachineSettings(
        motor_gap=said.motor_gap,
        motor_height=said.sheet_height / 2 + said.motor_offset,
        rotation_radius=said.rotation_radius,
        sheet_width=said.sheet_width,
        sheet_height=said.sheet_height,
        feed=said.feed,
        sprocket_radius=said.gear_teeth * said.link_pitch / (2 * math.pi),
        sled_weight=weight if weight is not None and weight > 0 else SLED_WEIGHT,
        controller="stock",
        published=PublishedSettings(**{name: numbers[name] for name in PUBLISHED_LIMITS}),
    )

    def place(name: str) -> str:
        if name == "sprocket_radius":
            return "gearTeeth x chainPitch / (2 pi)"
        return entries["holey_sled_weight" if name == "sled_weight" else name].place

    refuse_impossible(settings, ini.source, place)
    return settings


def _entries(ini: IniText) -> dict[str, IniEntry]:
    """Return the entries of our settings; a misspelt key is not a missing key."""
    entries = {}
    for name, (section, key) in SOURCES.items():
        entry = ini.find(key, section=section)
        near = None if entry else _misspelt(ini, key)
        if near:
            what = f"unknown key; did you mean {key}?"
            raise InputError(ini.source, what, place=near, remedy="correct it or remove the line")
        if entry or Published.model_fields[name].is_required():
            entries[name] = ini.needed(key, section=section)
    return entries


def _misspelt(ini: IniText, key: str) -> str | None:
    """Return the place of an entry whose key is unknown and nearly this key."""
    taken = {known.lower() for _, known in SOURCES.values()}
    taken |= {known.lower() for known in NEIGHBOURS}
    others = {entry.key.lower(): entry for entry in ini.entries if entry.key.lower() not in taken}
    near = get_close_matches(key.lower(), others, 1, cutoff=0.85)
    return others[near[0]].place if near else None


# Settings back into a `groundcontrol.ini`: the keys that change, and what cannot be said there.

# The published firmware collects all digits of a number in one 32-bit integer and knows no
# exponent; more digits would overflow silently.
MOST_DIGITS = 9
SAME = 1e-9  # relative; two values closer than this are the same in nine digits
NOTHING = 1e-15  # smaller numbers mean zero for every setting there is


@dataclass(frozen=True)
class GroundControlChanges:
    """Values by (section, key) as a groundcontrol.ini holds them, and what is lost on the way."""

    values: dict[Key, float]
    unsaid: tuple[str, ...]  # a sentence each


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
    return GroundControlChanges(values=values, unsaid=tuple(_unsaid(ours)))


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
        published=PublishedSettings(**chains),
    )


def _unsaid(ours: MachineSettings) -> Iterator[str]:
    """Yield everything in our model that no key of the published firmware can hold."""
    if ours.motor_center_x:
        yield f"the motors sit {ours.motor_center_x:g} mm off the middle: move the sheet instead"
    for name, parameters in ours.effects.items():
        for parameter, value in parameters.items():
            if value and not is_tuned(name, parameter):
                yield f"{name} {parameter} = {value:g} has no setting in the published firmware"


def changed_ini(original_path: Source, changes: Mapping[Key, float | str]) -> bytes:
    """Return the bytes of an ini file with some values replaced; equal numbers leave their line
    alone.
    """
    ini = read_ini(original_path)
    needed: dict[Key, str] = {}
    for (section, key), value in changes.items():
        new = new_value(value, original_path, place=f"[{section}] {key}")
        entry = ini.find(key, section=section)
        if entry is None or not same_number(entry.value, value):
            needed[section, key] = new
    text = with_values(ini, needed)
    parse_ini(text, source=str(original_path))
    return text.encode("utf-8", "surrogateescape")


def new_value(value: float | str, source: Source, *, place: str) -> str:
    """Return a value as a client's file has it. Raises InputError for what it cannot hold."""
    if isinstance(value, str):
        if any(sign in value for sign in "\r\n"):
            what = "the new value has a line break"
            raise InputError(source, what, place=place, remedy="write it on a single line")
        return value
    if not math.isfinite(value):
        raise InputError(source, f"{value} is not a usable number", place=place)
    return number_for_firmware(value)


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


# Settings whatever the file's form: `groundcontrol.ini`, `webcontrol.json` or `machine.toml`.


def read_settings(path: Source, *, known: Known = None) -> MachineSettings:
    """Return the settings in a file of a client or ours; known lists each effect's parameters."""
    file = SettingsFile(Path(path).name, hashlib.sha256(read_bytes(path)).hexdigest())
    return replace(_read(path, known), file=file)


def _read(path: Source, known: Known) -> MachineSettings:
    text = read_bytes(path).decode("utf-8-sig", "replace").lstrip()
    if text.startswith("{"):
        return published_settings(parse_webcontrol(text, source=str(path)))
    if re.search(r"(?im)^\s*\[(maslow|advanced) settings\]|^\s*numpositions\s*[=:]", text):
        return read_settings_ini(path)
    ours = re.search(r"(?m)^\s*\[(sheet|frame|effects\..*|published|\[mark\])\]", text)
    if ours or Path(path).suffix.lower() == ".toml":
        return read_machine_toml(path, known=known)
    if Path(path).suffix.lower() == ".ini":
        return read_settings_ini(path)
    if CODE.search(text):
        why = "holds a program, not settings"
        raise InputError(path, why, remedy="give JOB first, then SETTINGS")
    raise InputError(
        path,
        "is none of the known forms of settings",
        remedy="give a groundcontrol.ini, a webcontrol.json or a machine.toml",
    )


def changed_client_file(original_path: Source, changes: Mapping[Key, float | str]) -> bytes:
    """Return the bytes of a client's file with some values replaced and all else as it was."""
    if Path(original_path).suffix.lower() == ".json":
        return changed_webcontrol(original_path, changes)
    return changed_ini(original_path, changes)


def parse_client_file(content: bytes, *, source: str) -> IniText:
    """Return the entries of a client's file."""
    text = content.decode("utf-8-sig", "surrogateescape")
    is_json = text.lstrip().startswith("{")
    return (parse_webcontrol if is_json else parse_ini)(text, source=source)


# `webcontrol.json`: the settings of WebControl, by the sections and keys of a groundcontrol.ini.


def parse_webcontrol(text: str, *, source: str) -> IniText:
    """Return the entries of the text of a webcontrol.json."""
    lines = tuple(text.splitlines(keepends=True))
    entries = [
        IniEntry(section, str(option["key"]), str(option["value"]), _line_of(option, lines))
        for section, option in _options(_loaded(text, source))
    ]
    return IniText(source, lines, tuple(entries))


def changed_webcontrol(original_path: Source, changes: Mapping[Key, float | str]) -> bytes:
    """Return the bytes of a webcontrol.json with some values replaced; equal numbers stay as they
    are.
    """
    text = read_text(original_path)
    document = _loaded(text, str(original_path))
    for (section, key), value in changes.items():
        new = new_value(value, original_path, place=f"{section}, {key}")
        same = [
            option
            for place, option in _options(document)
            if place == section and str(option["key"]).lower() == key.lower()
        ]
        if not same:
            if section not in document:
                raise InputError(original_path, f"has no section {section}")
            document[section].append({"key": key, "type": "string", "value": new})
        for option in same:
            if not same_number(str(option["value"]), value):
                option["value"] = new if isinstance(option["value"], str) else float(new)
    return json.dumps(document, indent=4, ensure_ascii=False).encode()


def _loaded(text: str, source: str) -> dict[str, Any]:
    """Return the document, if it is one of WebControl."""
    document = parsed(source, text, json.loads, "JSON")
    sections = document.values() if isinstance(document, dict) else ()
    if not any(isinstance(section, list) for section in sections):
        raise InputError(
            source,
            "is a JSON file, but not one of WebControl",
            remedy="give a webcontrol.json, a groundcontrol.ini or a machine.toml",
        )
    return dict(document)


def _options(document: dict[str, Any]) -> Iterator[tuple[str, dict[str, Any]]]:
    """Section and option of each setting that has a value."""
    for section, options in document.items():
        for option in options if isinstance(options, list) else ():
            if isinstance(option, dict) and {"key", "value"} <= option.keys():
                yield section, option


def _line_of(option: dict[str, Any], lines: tuple[str, ...]) -> int:
    """Return the line with the key of an option; the first line if it is written in another way."""
    wanted = f'"key": {json.dumps(option["key"])}'
    return next((number for number, line in enumerate(lines, 1) if wanted in line), 1)


# The settings in force while marks are cut: their file, and a digest of what moves the sled.
# A form names them, and a program names its form.
#
# GroundControl rewrites its file whenever a window is moved, so only the numbers count that say
# where the sled hangs.


# Keys of a client's file that say how long the chains are for a place; one bounds a search alone.
KEYS = {key.lower() for name, (_, key) in SOURCES.items() if name != "chain_length"}
ENDINGS = (".ini", ".json", ".toml")  # of settings
LONGEST = 60  # characters of a form's name in a comment
FORM = re.compile(r"^\(form: (.+)\)$", re.MULTILINE)


def cut_with_lines(settings: Source | None, form: str) -> str:
    """Return the lines of a form at that path that name the settings' file and keep its digest."""
    if settings is None:
        return ""
    name = json.dumps(_near(settings, form))
    return f'\ncut_with = {name}\ncut_with_digest = "{digest_of(settings)}"'


def with_form(program: str, form: str, path: str) -> str:
    """Return a program at that path with a comment that names the form for its readings, so that
    whoever sends it knows what it is to be cut with; without, where no comment can hold the name.
    """
    near = _near(form, path)
    if not near.isascii() or not near.isprintable() or set(near) & set("()") or len(near) > LONGEST:
        return program
    first, *rest = program.split("\n", 1)
    return "\n".join([first, f"(form: {near})", *rest])


def _near(path: Source, other: str) -> str:
    """Return how a file beside the other would name a path: whole if it is on another drive."""
    try:
        near = os.path.relpath(path, os.path.dirname(os.path.abspath(other)))
    except ValueError:
        near = os.path.abspath(path)
    return near.replace(os.sep, "/")


def form_of(program: str, path: str) -> str | None:
    """Return the form for the readings of a program at that path; None if it names none."""
    named = FORM.search(program)
    return os.path.join(os.path.dirname(path), named[1]) if named else None


def digest_of(settings: Source) -> str:
    """Return the SHA-256 of what a client's file says of the chains, or of a whole machine.toml."""
    content = read_bytes(settings)
    try:
        entries = parse_client_file(content, source=os.fspath(settings)).entries
    except InputError:
        entries = ()
    said = {
        entry.key.lower(): _plain(entry.value) for entry in entries if entry.key.lower() in KEYS
    }
    text = json.dumps(said, sort_keys=True).encode() if said else content
    return hashlib.sha256(text).hexdigest()


def settings_as_they_were(named: Path, digest: str) -> Path | None:
    """Return the file with the settings that a form names: the named, or if that says something
    else by now, a file next to it that says what it said. None if nobody kept them.
    """
    if not digest or _says(named, digest):
        return named
    for other in sorted(named.parent.iterdir()) if named.parent.is_dir() else ():
        if other.suffix in ENDINGS and not other.is_symlink() and _says(other, digest):
            return other
    return None if named.exists() else named


def _says(path: Path, digest: str) -> bool:
    with suppress(InputError):
        return path.is_file() and digest_of(path) == digest
    return False


def _plain(value: str) -> str:
    """Return a value by its meaning: 463 is 463.0, and Top is top."""
    try:
        return repr(float(value))
    except ValueError:
        return value.strip().lower()
