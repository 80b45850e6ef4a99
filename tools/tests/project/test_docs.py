"""Tests of the pages: links lead somewhere, named files exist, every command has a page."""

from __future__ import annotations

import argparse
import re
from collections.abc import Iterator
from pathlib import Path

import pytest
from example_machine import ROOT
from plumb.cli.main import build_parser

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
