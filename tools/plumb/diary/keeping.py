"""Keeping the diary for the commands and the lab: which folder it is in, and what if it fails.

A result that is written already stays written, whether or not its entry could be added.
"""

from __future__ import annotations

from collections.abc import Mapping
from pathlib import Path
from typing import Any

from plumb.diary.file import append, has_diary
from plumb.text.errors import InputError


def folder_of(path: str) -> Path | None:
    """The machine's folder, or that of a file in it; None for a device and what is not there."""
    place = Path(path)
    if place.is_dir():
        return place
    return place.parent if place.is_file() else None


def keep(path: str, kind: str, content: Mapping[str, Any], *, begin: bool = True) -> str:
    """Add an entry to the diary of a folder, or next to a file; a sentence if that failed, else ''.

    begin: whether to begin a diary where there is none.
    """
    folder = folder_of(path)
    if folder is None or not (begin or has_diary(folder)):
        return ""
    try:
        append(folder, kind, content)
    except InputError as error:
        return f"nothing was added to the diary: {error}"
    return ""
