"""No function over 60 lines of code, few over 40, no file over 400 lines."""

from collections.abc import Iterator
from pathlib import Path

import lizard
import tree

MOST_FILE_LINES = 400
MOST_FUNCTION_LINES = 60
LONG_FUNCTION_LINES = 40
LONG_SHARE = 0.02
OTHER_TEXT = {".ini", ".js", ".ts", ".css", ".toml"}


def violations(root: Path) -> Iterator[str]:
    """Each file and function that is too long, one line each."""
    functions = []
    for path in tree.own_files(root):
        name = path.relative_to(root)
        code = path.suffix in tree.CXX or tree.is_python(path)
        if code or path.suffix in OTHER_TEXT or tree.is_shell(path):
            lines = len(tree.text_of(path).splitlines())
            if lines > MOST_FILE_LINES:
                yield f"{name}: {lines} lines, the most is {MOST_FILE_LINES}"
        if code:
            functions += [(name, each) for each in functions_of(path)]
    yield from long_functions(functions)


def functions_of(path: Path) -> list:
    """The functions in a file of C++ or Python."""
    # lizard goes by the name's ending, and a command has none.
    name = str(path) if path.suffix else f"{path}.py"
    return lizard.analyze_file.analyze_source_code(name, tree.text_of(path)).function_list


def long_functions(functions: list) -> Iterator[str]:
    """Functions over the limit, and those over the softer one if they are too many together."""
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
    tree.run(violations, "size: no function and no file is too long")
