"""Names that may not be given: Arduino's macros in lib/, crutches in Python and C++.

Two files of a suite in C++ never define the same name, as the compiler may read them as one file.
lib/ avoids the names of Arduino's macros, so that both compile in either order. A name is a noun
that says what it holds: `plan`, `effect`, `mark`.
"""

import ast
import re
from collections.abc import Iterator
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

# A constant, a type, or a function with its parameters, at the beginning of a line.
DEFINITION = re.compile(
    r"^(?:(?:const|constexpr) [^(\n]*?\b(\w+)(?: =|\{|;|\[)"
    r"|(?:struct|class|enum class|enum) (\w+)[^;\n]*\{"
    r"|(?!TEST|INSTANTIATE)\w[\w:<>,&* ]*[ &*](\w+)\(([^)]*)\)[^;{]*\{)",
    re.MULTILINE,
)

CRUTCHES = {"one", "own", "found", "told", "beside", "anew", "so_many", "stands_in"}
# In C++ `found` is the word for an outcome; docs/words.md says so.
CXX_CRUTCH = re.compile(r"(?<!\w)_?(?:one|own|told|beside|anew|so_many|stands_in)_?(?!\w)")


def violations(root: Path) -> Iterator[str]:
    """Yield each such name, a line for each."""
    yield from names_in_cxx(root)
    yield from crutches(root)
    yield from defined_twice(root)


def defined_twice(root: Path) -> Iterator[str]:
    """Yield each name that two files of a suite define: see custom_together in platformio.ini."""
    seen: dict[tuple[Path, str], Path] = {}
    for path in tree.own_files(root):
        name = path.relative_to(root)
        if path.suffix != ".cpp" or not name.parent.name.startswith("test_"):
            continue
        for match in DEFINITION.finditer(NOT_CODE.sub(blank, tree.text_of(path))):
            defined = " ".join(word for word in match.groups() if word)
            first = seen.setdefault((path.parent, defined), name)
            if first != name:
                yield f"{name}: {first.name} defines {defined} too"


def names_in_cxx(root: Path) -> Iterator[str]:
    """Yield each use of a macro's name in lib/, and each crutch in C++."""
    for path in tree.own_files(root):
        if path.suffix not in tree.CXX:
            continue
        name = path.relative_to(root)
        code = NOT_CODE.sub(blank, tree.text_of(path))
        for number, line in enumerate(code.splitlines(), 1):
            for match in CXX_CRUTCH.finditer(line):
                yield f"{name}:{number}: {match[0]} does not say what it holds"
            for match in MACRO.finditer(line) if name.parts[0] == "lib" else ():
                yield f"{name}:{number}: {match[0].rstrip('( ')} is a macro of Arduino"


def crutches(root: Path) -> Iterator[str]:
    """Yield each crutch in Python."""
    for path in tree.own_files(root):
        if tree.is_python(path):
            for line, word in crutches_in(tree.text_of(path)):
                yield f"{path.relative_to(root)}:{line}: {word} does not say what it holds"


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
    """Return as many lines as the comment or string had, without its words."""
    return "\n" * match[0].count("\n")


if __name__ == "__main__":
    tree.run(violations, "names: no macro of Arduino in lib/, no crutch in Python and C++")
