"""Pages: links lead somewhere, named files exist, commands, messages and rooms have a place."""

from __future__ import annotations

import argparse
import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from example_machine import ROOT
from plumb.cli.main import build_parser
from plumb.model.catalogue import effect_names, empirical_effects

FOLDERS = ("docs", "lib", "src", "test", "tools")
# Files that a page tells the reader to write.
READERS_FILES = {"lib/Kinematics/src/effects/mount_give.h"}
# Tables that makers and engineers look things up in.
FOR_BOTH = {ROOT / "docs/settings.md", ROOT / "lib/GCode/README.md"}
LINK = re.compile(r"\]\(([^)\s]+)\)")
# A path from the project's folder, as pages name files and as commands take them.
NAMED = re.compile(r"(?<![\w./-])(?:docs|include|lib|src|test|tools)/[\w./-]*\w/?")


def pages(root: Path) -> list[Path]:
    """The pages that people write or generate."""
    below = (page for folder in FOLDERS for page in (root / folder).rglob("*.md"))
    shown = (
        page
        for page in below
        if not any(part[0] == "." or part == "node_modules" for part in page.parts)
    )
    return sorted({*root.glob("README.md"), *shown})


def prose(page: Path) -> Iterator[tuple[int, str]]:
    """The numbered lines of a page outside fenced blocks."""
    fenced = False
    for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
        if line.lstrip().startswith("```"):
            fenced = not fenced
        elif not fenced:
            yield number, line


def anchors(page: Path) -> set[str]:
    """The anchors of a page's headings, as GitHub makes them."""
    headings = (line.lstrip("#").strip() for _, line in prose(page) if line.startswith("#"))
    plain = (re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading) for heading in headings)
    return {re.sub(r"[^\w\- ]", "", heading).lower().replace(" ", "-") for heading in plain}


def broken_links(root: Path) -> Iterator[str]:
    """Each relative link that leads to no file, or to no heading of its page."""
    for page in pages(root):
        for number, line in prose(page):
            for target in LINK.findall(line):
                if re.match(r"[a-z]+:", target):
                    continue
                name, _, anchor = target.partition("#")
                file = (page.parent / name).resolve() if name else page
                if not file.exists() or (anchor and anchor not in anchors(file)):
                    yield f"{page.relative_to(root)}:{number}: {target}"


def missing_files(root: Path) -> Iterator[str]:
    """Each path from the project's folder that a page names and that does not exist."""
    for page in pages(root):
        for number, line in enumerate(page.read_text(encoding="utf-8").splitlines(), 1):
            for name in set(NAMED.findall(LINK.sub("]", line))) - READERS_FILES:
                if not (root / name).exists() and not (page.parent / name).exists():
                    yield f"{page.relative_to(root)}:{number}: {name}"


def listed_below(*headings: str) -> set[Path]:
    """The pages that the contents list below these headings."""
    contents = (ROOT / "docs/README.md").read_text(encoding="utf-8")
    parts = [contents.split(f"\n## {each}\n")[1].split("\n## ")[0] for each in headings]
    return {
        (ROOT / "docs" / target.partition("#")[0]).resolve()
        for target in LINK.findall("".join(parts))
    }


def commands() -> list[str]:
    """The commands of plumb."""
    actions = build_parser()._actions
    choices = next(each.choices for each in actions if isinstance(each, argparse._SubParsersAction))
    return list(choices)


def test_every_link_leads_to_a_file_and_a_heading() -> None:
    assert list(broken_links(ROOT)) == []


def test_no_page_for_makers_leads_to_a_page_for_engineers() -> None:
    makers = {ROOT / "README.md", *listed_below("For makers", "Commands")} - FOR_BOTH
    engineers = listed_below("For engineers")
    assert [
        f"{page.relative_to(ROOT)}: {target}"
        for page in sorted(makers)
        if page.suffix == ".md"
        for target in LINK.findall(page.read_text(encoding="utf-8"))
        if (page.parent / target.partition("#")[0]).resolve() in engineers
    ] == []


def test_every_file_that_a_page_names_exists() -> None:
    assert list(missing_files(ROOT)) == []


@pytest.mark.parametrize("command", commands())
def test_every_command_has_a_page_that_shows_it_and_names_its_help(command: str) -> None:
    contents = (ROOT / "docs/README.md").read_text(encoding="utf-8")
    listed = re.search(rf"\[plumb [^]]*\b{command}\b[^]]*\]\((commands/[\w-]+\.md)\)", contents)
    assert listed, f"docs/README.md lists no page of plumb {command}"
    page = (ROOT / "docs" / listed[1]).read_text(encoding="utf-8")
    blocks = "".join(re.findall(r"```console\n(.*?)```", page, re.DOTALL))
    assert re.search(rf"^\$ .*\bplumb {command} (?!--help)", blocks, re.MULTILINE)
    assert f"`plumb {command} --help`" in page


MESSAGES = ROOT / "docs/messages.md"
LITERALS = re.compile(r'(?:FLASH\(|WORD\(\w+,)\s*((?:"(?:[^"\\]|\\.)*"\s*)+)')


def messages() -> set[str]:
    """The texts of two words or more that the firmware can send, without the gaps for numbers."""
    found = set()
    for file in sorted((ROOT / "src").rglob("*.[ch]*")):
        for literals in LITERALS.findall(file.read_text(encoding="utf-8")):
            text = "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', literals))
            text = " ".join(text.replace("\\n", " ").replace("\\r", " ").split()).strip(" .,:;()")
            if re.search(r"[A-Za-z]{2,} [a-z]+", text):
                found.add(text)
    return found


def documents() -> str:
    """All that the documents for makers and the table of codes say, in one line."""
    files = [*sorted((ROOT / "docs").glob("*.md")), ROOT / "lib/GCode/README.md"]
    return " ".join(" ".join(file.read_text(encoding="utf-8") for file in files).split())


@pytest.mark.parametrize("message", sorted(messages()))
def test_a_page_explains_what_the_firmware_says(message: str) -> None:
    assert message in documents(), "docs/trouble.md is the place for it"


def refusals(room: str) -> Iterator[str]:
    """The words of each refusal in a room of `plumb`; `...` for each value that is filled in."""
    for file in sorted((ROOT / "tools/plumb" / room).rglob("*.py")):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and ast.unparse(node.func).endswith("Error"):
                parts = [part for text in node.args for part in ast.walk(text)]
                words = [part.value for part in parts if isinstance(part, ast.Constant)]
                text = "...".join(map(str, words))
                if re.search(r"[a-z]+ [a-z]+", re.sub(r"(is not|holds) (a )?$", "", text)):
                    yield text


# The judge's boards, and what a caller from Python did wrong, are no maker's business.
ROOMS = sorted(
    path.name
    for path in (ROOT / "tools/plumb").iterdir()
    if path.is_dir() and path.name not in ("model", "examples")
)


@pytest.mark.parametrize("room", ROOMS)
def test_a_page_has_the_words_of_each_refusal(room: str) -> None:
    quotes = {part for message in quoted_messages() for part in fixed_words(message)}
    unknown = [text for text in refusals(room) if not any(quote in text for quote in quotes)]
    assert unknown == [], "docs/messages.md is the place for it"


def texts_of_plumb() -> set[str]:
    """The texts in the code, with ... for each value that Python fills in."""
    page = (ROOT / "tools/page/src").rglob("*.ts*")
    found = {file.read_text(encoding="utf-8") for file in page}
    for file in (ROOT / "tools/plumb").rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.JoinedStr):
                found.add("".join(map(_text, node.values)))
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                found.add(node.value)
    return found


def _text(part: ast.expr) -> str:
    return part.value if isinstance(part, ast.Constant) else "..."


def quoted_messages() -> list[str]:
    """The messages in the tables of what `plumb` says."""
    rows = MESSAGES.read_text(encoding="utf-8").splitlines()
    left = [row.split(" | ")[0] for row in rows if row.startswith("| `")]
    return [message for cell in left for message in re.findall(r"`([^`]+)`", cell)]


def fixed_words(message: str) -> Iterator[str]:
    """The parts of a message of two words or more, without the gaps for what is filled in."""
    for part in re.split(r"\.\.\.|; ", message):
        if len(part.split()) > 1:
            yield part.strip(" ,'()[]")


def test_plumb_can_say_each_message_of_its_table() -> None:
    messages, texts = quoted_messages(), texts_of_plumb()
    assert len(messages) > 150
    gone = [
        message
        for message in messages
        for part in fixed_words(message)
        if not any(part in text for text in texts)
    ]
    assert gone == [], "correct docs/messages.md"


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
    "hidden.py",
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
