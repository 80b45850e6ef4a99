"""Which settings are in force while marks are cut: their file, and a digest of what moves the sled.

GroundControl rewrites its file whenever a window is moved, so only the numbers count that say where
the sled hangs.
"""

from __future__ import annotations

import configparser
import hashlib
import json
import os

from plumb.grid.webcontrol import as_ini, is_webcontrol

# Keys of a groundcontrol.ini, small, that say how long the chains are for a place.
KEYS = (
    "motorspacingx",
    "bedwidth",
    "bedheight",
    "motoroffsety",
    "rotationradius",
    "gearteeth",
    "chainpitch",
    "chainsagcorrection",
    "chainoversprocket",
    "kinematicstype",
    "leftchaintolerance",
    "rightchaintolerance",
    "chainelasticity",
    "sledweight",
    "topbeamtilt",
)


def cut_with_lines(settings: str | None, form: str) -> str:
    """The lines of a form at that path that name the settings' file and keep its digest."""
    if settings is None:
        return ""
    near = os.path.relpath(settings, os.path.dirname(os.path.abspath(form)))
    name = json.dumps(near.replace(os.sep, "/"))
    return f'\ncut_with = {name}\ncut_with_digest = "{digest_of(settings)}"'


def digest_of(settings: str | os.PathLike[str]) -> str:
    """The SHA-256 of what a client's file says of the chains, or of a whole machine.toml."""
    with open(settings, "rb") as file:
        content = file.read()
    parser = configparser.RawConfigParser(strict=False)
    try:
        text = content.decode("utf-8-sig")
        if is_webcontrol(text):
            parser = as_ini(text)
        else:
            parser.read_string(text)
    except (configparser.Error, ValueError, LookupError, TypeError, AttributeError):
        return hashlib.sha256(content).hexdigest()
    said = {
        key: _plain(value)
        for section in parser.sections()
        for key, value in parser.items(section)
        if key in KEYS
    }
    if not said:
        return hashlib.sha256(content).hexdigest()
    return hashlib.sha256(json.dumps(said, sort_keys=True).encode()).hexdigest()


def _plain(value: str) -> str:
    """A value by its meaning: 463 is 463.0, and Top is top."""
    try:
        return repr(float(value))
    except ValueError:
        return value.strip().lower()
