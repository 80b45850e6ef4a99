"""Writes numbers to the machine; the old numbers go into a file, and the change into the diary."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from plumb.diary.entries import NUMBERS, numbers_entry
from plumb.diary.keeping import keep
from plumb.line.memory import Written, as_lines, version_of, write_numbers
from plumb.line.sender import Sender
from plumb.text.errors import InputError
from plumb.text.files import write_whole


def write_and_keep(
    sender: Sender, path: str, lines: list[str], *, back: bool = False
) -> tuple[Written, str, str]:
    """Write numbers and read them back; `back`: they are those from before `path` was sent.

    Comes with the file of the numbers that were replaced, named after `path`, and a sentence if
    the diary could not be kept. The file is there before a number is sent, so an InputError of a
    machine that took only some leaves a way back.
    """
    # What is taken back is not what was before it was sent: it keeps another name.
    when = "undone" if back else "before"
    kept = f"{Path(path).with_suffix('')}-{when}-{datetime.now():%Y-%m-%d-%H%M%S}.nc"
    try:
        written = write_numbers(
            sender, lines, keep=lambda before: write_whole(kept, as_lines(before).encode())
        )
    except InputError as error:
        if not Path(kept).exists():
            raise
        raise InputError(f"{error}. The old numbers are in {kept}") from None
    entry = numbers_entry(
        Path(path).name,
        lines,
        changed=written.changed,
        firmware=version_of(sender),
        kept=Path(kept).name,
        back=back,
    )
    return written, kept, keep(path, NUMBERS, entry)
