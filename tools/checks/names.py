"""Names that may not be given: Arduino's macros in lib/, crutches in Python.

The laws keep off the names of Arduino's macros, so that both compile in either order. A name in
Python is a noun that says what it holds: `plan`, `effect`, `mark`.
"""

import ast
import re
from collections.abc import Iterator, Mapping
from pathlib import Path

import tree

# A macro with arguments strikes only before a bracket, one without strikes everywhere.
WITH_ARGUMENTS = r"\b(?:min|max|abs|round|sq|radians|degrees|constrain|bit|F)\s*\("
WITHOUT = (
    r"\b(?:PI|HALF_PI|TWO_PI|DEG_TO_RAD|RAD_TO_DEG|EULER"
    r"|HIGH|LOW|INPUT|OUTPUT|CHANGE|B[01]{1,8})\b"
)
MACRO = re.compile(f"{WITH_ARGUMENTS}|{WITHOUT}")
NOT_CODE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)


CRUTCHES = {"one", "own", "found", "told", "beside", "anew", "so_many", "stands_in"}
# How many crutches a folder may still hold. A number only falls; other folders hold none.
MOST_CRUTCHES = {
    "tools/tests/bench": 19,
    "tools/tests/diagnose": 61,
    "tools/tests/fit": 42,
}


def violations(root: Path) -> Iterator[str]:
    """Each such name, a line for each."""
    yield from macros(root)
    yield from crutches(root, MOST_CRUTCHES)


def macros(root: Path) -> Iterator[str]:
    """Each use of a macro's name in lib/."""
    for path in tree.own_files(root):
        name = path.relative_to(root)
        if name.parts[0] != "lib" or path.suffix not in tree.CXX:
            continue
        code = NOT_CODE.sub(blank, tree.text_of(path))
        for number, line in enumerate(code.splitlines(), 1):
            for match in MACRO.finditer(line):
                yield f"{name}:{number}: {match[0].rstrip('( ')} is a macro of Arduino"


def crutches(root: Path, most_crutches: Mapping[str, int]) -> Iterator[str]:
    """Each crutch in Python, but of a folder that may still hold some only their number."""
    held: dict[str, list[str]] = {}
    for path in tree.own_files(root):
        name = path.relative_to(root)
        if tree.is_python(path):
            places = [f"{name}:{line}: {word}" for line, word in crutches_in(tree.text_of(path))]
            held.setdefault(name.parent.as_posix(), []).extend(places)
    for folder, places in held.items():
        most = most_crutches.get(folder, 0)
        if not most:
            yield from (f"{place} does not say what it holds" for place in places)
        elif len(places) > most:
            yield f"{folder}: {len(places)} names do not say what they hold, the most is {most}"


def crutches_in(text: str) -> Iterator[tuple[int, str]]:
    """Line and name of each parameter, variable, field and function with such a name."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, ast.arg):
            name = node.arg
        elif isinstance(node, ast.Name) and isinstance(node.ctx, ast.Store):
            name = node.id
        elif isinstance(node, ast.FunctionDef):
            name = node.name
        else:
            continue
        if name.lstrip("_") in CRUTCHES:
            yield node.lineno, name


def blank(match: re.Match) -> str:
    """As many lines as the comment or string had, without its words."""
    return "\n" * match[0].count("\n")


if __name__ == "__main__":
    tree.run(violations, "names: no macro of Arduino in lib/, no new crutch in the lab")
