"""Generated pages are as their generator would write them today."""

import subprocess
import sys
from collections.abc import Iterator, Sequence
from pathlib import Path

import tree

# Commands for the .venv's Python; with --check each exits 1 when its page is stale.
GENERATORS = [
    ["docs/written_by/write.py"],
    ["-m", "plumb.cli.answers"],
]


def violations(root: Path, generators: Sequence[list[str]] = tuple(GENERATORS)) -> Iterator[str]:
    """Yield one line for each generator whose page is stale."""
    for command in generators:
        done = subprocess.run(
            [sys.executable, *command, "--check"], cwd=root, capture_output=True, text=True
        )
        if done.returncode:
            said = (done.stdout + done.stderr).strip().splitlines()
            yield f"{' '.join(command)} --check: {said[-1] if said else 'its page is stale'}"


if __name__ == "__main__":
    tree.run(violations, "generated: every generated page is fresh")
