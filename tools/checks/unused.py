"""No function of lib/, src/ and the lab is there for tests alone: something else uses each.

Vulture says it of Python.
"""

import re
from collections.abc import Iterator
from pathlib import Path

import tree
import vulture

DECLARED_IN = ("lib", "src")
USED_IN = (*DECLARED_IN, "include", "tools")
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
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
# Called by Python and argparse; by FastAPI and pydantic.
PYTHON_BY_OTHERS = ["__getattr__", "__dir__", "_check_value", "field_title_should_be_set"]
DECORATORS = [
    "@*.get",
    "@*.post",
    "@*.put",
    "@*.delete",
    "@*.websocket",
    "@*_validator",
    "@computed_field",
    "@in_json",
]
FUNCTIONS = {"function", "method", "property", "class"}


def violations(root: Path) -> Iterator[str]:
    """Yield each function that nothing but tests uses, a line each."""
    declared: dict[str, str] = {}
    used: set[str] = set()
    for path in tree.own_files(root):
        name = path.relative_to(root)
        if path.suffix not in tree.CXX or name.parts[0] not in USED_IN:
            continue
        code = NOT_CODE.sub(blank, tree.text_of(path))
        places = {match.start(1): match[1] for match in DECLARED.finditer(code)}
        for at, word in places.items() if name.parts[0] in DECLARED_IN else ():
            declared.setdefault(word, f"{name}:{code.count(chr(10), 0, at) + 1}")
        used |= {match[0] for match in WORD.finditer(code) if match.start() not in places}
    for word, place in declared.items():
        if word not in used and word not in BY_OTHERS:
            yield f"{place}: only tests use {word}(): use it, or remove it with its test"
    yield from unused_python(root)


def blank(match: re.Match) -> str:
    """Return as many lines as the comment or string had, without its words."""
    return "\n" * match[0].count("\n")


def unused_python(root: Path) -> Iterator[str]:
    """Yield each function and class of Python that nothing but tests uses, a line each."""
    reader = vulture.Vulture(ignore_names=PYTHON_BY_OTHERS, ignore_decorators=DECORATORS)
    reader.scavenge([root / room for room in PYTHON if (root / room).is_dir()])
    for item in reader.get_unused_code():
        name = item.filename.relative_to(root)
        if item.typ in FUNCTIONS and name.is_relative_to(LAB):
            place = f"{name}:{item.first_lineno}"
            yield f"{place}: only tests use {item.name}(): use it, or remove it with its test"


if __name__ == "__main__":
    tree.run(violations, "unused: no function of lib/, src/ and the lab is there for tests alone")
