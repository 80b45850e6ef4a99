"""The pages have the messages of the firmware and of `plumb` in the same words."""

import ast
import re
from collections.abc import Iterator

import pytest
from example_machine import ROOT

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


def pages() -> str:
    """All that the pages for makers and the table of codes say, in one line."""
    files = [*sorted((ROOT / "docs").glob("*.md")), ROOT / "lib/GCode/README.md"]
    return " ".join(" ".join(file.read_text(encoding="utf-8") for file in files).split())


@pytest.mark.parametrize("message", sorted(messages()))
def test_a_page_explains_what_the_firmware_says(message: str) -> None:
    assert message in pages(), "docs/trouble.md is the place for it"


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
    if path.is_dir() and path.name not in ("bench", "model", "examples")
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
