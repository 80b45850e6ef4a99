"""Reading and writing settings, whatever the file's form; the front door to this room.

A machine's settings come as the `groundcontrol.ini` or `webcontrol.json` of the published programs,
or as a `machine.toml`.
"""

import json
import re
from collections.abc import Iterator, Mapping
from dataclasses import replace
from hashlib import sha256
from pathlib import Path
from typing import Any

from plumb.settings.ini import (
    Key,
    changed_ini,
    new_value,
    published_settings,
    read_settings_ini,
    same_number,
)
from plumb.settings.machine import MachineSettings, SettingsFile
from plumb.settings.toml import Known, read_machine_toml
from plumb.text.errors import InputError, Source
from plumb.text.files import CODE, parsed, read_bytes, read_text
from plumb.text.ini import IniEntry, IniText, parse_ini

WEBCONTROL_ENDING = ".json"


def read_settings(path: Source, *, known: Known = None) -> MachineSettings:
    """Return the settings in a file of a client or ours; known lists each effect's parameters."""
    file = SettingsFile(Path(path).name, sha256(read_bytes(path)).hexdigest())
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
    if Path(original_path).suffix.lower() == WEBCONTROL_ENDING:
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
