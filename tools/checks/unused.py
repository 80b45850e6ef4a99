"""No function of lib/, src/ and the lab is there for tests alone: something else uses each.

Vulture says it of Python.
"""

import re
from collections.abc import Iterator
from pathlib import Path

import tree
import tree_sitter
import tree_sitter_cpp
import vulture

DECLARED_IN = ("lib", "src")
USED_IN = (*DECLARED_IN, "include", "tools")
WORD = re.compile(r"[A-Za-z_]\w*")
# Called by the compiler, Arduino or avr-libc; the last is in a section that runs before main().
BY_OTHERS = {"main", "setup", "loop", "init", "serialEvent", "keepResetFlags"}
# The lab and the research, which may be all that uses a function of it.
PYTHON = ("tools/plumb", "tools/research")
# Called by Python, argparse, FastAPI and pydantic.
PYTHON_BY_OTHERS = ["__getattr__", "__dir__", "_check_value"]
DECORATORS = ["@*.get", "@*.post", "@*.put", "@*.delete", "@*.websocket", "@*_validator"]
FUNCTIONS = {"function", "method", "property", "class"}
NAMES = {"identifier", "field_identifier", "type_identifier", "namespace_identifier"}
RAW = {"preproc_arg", "preproc_call"}

_parser = tree_sitter.Parser(tree_sitter.Language(tree_sitter_cpp.language()))


def violations(root: Path) -> Iterator[str]:
    """Each function that nothing but tests uses, a line each."""
    declared: dict[str, str] = {}
    used: set[str] = set()
    for path in tree.own_files(root):
        name = path.relative_to(root)
        if path.suffix not in tree.CXX or name.parts[0] not in USED_IN:
            continue
        top = _parser.parse(tree.text_of(path).encode()).root_node
        declarations = {} if name.parts[0] not in DECLARED_IN else declared
        for kind, word, line in words_of(top):
            if kind == "used":
                used.add(word)
            else:
                declarations.setdefault(word, f"{name}:{line}")
    for word, place in declared.items():
        if word not in used and word not in BY_OTHERS:
            yield f"{place}: only tests use {word}(): use it, or remove it with its test"
    yield from unused_python(root)


def unused_python(root: Path) -> Iterator[str]:
    """Each function and class of Python that nothing but tests uses, a line each."""
    reader = vulture.Vulture(ignore_names=PYTHON_BY_OTHERS, ignore_decorators=DECORATORS)
    reader.scavenge([root / room for room in PYTHON if (root / room).is_dir()])
    for item in reader.get_unused_code():
        if item.typ in FUNCTIONS:
            place = f"{item.filename.relative_to(root)}:{item.first_lineno}"
            yield f"{place}: only tests use {item.name}(): use it, or remove it with its test"


def words_of(top: tree_sitter.Node) -> Iterator[tuple[str, str, int]]:
    """Each name in a file: "declared" where it is local to a function, "used" elsewhere."""
    waiting = [top]
    while waiting:
        node = waiting.pop()
        line = node.start_point[0] + 1
        if node.type in RAW:
            yield from (("used", word, line) for word in WORD.findall(node.text.decode()))
            continue
        skipped = declared_name(node)
        if skipped is not None:
            yield "declared", skipped.text.decode(), line
        elif node.type in NAMES and not is_declared(node):
            yield "used", node.text.decode(), line
        waiting.extend(node.children)


def declared_name(node: tree_sitter.Node) -> tree_sitter.Node | None:
    """The name of the function that a declarator declares, unless it is an operator or the like."""
    if node.type != "function_declarator" or not is_function(node):
        return None
    name = node.child_by_field_name("declarator")
    while name is not None and name.type in ("qualified_identifier", "template_function"):
        name = name.child_by_field_name("name")
    return name if name is not None and name.type in ("identifier", "field_identifier") else None


def is_function(node: tree_sitter.Node) -> bool:
    """Whether a declarator has a return type: constructors have none."""
    above = node.parent
    while above is not None and above.type in ("reference_declarator", "pointer_declarator"):
        above = above.parent
    return above is not None and above.child_by_field_name("type") is not None


def is_declared(node: tree_sitter.Node) -> bool:
    """Whether a name is the name that its function's declarator declares."""
    above = node.parent
    while above is not None and above.type in ("qualified_identifier", "template_function"):
        above = above.parent
    if above is None or above.type != "function_declarator":
        return False
    name = declared_name(above)
    return name is not None and name.start_byte == node.start_byte


if __name__ == "__main__":
    tree.run(violations, "unused: no function of lib/, src/ and the lab is there for tests alone")
