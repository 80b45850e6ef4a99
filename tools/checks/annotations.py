"""The types of the package and of what writes pages hold under mypy --strict.

Its name is not types.py: that would hide the module `types` of Python's library from all checks.
"""

import re
import subprocess
import sys
from pathlib import Path

import tree

ROOMS = ("tools/plumb", "docs/written_by")
ERROR = re.compile(r"[^:]+:\d+: error: ")


def violations(root: Path) -> list[str]:
    """Return the errors as mypy prints them; its last words where it could not run."""
    config, cache = tree.ROOT / "pyproject.toml", root / ".build/mypy"
    rooms = [name for name in ROOMS if (root / name).is_dir()]
    command = [sys.executable, "-m", "mypy", "--config-file", config, "--cache-dir", cache, *rooms]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True)
    lines = [line for line in done.stdout.splitlines() if ERROR.match(line)]
    if done.returncode and not lines:
        return [f"mypy: {(done.stdout + done.stderr).strip()}"]
    return lines


if __name__ == "__main__":
    tree.run(violations, "annotations: mypy --strict has nothing to say")
