"""Programs for the Mega as HEX files of Intel's form."""

from __future__ import annotations

from pathlib import Path

from intelhex import IntelHex, IntelHexError

from plumb.text.errors import InputError


def hex_bytes(path: str | Path) -> bytes:
    """Return the bytes of a HEX file from its first address on; raises InputError."""
    try:
        return bytes(IntelHex(str(path)).tobinarray())
    except OSError as error:
        raise InputError(path, error.strerror or "cannot be read") from None
    except (IntelHexError, UnicodeDecodeError):
        raise InputError(path, "is no HEX file", remedy="give the file of a build") from None
