"""The types of tools/plumb hold under mypy --strict; every `type: ignore` says why on its line.

Its name is not types.py: that would hide the module `types` of Python's library from all checks.
"""

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import tree

# Rooms that still have errors. A room leaves this list when it is clean, and no room joins it.
OPEN_ROOMS: set[str] = set()
ERROR = re.compile(r"(?P<path>[^:]+):\d+: error: ")
IGNORE = re.compile(r"#\s*type:\s*ignore(?!\[[\w, -]+\]\s*#\s*\w)")


def violations(root: Path) -> Iterator[str]:
    """Each error in a clean room and each `type: ignore` without a reason, one line each."""
    yield from ignored_without_reason(root)
    for line in errors_of_mypy(root):
        if room_of(line) not in OPEN_ROOMS:
            yield f"tools/{line}"


def ignored_without_reason(root: Path) -> Iterator[str]:
    """Lines that keep mypy quiet and do not say about what and why."""
    for path in tree.own_files(root):
        name = path.relative_to(root)
        if name.parts[:2] != ("tools", "plumb"):
            continue
        for number, line in enumerate(tree.text_of(path).splitlines(), 1):
            if IGNORE.search(line):
                yield f"{name}:{number}: write `# type: ignore[code]  # why`"


def errors_of_mypy(root: Path) -> list[str]:
    """The errors in tools/plumb as mypy prints them; its last words where it could not run."""
    config, cache = tree.ROOT / "tools/mypy.ini", root / ".build/mypy"
    command = [sys.executable, "-m", "mypy", "--config-file", config, "--cache-dir", cache, "plumb"]
    done = subprocess.run(command, cwd=root / "tools", capture_output=True, text=True)
    lines = [line for line in done.stdout.splitlines() if ERROR.match(line)]
    if done.returncode and not lines:
        return [f"mypy: {(done.stdout + done.stderr).strip()}"]
    return lines


def room_of(line: str) -> str:
    """The folder below tools/plumb in which an error lies."""
    match = ERROR.match(line)
    parts = Path(match["path"]).parts if match else ()
    return parts[1] if len(parts) > 2 else ""


if __name__ == "__main__":
    good = "annotations: mypy --strict has nothing to say"
    if OPEN_ROOMS:
        good += f", but {len(OPEN_ROOMS)} rooms are still open"
    tree.run(violations, good)
