"""What is installed: its version, and whether the compiled modules are those of the C++ beside it.

A build writes the digest of each of its sources next to the modules (tools/CMakeLists.txt). In a
clone, who edits C++ and forgets `tools/setup` would get answers of the old code: every program of
the lab asks here first. An installed wheel has no C++ with it, and nothing to compare.

    python -m plumb.text.compiled     prints the digests, for the build
"""

import hashlib
import json
import sys
from collections.abc import Mapping
from importlib.metadata import version as _version
from importlib.util import find_spec
from pathlib import Path

from plumb.text.errors import InputError

ROOT = Path(__file__).resolve().parents[3]
# What tools/CMakeLists.txt compiles.
SOURCES = (
    "lib/*/src/**/*",
    "src/*.h",
    "src/machine/**/*",
    "tools/core/*",
    "tools/dry_run/*",
    "tools/judge/**/*",
    "tools/vm/**/*",
)
CXX = (".h", ".cpp")
NOTE = "built_from.json"


def refuse_stale() -> None:
    """Refuse to answer with modules that were compiled from other sources than those here."""
    if source := stale_source():
        raise InputError(source, "the lab was built without this change", remedy="run tools/setup")


def stale_source(root: Path = ROOT, built_from: Mapping[str, str] | None = None) -> str | None:
    """Return the first source that is not as it was built; None if all are, or if none is here."""
    sources = digests(root)
    if not sources:
        return None
    built = _note() if built_from is None else built_from
    names = sorted({*sources, *built})
    return next((name for name in names if sources.get(name) != built.get(name)), None)


def digests(root: Path = ROOT) -> dict[str, str]:
    """Return a digest of each source below a folder, by its name there; none without the
    lab's C++.
    """
    if not (root / "tools/core").is_dir():
        return {}
    files = {path for pattern in SOURCES for path in root.glob(pattern) if path.suffix in CXX}
    return {
        path.relative_to(root).as_posix(): hashlib.sha256(path.read_bytes()).hexdigest()[:16]
        for path in sorted(files)
    }


def _note() -> dict[str, str]:
    """Return what the build noted; nothing where it noted nothing, or where nothing is built."""
    spec = find_spec("plumb._core")
    if spec is None or spec.origin is None:
        return {}
    try:
        note = json.loads(Path(spec.origin).with_name(NOTE).read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return {str(name): str(digest) for name, digest in note.items()}


# The version of the package, which is that of the firmware too.

PACKAGE = "plumb-maslow"


def version() -> str:
    """Return the version of the package that is installed."""
    return _version(PACKAGE)


if __name__ == "__main__":
    json.dump(digests(), sys.stdout, indent=1)
