"""Reading and writing settings, whatever the file's form; the front door to this room.

A machine's settings come as the `groundcontrol.ini` of the published programs or as a
`machine.toml`.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from dataclasses import replace
from hashlib import sha256
from os import PathLike
from pathlib import Path

from plumb.settings.groundcontrol import (
    GroundControlChanges,
    Unsaid,
    changed_ini,
    groundcontrol_changes,
    published_machine,
    write_groundcontrol_ini,
)
from plumb.settings.ini import read_settings_ini
from plumb.settings.machine import MachineSettings, PublishedSettings, SettingsFile
from plumb.settings.toml import machine_toml, read_machine_toml, write_machine_toml
from plumb.text.errors import refusal
from plumb.text.files import read_bytes

__all__ = [
    "GroundControlChanges",
    "MachineSettings",
    "PublishedSettings",
    "Unsaid",
    "changed_ini",
    "groundcontrol_changes",
    "machine_toml",
    "published_machine",
    "read_settings",
    "write_groundcontrol_ini",
    "write_machine_toml",
]


def read_settings(
    path: str | PathLike[str], *, known: Mapping[str, Sequence[str]] | None = None
) -> MachineSettings:
    """The settings in a groundcontrol.ini or machine.toml; known lists each effect's parameters."""
    file = SettingsFile(Path(path).name, sha256(read_bytes(path)).hexdigest())
    return replace(_read(path, known), file=file)


def _read(path: str | PathLike[str], known: Mapping[str, Sequence[str]] | None) -> MachineSettings:
    text = read_bytes(path).decode("utf-8-sig", "replace").lstrip()
    if text.startswith("{"):
        raise refusal(path, "is a JSON file", remedy="give a groundcontrol.ini or a machine.toml")
    if re.search(r"(?im)^\s*\[(maslow|advanced) settings\]|^\s*numpositions\s*[=:]", text):
        return read_settings_ini(path)
    ours = re.search(r"(?m)^\s*\[(sheet|frame|effects\..*|published|\[mark\])\]", text)
    if ours or Path(path).suffix.lower() == ".toml":
        return read_machine_toml(path, known=known)
    if Path(path).suffix.lower() == ".ini":
        return read_settings_ini(path)
    raise refusal(
        path,
        "is none of the known forms of settings",
        remedy="give a groundcontrol.ini or a machine.toml",
    )
