"""Reading and writing settings, whatever the file's form; the front door to this room.

A machine's settings come as the `groundcontrol.ini` or `webcontrol.json` of the published programs,
or as a `machine.toml`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from hashlib import sha256
from os import PathLike
from pathlib import Path

from plumb.settings.ini import (
    GroundControlChanges,
    Key,
    Unsaid,
    changed_ini,
    groundcontrol_changes,
    published_machine,
    published_settings,
    read_settings_ini,
    write_groundcontrol_ini,
)
from plumb.settings.machine import MachineSettings, PublishedSettings, SettingsFile
from plumb.settings.toml import machine_toml, read_machine_toml, write_machine_toml
from plumb.settings.webcontrol import changed_webcontrol, parse_webcontrol, read_webcontrol
from plumb.text.errors import InputError
from plumb.text.files import read_bytes
from plumb.text.ini import IniText, parse_ini

WEBCONTROL_ENDING = ".json"

__all__ = [
    "GroundControlChanges",
    "MachineSettings",
    "PublishedSettings",
    "Unsaid",
    "changed_client_file",
    "changed_ini",
    "groundcontrol_changes",
    "machine_toml",
    "parse_client_file",
    "published_machine",
    "read_settings",
    "write_groundcontrol_ini",
    "write_machine_toml",
]


def read_settings(
    path: str | PathLike[str], *, known: Mapping[str, Sequence[str]] | None = None
) -> MachineSettings:
    """Return the settings in a file of a client or ours; known lists each effect's parameters."""
    file = SettingsFile(Path(path).name, sha256(read_bytes(path)).hexdigest())
    return replace(_read(path, known), file=file)


def _read(path: str | PathLike[str], known: Mapping[str, Sequence[str]] | None) -> MachineSettings:
    text = read_bytes(path).decode("utf-8-sig", "replace").lstrip()
    if text.startswith("{"):
        return published_settings(read_webcontrol(path))
    if re.search(r"(?im)^\s*\[(maslow|advanced) settings\]|^\s*numpositions\s*[=:]", text):
        return read_settings_ini(path)
    ours = re.search(r"(?m)^\s*\[(sheet|frame|effects\..*|published|\[mark\])\]", text)
    if ours or Path(path).suffix.lower() == ".toml":
        return read_machine_toml(path, known=known)
    if Path(path).suffix.lower() == ".ini":
        return read_settings_ini(path)
    raise InputError(
        path,
        "is none of the known forms of settings",
        remedy="give a groundcontrol.ini, a webcontrol.json or a machine.toml",
    )


def changed_client_file(original_path: str, changes: Mapping[Key, float | str]) -> bytes:
    """Return the bytes of a client's file with some values replaced and all else as it was."""
    if original_path.lower().endswith(WEBCONTROL_ENDING):
        return changed_webcontrol(original_path, changes)
    return changed_ini(original_path, changes)


def parse_client_file(content: bytes, *, source: str) -> IniText:
    """Return the entries of a client's file."""
    if source.lower().endswith(WEBCONTROL_ENDING):
        return parse_webcontrol(content.decode("utf-8"), source=source)
    return parse_ini(content.decode("utf-8", "surrogateescape"), source=source)
