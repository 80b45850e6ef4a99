"""Whatever the firmware says in words is found on a page, in the same words."""

import re
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
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
