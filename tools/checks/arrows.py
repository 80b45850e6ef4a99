"""The includes and imports that are refused: the laws, the judge and the package's floors."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import tree

INCLUDE = re.compile(r'^\s*#\s*include\s*[<"]([^>"]+)[>"]', re.MULTILINE)

# Headers that avr-libc has too; the laws and the pin tables may use no others from outside.
C_HEADERS = r"(math|stdint|stddef|string|stdlib|stdio|limits|float|ctype|inttypes|stdbool)\.h"
HOST = r"[a-z_0-9]+|" + C_HEADERS

# Folder: the other folders whose headers it may include, and what it may include from outside.
ARROWS = {
    # The laws run on any computer, without Arduino.
    "lib/*": ((), C_HEADERS),
    "src/machine": (("include", "lib/*/src", "src", "tools/vm/host_avr"), C_HEADERS),
    # The judge and the world that hangs by it share nothing with the laws that they judge.
    "tools/judge": ((), HOST + r"|(unsupported/)?Eigen/\w+|nanobind/.*"),
    "tools/vm/world": (("tools/judge",), HOST + r"|Eigen/\w+"),
}

# The rooms of the package, floor by floor from the top: a room may import those on floors below.
# import-linter cannot hold this: it takes an import of a compiled module for one of all of plumb.
PACKAGE = "tools/plumb"
FLOORS = (
    ("cli",),
    ("lab",),
    ("api", "guide"),
    ("vm", "words"),
    ("hidden", "diary"),
    ("cure", "job", "plan"),
    ("diagnosis",),
    ("line",),
    ("fit", "firmware"),
    ("marks", "model"),
    ("settings", "grid"),
    ("text",),
    ("_core", "_dry_run", "_judge", "_vm"),
)

# The judge shares nothing with the model, so only what hides effects may ask it; only the virtual
# machine's room has the world that it hangs in.
ONLY = {"_dry_run": "job", "_judge": "hidden", "_vm": "vm"}


def violations(root: Path) -> Iterator[str]:
    """Yield each forbidden include and import, one line each."""
    files = tree.own_files(root)
    for pattern, (others, outside) in ARROWS.items():
        for part in root.glob(pattern):
            folders = [part, part / "src", *(each for other in others for each in root.glob(other))]
            yield from refused_includes(root, part, files, folders, outside)
    for path in files:
        name = path.relative_to(root)
        if name.is_relative_to(PACKAGE) and path.suffix == ".py":
            refused = in_package(path, name)
            yield from (f"{name}:{line}: {why}" for line, why in refused)


def refused_includes(
    root: Path, part: Path, files: list[Path], folders: list[Path], outside: str
) -> Iterator[str]:
    """Yield each include of a folder that is in none of `folders` and not allowed from outside."""
    for path in files:
        if not path.is_relative_to(part) or path.suffix not in tree.CXX:
            continue
        for line, header in includes(path):
            searched = (path.parent, part.parent, *folders)
            here = [(folder / header).resolve() for folder in searched]
            allowed = any(
                each.is_file() and any(map(each.is_relative_to, folders)) for each in here
            )
            if not allowed and not re.fullmatch(outside, header):
                where = part.relative_to(root)
                yield f"{path.relative_to(root)}:{line}: {where} may not include {header}"


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
    room = name.relative_to(PACKAGE).parts[0].removesuffix(".py")
    if room not in (*floor_of, "__init__"):
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


if __name__ == "__main__":
    tree.run(violations, "arrows: every include and import is allowed")
