"""The types of the package and of what writes pages hold under mypy --strict.

Every `type: ignore` says why on its line.

Its name is not types.py: that would hide the module `types` of Python's library from all checks.
"""

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import tree

ROOMS = ("tools/plumb", "docs/written_by")
ERROR = re.compile(r"[^:]+:\d+: error: ")
IGNORE = re.compile(r"#\s*type:\s*ignore(?!\[[\w, -]+\]\s*#\s*\w)")


def violations(root: Path) -> Iterator[str]:
    """Yield each error and each `type: ignore` without a reason, one line each."""
    yield from ignored_without_reason(root)
    yield from errors_of_mypy(root)


def ignored_without_reason(root: Path) -> Iterator[str]:
    """Yield lines that keep mypy quiet and do not say about what and why."""
    for path in tree.own_files(root):
        name = path.relative_to(root)
        if not any(name.is_relative_to(room) for room in ROOMS):
            continue
        for number, line in enumerate(tree.text_of(path).splitlines(), 1):
            if IGNORE.search(line):
                yield f"{name}:{number}: write `# type: ignore[code]  # why`"


def errors_of_mypy(root: Path) -> list[str]:
    """Return the errors as mypy prints them; its last words where it could not run."""
    config, cache = tree.ROOT / "tools/mypy.ini", root / ".build/mypy"
    rooms = [name for name in ROOMS if (root / name).is_dir()]
    command = [sys.executable, "-m", "mypy", "--config-file", config, "--cache-dir", cache, *rooms]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True)
    lines = [line for line in done.stdout.splitlines() if ERROR.match(line)]
    if done.returncode and not lines:
        return [f"mypy: {(done.stdout + done.stderr).strip()}"]
    return lines


if __name__ == "__main__":
    tree.run(violations, "annotations: mypy --strict has nothing to say")
