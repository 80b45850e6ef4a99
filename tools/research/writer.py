"""What every generator of pages does with its texts: it writes them, or checks those there are."""

from __future__ import annotations

import argparse
import sys
from collections.abc import Callable, Mapping, Sequence
from pathlib import Path

from plumb.text.compiled import refuse_stale
from plumb.text.errors import InputError
from plumb.text.files import write_all


def write_pages(
    arguments: Sequence[str] | None,
    pages: Callable[[], Mapping[str, str]],
    *,
    command: str,
    pictures: str = "",
) -> int:
    """Write all pages, or check them with --check; 0 done, 1 stale, 2 refused.

    pages: the texts by their names below the project's root; command: the script that makes them;
    pictures: a folder of theirs alone, in which any other picture is left over.
    """
    parser = argparse.ArgumentParser(prog=command)
    parser.add_argument("--check", action="store_true", help="write nothing, exit 1 if stale")
    parser.add_argument("--folder", default=".", help="the project [%(default)s]")
    parsed = parser.parse_args(arguments)
    root = Path(parsed.folder)
    try:
        refuse_stale()
        texts = pages()
        left_over = _left_over(root, texts, pictures)
        if parsed.check:
            stale = [name for name, text in texts.items() if not _holds(root / name, text)]
            stale += left_over
            if stale:
                print(
                    f"{', '.join(stale)}: stale; run .venv/bin/python tools/research/{command}.py"
                )
            return int(bool(stale))
        for name in texts:
            (root / name).parent.mkdir(parents=True, exist_ok=True)
        write_all({str(root / name): text.encode() for name, text in texts.items()})
        for name in left_over:
            (root / name).unlink()
    except (InputError, OSError) as error:
        print(f"{command}: {error}", file=sys.stderr)
        return 2
    return 0


def _holds(path: Path, text: str) -> bool:
    return path.is_file() and path.read_bytes() == text.encode()


def _left_over(root: Path, texts: Mapping[str, str], pictures: str) -> list[str]:
    """Pictures that no page shows any more."""
    there = sorted((root / pictures).glob("*.svg")) if pictures else []
    return [name for name in (f"{pictures}/{path.name}" for path in there) if name not in texts]
