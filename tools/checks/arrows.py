"""The includes that are allowed: any that the table below does not name is refused."""

import ast
import os
import re
from collections.abc import Iterator
from pathlib import Path

import tree

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)

# Headers that avr-libc has too; the laws and the pin tables may use no others from outside.
C_HEADERS = r"(math|stdint|stddef|string|stdlib|stdio|limits|float|ctype|inttypes|stdbool)\.h"
ARDUINO = C_HEADERS + r"|(Arduino|EEPROM)\.h|(avr|util)/\w+\.h"
HOST = r"[a-z_0-9]+|" + C_HEADERS
ANYTHING = r".*"

# Part of the project: the other parts it may include, and what it may include from outside.
ARROWS = {
    "lib/*": ([], C_HEADERS),
    "include": ([], C_HEADERS),
    "src/machine": (["include", "lib/*", "src", "tools/vm/host_avr"], C_HEADERS),
    "src/board": (["include", "lib/*", "src/machine"], ARDUINO),
    "src": (["include", "lib/*", "src/machine", "src/board", "tools/vm/host_avr"], ARDUINO),
    "tools/judge": ([], HOST + r"|(unsupported/)?Eigen/\w+|nanobind/.*"),
    "test/curves": ([], HOST),
    "test/tried": (["lib/Kinematics"], HOST + r"|Kinematics\.h"),
    "test/vm": (["src/machine", "tools/judge", "tools/vm/*", "test/test_dialogues"], ANYTHING),
    # Replaces on the host a header of avr-libc that src includes.
    "tools/vm/host_avr": ([], C_HEADERS),
    "tools/vm/world": (["tools/judge"], HOST + r"|Eigen/\w+"),
    "tools/vm/mega": ([], HOST + r"|simavr/.*"),
    "tools/vm/brain": (
        ["tools/vm/world", "tools/vm/mega", "src", "src/machine", "lib/*"],
        HOST + r"|Settings\.h",
    ),
    "tools/vm": (["tools/vm/*", "tools/judge"], ANYTHING),
    "test/settings_host": (["tools/core", "src", "include", "lib/*"], ANYTHING),
    "test/fuzz": (["src", "src/machine", "lib/*", "tools/vm/*", "test/settings_host"], ANYTHING),
    "test/test_*": (
        [
            "tools/judge",
            "tools/core",
            "test/*",
            "tools/vm/*",
            "src",
            "src/machine",
            "src/board",
            "include",
            "lib/*",
        ],
        ANYTHING,
    ),
    "tools/dry_run": (
        ["src", "src/machine", "lib/*", "tools/vm/brain", "tools/vm/host_avr"],
        ANYTHING,
    ),
    "tools/core": (["lib/Kinematics", "lib/Settings", "src"], ANYTHING),
    "tools/bench": (["lib/*"], ANYTHING),
}
# Folders in which an include is looked up after the folder of the file itself.
SEARCHED = [
    "include",
    "src",
    "lib/*/src",
    "lib/*",
    "test",
    "test/*",
    "tools/core",
    "tools/judge",
    "tools/vm",
    "tools/vm/host_avr",
]

# The rooms of the package, floor by floor from the top: a room may import those on floors below.
# import-linter cannot hold this: it takes an import of a compiled module for one of all of plumb.
PACKAGE = "tools/plumb"
FLOORS = (
    ("cli",),
    ("lab",),
    ("api", "guide"),
    ("vm",),
    ("bench", "diary", "pictures"),
    ("cure", "job", "plan"),
    ("diagnosis",),
    ("line",),
    ("fit", "firmware"),
    ("marks", "model"),
    ("settings", "grid"),
    ("text",),
    ("_core", "_dry_run", "_judge", "_vm"),
)

# The folders of the lab's page: which folders each may import from, itself always.
PAGE = "tools/page/src"
PAGE_ARROWS = {
    "api": (),
    "controls": ("api",),
    "sheet": ("api", "controls"),
    "shell": ("api", "controls", "sheet", "machine", "steps", "bench", "practice"),
    "machine": ("api", "controls", "sheet", "shell"),
    "readings": ("api", "controls", "sheet", "shell", "machine"),
    "residuals": ("api", "controls", "sheet", "shell"),
    "steps": ("api", "controls", "sheet", "shell", "machine", "readings", "residuals"),
    "bench": ("api", "controls", "sheet", "shell", "machine", "residuals"),
    "practice": ("api", "controls", "sheet", "shell", "machine", "readings", "bench"),
    "report": ("api", "controls", "shell", "steps"),
}
# In the shell only the list of screens knows the screens.
SCREENS = ("steps", "bench", "practice")
LIST_OF_SCREENS = "tools/page/src/shell/steps.ts"
SCRIPT_IMPORT = re.compile(r"^\s*(?:import|export)\b[^;]*?[\"']([^\"']+)[\"']", re.MULTILINE)

# The judge shares nothing with the model, so only the bench may ask it; only the virtual machine's
# room has the world that it hangs in.
ONLY = {"_dry_run": "job", "_judge": "bench", "_vm": "vm"}


def violations(root: Path) -> Iterator[str]:
    """Yield each forbidden include and import, one line each."""
    for path in tree.own_files(root):
        name = path.relative_to(root)
        part, rule = part_of(name)
        if path.suffix in tree.CXX and rule:
            for line, header in includes(path):
                why = refusal(root, path, part, rule, header)
                if why:
                    yield f"{name}:{line}: {part} may not include {header}: {why}"
        elif name.is_relative_to(PAGE) and path.suffix in tree.SCRIPT:
            yield from (f"{name}:{line}: {why}" for line, why in across(path, name))
        elif name.is_relative_to(PACKAGE) and path.suffix == ".py":
            refused = in_package(path, name)
            yield from (f"{name}:{line}: {why}" for line, why in refused)


def part_of(name: Path) -> tuple[str, str | None]:
    """Return the part in which a file lies (`lib/Motion`) and the row of the table for it."""
    for rule in ARROWS:
        depth = rule.count("/") + 1
        part = Path(*name.parts[:depth])
        if len(name.parts) > depth and part.match(rule):
            return part.as_posix(), rule
    return name.parts[0], None


def includes(path: Path) -> Iterator[tuple[int, str]]:
    """Line number and name of each header that a file includes."""
    text = tree.text_of(path)
    for match in INCLUDE.finditer(text):
        yield text.count("\n", 0, match.start(1)) + 1, match[1]


def imports(path: Path) -> Iterator[tuple[int, str]]:
    """Line number and full name of each module that a Python file imports."""
    for node in ast.walk(ast.parse(tree.text_of(path))):
        if isinstance(node, ast.Import):
            yield from ((node.lineno, alias.name) for alias in node.names)
        elif isinstance(node, ast.ImportFrom) and node.module == "plumb":
            yield from ((node.lineno, f"plumb.{alias.name}") for alias in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.lineno, "." * node.level + (node.module or "")


def in_package(path: Path, name: Path) -> Iterator[tuple[int, str]]:
    """Line number and reason for each import that a file of the package may not make."""
    floor_of = {room: floor for floor, rooms in enumerate(FLOORS) for room in rooms}
    room = name.relative_to(PACKAGE).parts[0]
    if room not in (*floor_of, "__init__.py"):
        yield 1, f"{room} is on no floor: add it to FLOORS in tools/checks/arrows.py"
    for line, module in imports(path):
        top, _, rest = module.partition(".")
        to = rest.partition(".")[0]
        if room not in floor_of or top not in ("plumb", ""):
            continue
        elif not top or not to:
            yield line, f"{room} may not import {module} (name the room: plumb.ROOM.MODULE)"
        elif to != room and floor_of.get(to, -1) <= floor_of[room]:
            yield line, f"{room} may not import {to}: imports only go down the floors"
        elif room != ONLY.get(to, room):
            yield line, f"{room} may not import {to}: only {ONLY[to]} may"


def across(path: Path, name: Path) -> Iterator[tuple[int, str]]:
    """Line number and reason for each import that a folder of the page may not make."""
    place = name.relative_to(PAGE)
    folder = place.parts[0] if len(place.parts) > 1 else ""
    if folder and folder not in PAGE_ARROWS:
        yield (
            1,
            f"{folder} is not a folder of the page: see PAGE_ARROWS in tools/checks/arrows.py",
        )
        return
    text = tree.text_of(path)
    for match in SCRIPT_IMPORT.finditer(text):
        if not match[1].startswith("."):
            continue
        line = text.count("\n", 0, match.start(1)) + 1
        target = Path(os.path.normpath(place.parent / match[1])).parts
        to = target[0] if len(target) > 1 else ""
        if not folder or to == folder:
            continue
        if to not in PAGE_ARROWS[folder]:
            yield line, f"{folder} may not import {to or match[1]}"
        elif folder == "shell" and to in SCREENS and name.as_posix() != LIST_OF_SCREENS:
            yield line, f"only {LIST_OF_SCREENS} may import {to}"


def refusal(root: Path, path: Path, part: str, rule: str, header: str) -> str | None:
    """Why a file of this part may not include the header; None if it may."""
    allowed, outside = ARROWS[rule]
    parts = {part_of(each.relative_to(root))[0] for each in candidates(root, path, header)}
    if not parts:
        return None if re.fullmatch(outside, header) else "not in the list for this part"
    if part in parts or any(Path(to).match(each) for to in parts for each in allowed):
        return None
    return f"that is {', '.join(sorted(parts))}"


def candidates(root: Path, path: Path, header: str) -> list[Path]:
    """Return what an include may mean: the file in its folder, else any in the searched folders."""
    neighbour = (path.parent / header).resolve()
    if neighbour.is_file() and neighbour.is_relative_to(root):
        return [neighbour]
    folders = [folder for pattern in SEARCHED for folder in root.glob(pattern)]
    headers = [(folder / header).resolve() for folder in folders]
    return [each for each in headers if each.is_file() and each.is_relative_to(root)]


if __name__ == "__main__":
    tree.run(violations, "arrows: every include and import is allowed")
