"""Names of joined suites: two files of a suite in C++ never define the same name.

The compiler may read them as one file.
"""

import re
from collections.abc import Iterator
from pathlib import Path

import tree

# A constant, a type, or a function with its parameters, at the beginning of a line.
DEFINITION = re.compile(
    r"^(?:(?:const|constexpr) [^(\n]*?\b(\w+)(?: =|\{|;|\[)"
    r"|(?:struct|class|enum class|enum) (\w+)[^;\n]*\{"
    r"|(?!TEST|INSTANTIATE)\w[\w:<>,&* ]*[ &*](\w+)\(([^)]*)\)[^;{]*\{)",
    re.MULTILINE,
)


def violations(root: Path) -> Iterator[str]:
    """Yield each name that two files of a suite define: see custom_together in platformio.ini."""
    seen: dict[tuple[Path, str], Path] = {}
    for name, code in tree.cxx_code(root):
        if name.suffix != ".cpp" or not name.parent.name.startswith("test_"):
            continue
        for match in DEFINITION.finditer(code):
            defined = " ".join(word for word in match.groups() if word)
            first = seen.setdefault((name.parent, defined), name)
            if first != name:
                yield f"{name}: {first.name} defines {defined} too"


if __name__ == "__main__":
    tree.run(violations, "names: no name twice in a suite")
