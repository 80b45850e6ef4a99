"""The settings in force while marks are cut: their file, and a digest of what moves the sled.
A form names them, and a program names its form.

GroundControl rewrites its file whenever a window is moved, so only the numbers count that say where
the sled hangs.
"""

import hashlib
import json
import os
import re
from contextlib import suppress
from pathlib import Path

from plumb.settings.files import SOURCES, parse_client_file
from plumb.text.errors import InputError, Source
from plumb.text.files import read_bytes

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
