"""Each safety sentence of the owner's pages names the test that holds it, in docs/promises.md."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from example_machine import ROOT

PAGE = ROOT / "docs/promises.md"
LINK = re.compile(r"\[[^]]*\]\(([^)]+)\)")
ROW = re.compile(r"\| (.+) \| (.+) \|")


def plain(text: str) -> str:
    """The text without the marks of Markdown, in one line."""
    text = re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", text)
    return " ".join(re.sub(r"[*`]", "", text).split())


def part(page: str, begin: str, end: str) -> str:
    """The text between two lines of a page."""
    text = (ROOT / page).read_text(encoding="utf-8")
    return text.split(f"\n{begin}\n", 1)[1].split(f"\n{end}\n", 1)[0]


def bullets(text: str) -> list[str]:
    """The points of a list."""
    return [plain(each) for each in re.findall(r"^- (.+?)(?=\n- |\n\n|\Z)", text, re.M | re.S)]


def paragraphs(text: str) -> list[str]:
    return [plain(each) for each in text.strip().split("\n\n")]


def halting_codes() -> Iterator[str]:
    """The rows of the table of codes that halt the machine."""
    for row in part("lib/GCode/README.md", "## Every code", "## Quick characters").splitlines():
        cells = [cell.strip() for cell in row.strip("|").split("|")]
        if cells[-1].startswith("halts"):
            yield plain(cells[0])


def quick_characters() -> Iterator[str]:
    rows = part("lib/GCode/README.md", "## Quick characters", "## While the program waits")
    for row in rows.splitlines():
        if row.startswith("| ") and not row.startswith("| byte"):
            yield plain(row.split("|")[1])


def promised() -> dict[str, list[str]]:
    """The safety sentences of each page, by the page's path from docs."""
    different = part("docs/first-start.md", "## What is different", "What you can send:")
    beyond = part("docs/first-start.md", "## Beyond the sheet", "## Talk to it without a client")
    return {
        "first-start.md": bullets(different) + paragraphs(beyond),
        "../lib/GCode/README.md": [*halting_codes(), *quick_characters()],
        "states.md": bullets((ROOT / "docs/states.md").read_text(encoding="utf-8")),
    }


def tables() -> dict[str, list[tuple[str, str]]]:
    """The rows of docs/promises.md, by the page that their heading links to."""
    rows: dict[str, list[tuple[str, str]]] = {}
    page = ""
    for line in PAGE.read_text(encoding="utf-8").splitlines():
        if line.startswith("## "):
            page = LINK.findall(line)[0]
            rows[page] = []
        elif (match := ROW.fullmatch(line)) and match[1] != "promise":
            rows[page].append((plain(match[1]), match[2]))
    return rows


def held_by(promise: str, sentence: str) -> bool:
    """Whether a sentence begins with a promise, and the promise ends at the end of a word."""
    rest = sentence[len(promise) :]
    return sentence.startswith(promise) and not rest[:1].isalnum()


def missing_tests(cell: str) -> Iterator[str]:
    """Each file of a cell that does not exist, and each name that is not in the file before it."""
    parts = re.split(LINK, cell)
    if len(parts) < 3:
        yield "no test is named"
    for link, names in zip(parts[1::2], parts[2::2], strict=True):
        file = (PAGE.parent / link).resolve()
        if not file.is_file():
            yield link
            continue
        text = file.read_text(encoding="latin-1")
        yield from (
            f"{link}: {name}" for name in re.findall(r"`([^`]+)`", names) if name not in text
        )


@pytest.mark.parametrize("page", promised())
def test_each_safety_sentence_is_in_the_table(page):
    sentences = promised()[page]
    assert len(sentences) > 4
    promises = [promise for promise, _ in tables()[page]]
    lone = [each for each in sentences if not any(held_by(promise, each) for promise in promises)]
    assert lone == []


@pytest.mark.parametrize("page", promised())
def test_each_promise_is_still_on_its_page(page):
    sentences = promised()[page]
    gone = [
        promise
        for promise, _ in tables()[page]
        if not any(held_by(promise, sentence) for sentence in sentences)
    ]
    assert gone == []


def test_each_promise_names_a_test_that_exists():
    rows = [row for rows in tables().values() for row in rows]
    missing = [f"{promise}: {each}" for promise, cell in rows for each in missing_tests(cell)]
    assert missing == []
