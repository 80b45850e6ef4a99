"""The rooms of the package: their page names what exists, and an effect is known by its traits."""

import ast
import re
from pathlib import Path

import pytest
from plumb.model.catalogue import effect_names, empirical_effects

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


NAMES = {*effect_names(), *(effect["name"] for effect in empirical_effects())}
# Where effects are written, and stories of particular effects on particular boards.
OF_EFFECTS = ("model/catalogue",)
STORIES = {
    # What published settings leave out, and what a usual machine has.
    "bench/boards.py",
    "bench/kinds.py",
    # How much every machine has of a number, with its source.
    "diagnosis/priors.py",
    # The example of an option, whose help must not wait for the catalogue.
    "cli/add.py",
    "cli/arguments.py",
    # A question to the owner about the links of a chain.
    "lab/known.py",
    "cure/decision.py",
}
REMEDY = "give the effect a trait (lib/Kinematics/src/effect.h) and ask plumb.model.catalogue"


def test_no_module_names_an_effect():
    named = [
        f"{path.relative_to(PACKAGE)}:{line}: {name}: {REMEDY}"
        for path in sorted(PACKAGE.rglob("*.py"))
        if not is_exempt(path.relative_to(PACKAGE).as_posix())
        for line, name in effects_named(path)
    ]
    assert not named, "\n".join(named)


def test_every_exempt_module_still_exists():
    assert all((PACKAGE / story).is_file() for story in STORIES)


def is_exempt(name):
    """Whether a module may name effects."""
    return name in STORIES or name.startswith(OF_EFFECTS)


def effects_named(path):
    """Line and name of each effect that a string of the module names; comments may."""
    tree = ast.parse(path.read_text(encoding="utf-8"))
    documented = (ast.Module, ast.ClassDef, ast.FunctionDef)
    words = {
        id(node.body[0].value)
        for node in ast.walk(tree)
        if isinstance(node, documented) and ast.get_docstring(node)
    }
    for node in ast.walk(tree):
        if isinstance(node, ast.Constant) and isinstance(node.value, str) and id(node) not in words:
            for word in node.value.replace(".", " ").replace("=", " ").replace(":", " ").split():
                if word.strip("`,;()[]'\"") in NAMES:
                    yield node.lineno, word.strip("`,;()[]'\"")
