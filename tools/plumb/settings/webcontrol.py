"""`webcontrol.json`: the settings of WebControl, by the sections and keys of a groundcontrol.ini.

WebControl writes the file with Python's json; a changed copy differs in the changed values alone.
"""

from __future__ import annotations

import json
import math
from collections.abc import Iterator, Mapping
from os import PathLike
from typing import Any

from plumb.settings.ini import Key, number_for_firmware, same_number
from plumb.text.errors import InputError
from plumb.text.files import read_text
from plumb.text.ini import IniEntry, IniText


def read_webcontrol(path: str | PathLike[str]) -> IniText:
    """Return the settings of a webcontrol.json as entries of an ini file."""
    return parse_webcontrol(read_text(path), source=str(path))


def parse_webcontrol(text: str, *, source: str) -> IniText:
    """Return the entries of the text of a webcontrol.json."""
    lines = tuple(text.splitlines(keepends=True))
    entries = [
        IniEntry(section, str(option["key"]), str(option["value"]), _line_of(option, lines))
        for section, option in _options(_loaded(text, source))
    ]
    return IniText(source, lines, tuple(entries))


def changed_webcontrol(
    original_path: str | PathLike[str], changes: Mapping[Key, float | str]
) -> bytes:
    """Return the bytes of a webcontrol.json with some values replaced; equal numbers stay as they
    are.
    """
    text = read_text(original_path)
    document = _loaded(text, str(original_path))
    for (section, key), value in changes.items():
        if not isinstance(value, str) and not math.isfinite(value):
            raise InputError(
                original_path, f"{value} is not a usable number", place=f"{section}, {key}"
            )
        same = [
            option
            for place, option in _options(document)
            if place == section and str(option["key"]).lower() == key.lower()
        ]
        new = value if isinstance(value, str) else number_for_firmware(value)
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
    try:
        document = json.loads(text)
    except ValueError as error:
        raise InputError(source, f"is not valid JSON: {error}", remedy="mend that line") from None
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
