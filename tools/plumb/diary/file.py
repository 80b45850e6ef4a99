"""The file of a diary: `diary.jsonl` in the machine's folder, a line of JSON for each entry.

Entries are only added. Each line begins with a digest of its rest, so a line that was cut in the
middle is noticed, and the next entry begins on a line by itself. Writers wait for each other.
"""

from __future__ import annotations

import fcntl
import json
import math
import os
from collections.abc import Mapping
from dataclasses import dataclass
from datetime import datetime
from hashlib import sha256
from os import PathLike
from pathlib import Path
from typing import Any

from plumb.text.errors import refusal
from plumb.text.files import opened

NAME = "diary.jsonl"
DIGITS = 16  # of a line's digest
HEAD = '{"digest": "%s", '  # what a line begins with

Folder = str | PathLike[str]


@dataclass(frozen=True)
class Entry:
    """What was written down at a time."""

    kind: str  # "fit", "numbers", "program", "recheck", "slip" or "home"
    at: datetime  # with its offset from UTC
    content: Mapping[str, Any]  # lists, numbers and words as JSON has them


@dataclass(frozen=True)
class Diary:
    """All that a machine's folder remembers, the oldest entry first."""

    path: Path
    entries: tuple[Entry, ...]
    spoilt: tuple[int, ...] = ()  # lines that cannot be read, counted from 1

    def of_kind(self, *kinds: str) -> tuple[Entry, ...]:
        """The entries of these kinds."""
        return tuple(entry for entry in self.entries if entry.kind in kinds)


def diary_path(folder: Folder) -> Path:
    """Where the diary of a folder is, or would be."""
    return Path(folder) / NAME


def has_diary(folder: Folder) -> bool:
    """Whether somebody has begun a diary in this folder."""
    return diary_path(folder).is_file()


def append(
    folder: Folder, kind: str, content: Mapping[str, Any], *, at: datetime | None = None
) -> Entry:
    """Add an entry to the diary of a folder; it is on the disk when this returns.

    Raises InputError where nothing can be written.
    """
    entry = Entry(kind, at or datetime.now().astimezone().replace(microsecond=0), plain(content))
    path = diary_path(folder)
    try:
        _add_line(path, _line(entry).encode())
    except OSError as error:
        why = f"cannot be written ({error.strerror})"
        raise refusal(path, why, remedy="check the rights of the folder, and its space") from None
    return entry


def read_diary(folder: Folder) -> Diary:
    """The diary of a folder; empty if nobody has begun it. Raises InputError."""
    path = diary_path(folder)
    try:
        with os.fdopen(opened(path, os.O_RDONLY, follows=False), "rb") as file:
            content = file.read()
    except FileNotFoundError:
        return Diary(path, ())
    except OSError as error:
        raise refusal(
            path, f"cannot be read ({error.strerror})", remedy="check its rights"
        ) from None
    entries, spoilt = list[Entry](), list[int]()
    for number, line in enumerate(content.split(b"\n"), start=1):
        entry = _entry(line)
        if entry:
            entries.append(entry)
        elif line.strip():
            spoilt.append(number)
    return Diary(path, tuple(entries), tuple(spoilt))


def plain(value: Any) -> Any:
    """A value in the types of JSON; what is not a finite number is None."""
    if isinstance(value, Mapping):
        return {str(key): plain(item) for key, item in value.items()}
    if isinstance(value, (list, tuple)):
        return [plain(item) for item in value]
    if hasattr(value, "tolist"):  # numpy's arrays and numbers
        return plain(value.tolist())
    if isinstance(value, float) and not math.isfinite(value):
        return None
    return value


def _line(entry: Entry) -> str:
    head = {"kind": entry.kind, "at": entry.at.isoformat()}
    rest = json.dumps({**head, **entry.content}, allow_nan=False)[1:]
    return HEAD % _digest(rest.encode()) + rest + "\n"


def _digest(rest: bytes) -> str:
    return sha256(rest).hexdigest()[:DIGITS]


def _entry(line: bytes) -> Entry | None:
    """What a line says; None if it is cut or changed."""
    length = len(HEAD % ("0" * DIGITS))
    head, rest = line[:length], line[length:]
    if head != (HEAD % _digest(rest)).encode():
        return None
    try:
        content = json.loads(b"{" + rest)
        return Entry(content.pop("kind"), datetime.fromisoformat(content.pop("at")), content)
    except (ValueError, KeyError, TypeError):
        return None


def _add_line(path: Path, line: bytes) -> None:
    """Put a line at the end, behind a cut line if there is such; all of it reaches the disk."""
    is_new = not path.exists()
    handle = opened(path, os.O_RDWR | os.O_CREAT | os.O_APPEND, follows=False)
    try:
        fcntl.flock(handle, fcntl.LOCK_EX)
        length = os.fstat(handle).st_size
        is_cut = length > 0 and os.pread(handle, 1, length - 1) != b"\n"
        rest = memoryview(b"\n" + line if is_cut else line)
        while rest:
            rest = rest[os.write(handle, rest) :]
        os.fsync(handle)
    finally:
        os.close(handle)
    if is_new:
        _keep_name(path.parent)


def _keep_name(folder: Path) -> None:
    """Let the folder remember a new file even if the power fails now."""
    handle = os.open(folder, os.O_RDONLY)
    try:
        os.fsync(handle)
    finally:
        os.close(handle)
