"""The page of the rooms names what exists: each room, and each file and function of the walk."""

import ast
import re
from pathlib import Path

import pytest

PACKAGE = Path(__file__).resolve().parents[2] / "plumb"
PAGE = (PACKAGE / "README.md").read_text()
WALK = PAGE[PAGE.index("## The way of a mark") :]
# A file, then a function in it: in two cells of the table, or one after the other in a sentence.
STEPS = re.findall(r"`(\w+/\w+\.py)`(?: \||) `([\w.]+)`", WALK)


def defined_in(file):
    """The names that a module defines; methods as Class.method."""
    names = set()
    for node in ast.parse((PACKAGE / file).read_text()).body:
        if isinstance(node, (ast.FunctionDef, ast.ClassDef)):
            names.add(node.name)
        for inner in getattr(node, "body", []):
            if isinstance(node, ast.ClassDef) and isinstance(inner, ast.FunctionDef):
                names.add(f"{node.name}.{inner.name}")
    return names


def test_the_walk_is_there():
    assert len(STEPS) >= 6


@pytest.mark.parametrize(("file", "function"), STEPS)
def test_each_function_of_the_walk_is_in_its_file(file, function):
    assert function in defined_in(file)


def test_each_file_of_the_walk_exists():
    for file in re.findall(r"`(\w+/\w+\.py)`", WALK):
        assert (PACKAGE / file).is_file(), file


def test_each_room_has_its_row():
    rooms = {path.parent.name for path in PACKAGE.glob("*/__init__.py")}
    rows = re.findall(r"^\| \d+ \| (`.+?`) \|", PAGE, re.MULTILINE)
    assert rooms == set(re.findall(r"`(\w+)/`", " ".join(rows)))
