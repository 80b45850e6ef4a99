"""Prose: comments, docstrings and pages say the noun instead of `one` or `own`, spelled rightly.

codespell knows misspellings; it knows single words only, so the crutches, which depend on the words
around them, are found here.
"""

import ast
import re
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path

import tree

# A word that replaces a noun or fills a sentence. `one` counts only where a noun is missing.
CRUTCHES = re.compile(
    r"\b(?:own|ones|told|anew|besides?|so\s+many|stands?\s+in)\b"
    r"|\b(?:the|this|each|every|another|left|right|next|last|first|other|old|new|same|usual"
    r"|an?\s+\w+)\s+one\b"
    r"|(?<!by )(?<!by\n)\bone(?=[.,;:)])",
    re.IGNORECASE,
)
CXX_COMMENT = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.DOTALL)
# Of TypeScript; an address in a text has two slashes too.
SCRIPT_COMMENT = re.compile(r"(?<![:\"'`\w])//[^\n]*|/\*.*?\*/", re.DOTALL)
PYTHON_COMMENT = re.compile(r"^\s*#.*|(?<=  )# .*", re.MULTILINE)
# What a page quotes is not its prose: blocks of a screen, code, words and addresses of others.
QUOTED = re.compile(r"^```.*?^```$|^ {4}.*?$|`[^`\n]*`|\"[^\"\n]*\"|\]\([^)]*\)", re.DOTALL | re.M)
# Words that codespell takes for misspelled others.
SPELLED_RIGHTLY = "statics,fro,positionOf"
# History, and words of others.
LEFT_ALONE = {"CHANGELOG.md", "LICENSE"}


def violations(root: Path) -> Iterator[str]:
    """Yield each crutch and each misspelling, a line for each."""
    places, lines = [], []
    for path in tree.own_files(root):
        name = path.relative_to(root)
        if str(name) in LEFT_ALONE:
            continue
        for line, text in prose_of(path):
            prose = unquoted(text)
            lines += prose.splitlines()
            places += [f"{name}:{line + more}" for more in range(len(prose.splitlines()))]
            for match in CRUTCHES.finditer(prose):
                place = line + text[: match.start()].count("\n")
                yield f"{name}:{place}: {' '.join(match[0].split())}: say what is meant"

    yield from (f"{places[number]}: {why}" for number, why in misspelled(lines))


def misspelled(lines: list[str]) -> Iterator[tuple[int, str]]:
    """Yield the place in the list, and what codespell says, of each line with a misspelling."""
    command = [Path(sys.executable).with_name("codespell"), "-L", SPELLED_RIGHTLY, "-"]
    done = subprocess.run(command, input="\n".join(lines), capture_output=True, text=True)
    for number, why in re.findall(r"^(\d+): .*\n\t(.*)$", done.stdout, re.MULTILINE):
        yield int(number) - 1, why


def prose_of(path: Path) -> Iterator[tuple[int, str]]:
    """Line and text of each comment and docstring of a source file, or of a whole page."""
    text = tree.text_of(path)
    if path.suffix == ".md":
        yield 1, text
    elif path.suffix in tree.CXX:
        for match in CXX_COMMENT.finditer(text):
            if not match[0].startswith('"'):
                yield line_of(text, match.start()), match[0]
    elif path.suffix in tree.SCRIPT | {".css"}:
        for match in SCRIPT_COMMENT.finditer(text):
            yield line_of(text, match.start()), match[0]
    elif tree.is_python(path):
        for match in PYTHON_COMMENT.finditer(text):
            yield line_of(text, match.start()), match[0]
        yield from docstrings(text)


def docstrings(text: str) -> Iterator[tuple[int, str]]:
    """Line and text of each docstring."""
    for node in ast.walk(ast.parse(text)):
        if isinstance(node, (ast.Module, ast.ClassDef, ast.FunctionDef)):
            said = ast.get_docstring(node, clean=False)
            if said:
                yield node.body[0].lineno, said


def unquoted(text: str) -> str:
    """Return the text with blanks in place of what it quotes, so that places stay."""
    return QUOTED.sub(lambda match: re.sub(r"[^\n]", " ", match[0]), text)


def line_of(text: str, place: int) -> int:
    """Return the number of the line at a place of a text, from 1."""
    return text.count("\n", 0, place) + 1


if __name__ == "__main__":
    tree.run(violations, "prose: no crutch in comments, docstrings and pages")
