"""Names that a compiler would stumble over: Arduino's macros in lib/, and joined suites' names.

lib/ avoids the names of Arduino's macros, so that both compile in either order. Two files of a
suite in C++ never define the same name, as the compiler may read them as one file.
"""

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


def violations(root: Path) -> Iterator[str]:
    """Yield each such name, a line for each."""
    yield from macros_in_lib(root)
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


def macros_in_lib(root: Path) -> Iterator[str]:
    """Yield each use of a macro's name in lib/."""
    for path in tree.own_files(root):
        name = path.relative_to(root)
        if path.suffix not in tree.CXX or name.parts[0] != "lib":
            continue
        code = NOT_CODE.sub(blank, tree.text_of(path))
        for number, line in enumerate(code.splitlines(), 1):
            for match in MACRO.finditer(line):
                yield f"{name}:{number}: {match[0].rstrip('( ')} is a macro of Arduino"


def blank(match: re.Match) -> str:
    """Return as many lines as the comment or string had, without its words."""
    return "\n" * match[0].count("\n")


if __name__ == "__main__":
    tree.run(violations, "names: no macro of Arduino in lib/, no name twice in a suite")
