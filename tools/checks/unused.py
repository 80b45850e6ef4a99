"""No function of lib/, src/ and the lab is there for tests alone: something else uses each.

Vulture says it of Python.
"""

import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import tree

DECLARED_IN = ("lib", "src")
USED_IN = (*DECLARED_IN, "include", "tools")
WORD = re.compile(r"[A-Za-z_]\w*")
# A type, then a name with a bracket, as clang-format spaces them.
DECLARED = re.compile(
    r"(?<!#define )\b(?!(?:return|else|new|throw|case|goto|explicit)\b)"
    r"[A-Za-z_][\w:]*(?:<[^;()]*>)?[&*]* (?:\w+::)*([A-Za-z_]\w*)\("
)
# Called by the compiler, Arduino or avr-libc; the last is in a section that runs before main().
BY_OTHERS = {"main", "setup", "loop", "init", "serialEvent", "keepResetFlags"}
# The lab, and what may be all that uses a function of it. Templates use what writes pages.
LAB = "tools/plumb"
PYTHON = (LAB, "docs/written_by")
FOUND = re.compile(r"^(\S+:\d+): unused (?:function|method|property|class) '(\w+)'", re.MULTILINE)


def violations(root: Path) -> Iterator[str]:
    """Yield each function that nothing but tests uses, a line each."""
    declared: dict[str, str] = {}
    used: set[str] = set()
    for name, code in tree.cxx_code(root):
        if name.parts[0] not in USED_IN:
            continue
        places = {match.start(1): match[1] for match in DECLARED.finditer(code)}
        for at, word in places.items() if name.parts[0] in DECLARED_IN else ():
            declared.setdefault(word, f"{name}:{code.count(chr(10), 0, at) + 1}")
        used |= {match[0] for match in WORD.finditer(code) if match.start() not in places}
    for word, place in declared.items():
        if word not in used and word not in BY_OTHERS:
            yield f"{place}: only tests use {word}(): use it, or remove it with its test"
    yield from unused_python(root)


def unused_python(root: Path) -> Iterator[str]:
    """Yield each function and class of Python that nothing but tests uses, a line each."""
    rooms = [room for room in PYTHON if (root / room).is_dir()]
    command = [sys.executable, "-m", "vulture", "--config", tree.ROOT / "pyproject.toml", *rooms]
    done = subprocess.run(command, cwd=root, capture_output=True, text=True)
    for place, name in FOUND.findall(done.stdout):
        if place.startswith(LAB):
            yield f"{place}: only tests use {name}(): use it, or remove it with its test"


if __name__ == "__main__":
    tree.run(violations, "unused: no function of lib/, src/ and the lab is there for tests alone")
