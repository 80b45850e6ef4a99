"""No function over 60 lines, few over 40, none of the page's components over 100; no file over 400
lines; no line over 120 columns."""

from collections.abc import Iterator
from pathlib import Path

import lizard
import tree

MOST_FILE_LINES = 400
MOST_FUNCTION_LINES = 60
LONG_FUNCTION_LINES = 40
MOST_COMPONENT_LINES = 100  # half of a component is what it draws
LONG_SHARE = 0.02
MOST_COLUMNS = 120
OTHER_TEXT = {".ini", ".css", ".toml"}
# Pages that a program writes; their long lines are sentences of the code.
GENERATED = {"docs/effects.md", "docs/real-data.md", "docs/settings.md", "docs/bench.md"}


def violations(root: Path) -> Iterator[str]:
    """Yield each file, line and function that is too long, a line for each."""
    functions = []
    for path in tree.own_files(root):
        name = path.relative_to(root)
        code = path.suffix in tree.CXX | tree.SCRIPT or tree.is_python(path)
        text = code or path.suffix in OTHER_TEXT or tree.is_shell(path)
        if text:
            lines = len(tree.text_of(path).splitlines())
            if lines > MOST_FILE_LINES:
                yield f"{name}: {lines} lines, the most is {MOST_FILE_LINES}"
        # In a script biome breaks what can be broken; what stays long is a sentence.
        script = path.suffix in tree.SCRIPT
        if (text and not script) or path.suffix == ".md" or path.name == "Makefile":
            yield from long_lines(name, tree.text_of(path))
        if code:
            functions += [(name, each) for each in functions_of(path)]
    yield from long_functions(functions)


def long_lines(name: Path, text: str) -> Iterator[str]:
    """Yield lines over the limit that can be broken.

    Rows and pictures of a Markdown page cannot, nor what a program printed, nor a single word.
    """
    if name.as_posix() in GENERATED:
        return
    printed = False
    for number, line in enumerate(text.splitlines(), 1):
        if line.startswith("```"):
            printed = line == "```console"
        breakable = not printed and not line.startswith(("|", "![")) and len(line.split()) > 1
        if len(line) > MOST_COLUMNS and breakable:
            yield f"{name}:{number}: {len(line)} columns, the most is {MOST_COLUMNS}"


def functions_of(path: Path) -> list:
    """Return the functions in a file of C++, Python, TypeScript or JavaScript."""
    # lizard goes by the name's ending, and a command has none.
    name = str(path) if path.suffix else f"{path}.py"
    return lizard.analyze_file.analyze_source_code(name, tree.text_of(path)).function_list


def long_functions(functions: list) -> Iterator[str]:
    """Functions over the limit, and those over the softer one if they are too many together."""
    components = [(name, each) for name, each in functions if name.suffix == ".tsx"]
    for name, each in components:
        if each.nloc > MOST_COMPONENT_LINES:
            where = f"{name}:{each.start_line}: {each.name}() has {each.nloc} lines of code"
            yield f"{where}, the most is {MOST_COMPONENT_LINES}"
    functions = [(name, each) for name, each in functions if name.suffix != ".tsx"]
    long = [(name, each) for name, each in functions if each.nloc > LONG_FUNCTION_LINES]
    for name, each in long:
        where = f"{name}:{each.start_line}: {each.name}() has {each.nloc} lines of code"
        if each.nloc > MOST_FUNCTION_LINES:
            yield f"{where}, the most is {MOST_FUNCTION_LINES}"
        elif len(long) > LONG_SHARE * len(functions):
            yield (
                f"{where}: {len(long)} of {len(functions)} functions are over "
                f"{LONG_FUNCTION_LINES}, the most is {LONG_SHARE:.0%}"
            )


if __name__ == "__main__":
    tree.run(violations, "size: no function, file or line is too long")
