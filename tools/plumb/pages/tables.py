"""What generated pages share: tables, numbers, and writing or checking files."""

from __future__ import annotations

import sys
from collections.abc import Mapping, Sequence
from pathlib import Path

from plumb.text.errors import InputError
from plumb.text.files import write_all


def markdown_table(header: Sequence[str], rows: Sequence[Sequence[object]]) -> str:
    """A table in Markdown."""
    lines = [header, ["---"] * len(header), *rows]
    return "\n".join("| " + " | ".join(str(cell) for cell in line) + " |" for line in lines)


def mm(value: float | None) -> str:
    """A length [mm] with two decimals; a dash where there is none."""
    if value is None:
        return "-"
    return f"{value + 0.0:.2f}"


def percent(strain: float | None) -> str:
    """A strain in percent with two decimals; a dash where there is none."""
    if strain is None:
        return "-"
    return f"{100 * strain + 0.0:.2f}"


def file_writer(root: Path, texts: Mapping[str, str], *, check: bool, command: str) -> int:
    """Write all files below the root, or check them; 0 done, 1 stale, 2 refused."""
    if check:
        stale = [
            name
            for name, text in texts.items()
            if not (root / name).is_file() or (root / name).read_bytes() != text.encode()
        ]
        if stale:
            print(f"{', '.join(stale)}: stale; run .venv/bin/python -m {command}")
        return int(bool(stale))
    try:
        for name in texts:
            (root / name).parent.mkdir(parents=True, exist_ok=True)
        write_all({str(root / name): text.encode() for name, text in texts.items()})
    except (InputError, OSError) as error:
        print(f"{command}: {error}", file=sys.stderr)
        return 2
    return 0
