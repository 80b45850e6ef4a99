"""The pages have the messages of the firmware and of `plumb` in the same words."""

import ast
import re
from collections.abc import Iterator
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
TROUBLE = ROOT / "docs/trouble.md"
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


def pages() -> str:
    """All that the pages for makers and the table of codes say, in one line."""
    files = [*sorted((ROOT / "docs").glob("*.md")), ROOT / "lib/GCode/README.md"]
    return " ".join(" ".join(file.read_text(encoding="utf-8") for file in files).split())


@pytest.mark.parametrize("message", sorted(messages()))
def test_a_page_explains_what_the_firmware_says(message: str) -> None:
    assert message in pages(), "docs/trouble.md is the place for it"


def texts_of_plumb() -> set[str]:
    """The texts in the Python code, with ... for each value that is filled in."""
    found = set()
    for file in (ROOT / "tools/plumb").rglob("*.py"):
        for node in ast.walk(ast.parse(file.read_text(encoding="utf-8"))):
            if isinstance(node, ast.JoinedStr):
                found.add("".join(map(_text, node.values)))
            elif isinstance(node, ast.Constant) and isinstance(node.value, str):
                found.add(node.value)
    return found


def _text(part: ast.expr) -> str:
    return part.value if isinstance(part, ast.Constant) else "..."


def refusals_on_the_page() -> Iterator[str]:
    """The messages in the table of what `plumb` says."""
    table = TROUBLE.read_text(encoding="utf-8").split("\n## What `plumb` says\n")[1]
    for row in table.split("\n## ")[0].splitlines():
        if row.startswith("| `"):
            yield from re.findall(r"`([^`]+)`", row.split(" | ")[0])


def test_plumb_can_say_each_message_of_its_table() -> None:
    messages, texts = list(refusals_on_the_page()), texts_of_plumb()
    assert len(messages) > 20
    gone = [
        message
        for message in messages
        for part in re.split(r"\.\.\.|; ", message)
        if len(part.split()) > 1 and not any(part.strip(" ,'()[]") in text for text in texts)
    ]
    assert gone == [], "correct docs/trouble.md"
