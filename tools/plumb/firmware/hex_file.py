"""Programs for the Mega as HEX files of Intel's form."""

from __future__ import annotations

from contextlib import suppress
from io import StringIO
from pathlib import Path

from intelhex import IntelHex, IntelHexError

from plumb.text.errors import InputError
from plumb.text.files import read_text

MOST = 0x3E000  # [bytes] of the Mega's flash below its bootloader


def hex_bytes(path: str | Path) -> bytes:
    """Return the bytes of a HEX file from its first address on; raises InputError."""
    records = IntelHex()
    with suppress(IntelHexError):
        records.loadhex(StringIO(read_text(path)))
    content = bytes(records.tobinarray())
    if not content:
        raise InputError(path, "is not a HEX file with a program", remedy="give that of a build")
    return content


def program_in(path: Path) -> bytes:
    """Return the program of a HEX file; InputError also where it does not fit below the Mega's
    bootloader.
    """
    program = hex_bytes(path)
    if len(program) > MOST:
        raise InputError(path, f"is larger than the Mega's flash ({len(program)} bytes)")
    return program
