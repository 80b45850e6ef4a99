"""Lays stand-ins for PlatformIO's packages where PlatformIO looks before it asks its registry.

Run as `install.py ROOT`; not needed where the registry answers.
"""

import json
import shutil
import sys
from pathlib import Path

HERE = Path(__file__).parent
# Kind, owner in the registry, name, folder below the project's root.
PACKAGES = [
    ("tool", "platformio", "tool-scons", ".platformio/packages"),
    ("platform", "platformio", "native", ".platformio/platforms"),
    ("platform", "platformio", "atmelavr", ".platformio/platforms"),
    ("library", "google", "googletest", ".pio/libdeps/native"),
    ("library", "hideakitai", "ArduinoEigen", ".pio/libdeps/native"),
]
# What a stand-in borrows from the system: link, its target.
BORROWED = [
    (".pio/libdeps/native/googletest/googletest", "/usr/src/googletest/googletest"),
    (".pio/libdeps/native/googletest/googlemock", "/usr/src/googletest/googlemock"),
    (".pio/libdeps/native/ArduinoEigen/ArduinoEigen", "/usr/include/eigen3"),
]


def install(root: Path) -> None:
    """Install all packages below `root`, each with the note by which PlatformIO recognises it."""
    for kind, owner, name, folder in PACKAGES:
        target = root / folder / name
        shutil.rmtree(target, ignore_errors=True)
        shutil.copytree(HERE / name, target, ignore=shutil.ignore_patterns("__pycache__"))
        (target / ".piopm").write_text(json.dumps(note(kind, owner, name)))
    for link, target in BORROWED:
        if not Path(target).is_dir():
            sys.exit(f"setup: {target} is missing; its Debian package should have brought it")
        (root / link).symlink_to(target)


def note(kind: str, owner: str, name: str) -> dict:
    """Return the contents of `.piopm` for one package; the version is in its manifest."""
    manifest = {"tool": "package.json", "platform": "platform.json", "library": "library.json"}
    version = json.loads((HERE / name / manifest[kind]).read_text())["version"]
    spec = {"owner": owner, "id": None, "name": name, "requirements": None, "uri": None}
    return {"type": kind, "name": name, "version": version, "spec": spec}


if __name__ == "__main__":
    install(Path(sys.argv[1]))
