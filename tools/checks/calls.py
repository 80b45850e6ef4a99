"""Which programs a file calls: shell scripts, Makefiles, Python and C++, read but never run."""

import ast
import functools
import re
import subprocess
from collections.abc import Iterator
from pathlib import Path

import tree
import tree_sitter
import tree_sitter_bash

# Commands that run the program named behind them.
RUNNERS = {"env", "exec", "nice", "sudo", "timeout", "xargs"}
# Called only where it is installed.
OPTIONAL = {"sudo"}
PROGRAM = re.compile(r"[a-z][a-z0-9_.+-]*")
SUBPROCESS = {"run", "Popen", "call", "check_call", "check_output"}
REDIRECTIONS = {"variable_assignment", "file_redirect", "heredoc_redirect", "herestring_redirect"}
# A command in an array, `"${as_root[@]}"`, runs what stands behind it.
ARRAY = re.compile(r'"\$\{\w+\[@\]\}"')
IN_FRONT = re.compile(r"-|\d|\w+=")
# SCons names its tools like this: env.Replace(CC="avr-gcc").
SCONS_TOOLS = {"CC", "CXX", "AS", "AR", "RANLIB", "SIZETOOL", "OBJCOPY"}
IN_CXX = re.compile(r'\b(?:popen|system)\(\s*"([^"\s]+)')
MAKE_VARIABLE = re.compile(r"^(?:CC|CXX|AR|LD)\s*[:?]?=\s*(\S+)")

_bash = tree_sitter.Parser(tree_sitter.Language(tree_sitter_bash.language()))


def programs_in(
    path: Path, text: str, functions: frozenset[str] = frozenset()
) -> Iterator[tuple[int, str]]:
    """Line and name of each program that a file calls by its bare name.

    A name with a folder in front, such as `.venv/bin/pio`, comes from the project, not from Debian.
    `functions` are those that other scripts bring along when they source this file.
    """
    if tree.is_shell(path):
        called = in_shell(text, functions)
    elif path.name == "Makefile":
        called = in_makefile(text)
    elif tree.is_python(path):
        called = in_python(text)
    elif path.suffix in tree.CXX:
        called = ((text.count("\n", 0, at.start()) + 1, at[1]) for at in IN_CXX.finditer(text))
    else:
        return
    yield from ((line, name) for line, name in called if PROGRAM.fullmatch(name))


def functions_of(text: str) -> frozenset[str]:
    """Return the functions that a bash script defines."""
    return frozenset(
        child.text.decode()
        for node in below(_bash.parse(text.encode()).root_node)
        if node.type == "function_definition"
        for child in node.children
        if child.type == "word"
    )


def in_shell(text: str, functions: frozenset[str]) -> Iterator[tuple[int, str]]:
    """Programs of a bash script: the interpreter, and the program of each command."""
    if text.startswith("#!"):
        yield 1, text.partition("\n")[0].split("/")[-1].split()[-1]
    known = builtins() | OPTIONAL | functions | functions_of(text)
    for node in below(_bash.parse(text.encode()).root_node):
        if node.type == "command":
            yield from ((line, name) for line, name in in_command(node) if name not in known)


@functools.cache
def builtins() -> frozenset[str]:
    """Return the commands of bash itself."""
    done = subprocess.run(["bash", "-c", "compgen -b"], capture_output=True, text=True, check=True)
    return frozenset(done.stdout.split())


def in_command(node: tree_sitter.Node) -> Iterator[tuple[int, str]]:
    """Yield the words of one command that stand where a program does, as in `nice -n 5 make
    all`.
    """
    words = [child.text.decode() for child in node.children if child.type not in REDIRECTIONS]
    line = node.start_point[0] + 1
    while words:
        name = words.pop(0)
        yield line, name
        if name not in RUNNERS and not ARRAY.fullmatch(name):
            return
        # Options of the runner, times and variables come before the program.
        while words and IN_FRONT.match(words[0]):
            words.pop(0)


def below(node: tree_sitter.Node) -> Iterator[tree_sitter.Node]:
    """Yield a node and all nodes below it."""
    yield node
    for child in node.children:
        yield from below(child)


def in_makefile(text: str) -> Iterator[tuple[int, str]]:
    """Programs of a Makefile: make, its tools, and the first word of each recipe line."""
    yield 1, "make"
    for number, line in enumerate(text.splitlines(), 1):
        tool = MAKE_VARIABLE.match(line)
        if tool:
            yield number, tool[1]
        if line.startswith("\t"):
            yield number, line.strip().lstrip("@-+").split()[0]
        for name in re.findall(r"\$\(shell (\S+)", line):
            yield number, name


def in_python(text: str) -> Iterator[tuple[int, str]]:
    """Programs that a module hands to subprocess, by itself or through a function in its file."""
    module = ast.parse(text)
    lists: dict[str, list[ast.expr]] = {}
    for node in ast.walk(module):
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.List):
            for target in node.targets:
                if isinstance(target, ast.Name):
                    lists.setdefault(target.id, []).append(node.value)
    for node in ast.walk(module):
        if not isinstance(node, ast.Call):
            continue
        function = node.func
        name = function.attr if isinstance(function, ast.Attribute) else getattr(function, "id", "")
        is_run = name in SUBPROCESS and isinstance(function, ast.Attribute)
        if is_run or name in ("which", "output", "VerboseAction"):
            yield from (head for each in node.args[:1] for head in heads(each, lists))
        elif name == "Replace":
            tools = (each.value for each in node.keywords if each.arg in SCONS_TOOLS)
            yield from (head for each in tools for head in heads(each, lists))


def heads(node: ast.expr, lists: dict[str, list[ast.expr]]) -> Iterator[tuple[int, str]]:
    """Line and program of a command: a text, a list, or a name that stands for a list."""
    if isinstance(node, ast.Constant) and isinstance(node.value, str):
        yield node.lineno, node.value.partition(" ")[0]
    elif isinstance(node, ast.Starred):
        yield from heads(node.value, lists)
    elif isinstance(node, ast.Name):
        yield from (head for each in lists.get(node.id, ()) for head in heads(each, {}))
    elif isinstance(node, ast.List) and node.elts:
        yield from heads(node.elts[0], lists)
