"""The types of the package and of what writes pages hold under mypy --strict.

Its name is not types.py: that would hide the module `types` of Python's library from all checks.
"""

import sys
from collections.abc import Iterator
from pathlib import Path

import tree
from formatting import first_in_each_file

ROOMS = ("tools/plumb", "tools/rates", "docs/written_by")


def violations(root: Path) -> Iterator[str]:
    """Yield the first error of each file."""
    config, cache = tree.ROOT / "pyproject.toml", root / ".build/mypy"
    rooms = [name for name in ROOMS if (root / name).is_dir()]
    command = [sys.executable, "-m", "mypy", "--config-file", config, "--cache-dir", cache]
    return first_in_each_file([*command, *rooms], root)


if __name__ == "__main__":
    tree.run(violations, "annotations: mypy --strict has nothing to say")
