"""The laws keep off the names of Arduino's macros, so that both compile in either order."""

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


def violations(root: Path) -> Iterator[str]:
    """Each use of such a name in lib/, one line each."""
    for path in tree.own_files(root):
        name = path.relative_to(root)
        if name.parts[0] != "lib" or path.suffix not in tree.CXX:
            continue
        code = NOT_CODE.sub(blank, tree.text_of(path))
        for number, line in enumerate(code.splitlines(), 1):
            for match in MACRO.finditer(line):
                yield f"{name}:{number}: {match[0].rstrip('( ')} is a macro of Arduino"


def blank(match: re.Match) -> str:
    """As many lines as the comment or string had, without its words."""
    return "\n" * match[0].count("\n")


if __name__ == "__main__":
    tree.run(violations, "names: lib/ uses no macro name of Arduino")
