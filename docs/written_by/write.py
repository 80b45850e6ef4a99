"""Writes pages of docs/ that show what the code holds: `docs/written_by/write.py`.

With --check nothing is written; exit 1 if a page is not as it would be written.
"""

from __future__ import annotations

import argparse
import sys
from collections.abc import Sequence
from pathlib import Path

import effects_page
import real_data_page
import settings_page
from plumb.text.compiled import refuse_stale
from plumb.text.errors import InputError
from plumb.text.files import write_all

# Each gives texts by their names below the project's root.
PAGES = (effects_page.pages, real_data_page.pages, settings_page.pages)


def main(arguments: Sequence[str] | None = None) -> int:
    """Write the pages, or check them; 1 if one is stale, 2 if refused."""
    parser = argparse.ArgumentParser(prog="write.py", description=__doc__)
    parser.add_argument("--check", action="store_true", help="write nothing, exit 1 if stale")
    parser.add_argument("--folder", type=Path, default=Path(), help="the project [%(default)s]")
    parsed = parser.parse_args(arguments)
    root = parsed.folder
    try:
        refuse_stale()
        texts = {name: text for pages in PAGES for name, text in pages().items()}
        if parsed.check:
            stale = [name for name, text in texts.items() if not _holds(root / name, text)]
            if stale:
                print(f"{', '.join(stale)}: stale; run .venv/bin/python docs/written_by/write.py")
            return int(bool(stale))
        files = {name: text.encode() for name, text in texts.items()} | effects_page.pictures()
        for name in files:
            (root / name).parent.mkdir(parents=True, exist_ok=True)
        write_all({str(root / name): content for name, content in files.items()})
    except (InputError, OSError) as error:
        print(f"write.py: {error}", file=sys.stderr)
        return 2
    return 0


def _holds(path: Path, text: str) -> bool:
    return path.is_file() and path.read_bytes() == text.encode()


if __name__ == "__main__":
    sys.exit(main())
