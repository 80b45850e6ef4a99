"""A file that the guide replaces: what was in it stays in the folder under another name."""

from __future__ import annotations

from itertools import count
from pathlib import Path

from plumb.text.files import read_bytes, write_whole


def keep_other(path: Path, content: bytes) -> None:
    """Keep what is in a file if it is not this content, as NAME-old, NAME-old-2 and so on."""
    if not path.is_file() or path.stat().st_size == 0 or read_bytes(path) == content:
        return
    before = read_bytes(path)
    names = (f"{path.stem}-old{'' if number == 1 else f'-{number}'}" for number in count(1))
    for each in (path.with_name(f"{name}{path.suffix}") for name in names):
        if not each.exists():
            return write_whole(each, before)
        if each.is_file() and read_bytes(each) == before:
            return
