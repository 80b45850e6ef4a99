"""Sentences of answers: the commands of the six questions and the routes of the page compose none.

plumb/words does. A refusal and a help text stand where they belong.
"""

import ast
from collections.abc import Iterator
from pathlib import Path

import tree

QUESTIONS = ("add", "calibrate", "check", "compare", "diagnose", "next")
ROOMS = (*(f"cli/{name}.py" for name in QUESTIONS), "lab/routes/*.py", "lab/report.py")
MOST = 2  # words of a label with a value in it
OWN = ("add_argument", "add_shared")  # they take help texts


def violations(root: Path) -> Iterator[str]:
    """Yield each text that joins values by more words than a label has."""
    for pattern in ROOMS:
        for path in sorted((root / "tools/plumb").glob(pattern)):
            for text in composed(ast.parse(path.read_text(encoding="utf-8"))):
                words = " ".join(_words(text))
                yield f"{path.relative_to(root)}:{text.lineno}: '{words}' belongs into plumb/words"


def composed(module: ast.Module) -> Iterator[ast.JoinedStr]:
    """Yield the sentences that a module puts together."""
    inside = set[ast.AST]()
    for node in ast.walk(module):
        if isinstance(node, ast.Raise) or (isinstance(node, ast.Call) and _is_own(node.func)):
            inside.update(ast.walk(node))
        if isinstance(node, ast.JoinedStr) and node not in inside and len(_words(node)) > MOST:
            yield node


def _is_own(called: ast.expr) -> bool:
    name = called.attr if isinstance(called, ast.Attribute) else getattr(called, "id", "")
    return name in OWN or name.endswith("Error")


def _words(text: ast.JoinedStr) -> list[str]:
    said = " ".join(str(part.value) for part in text.values if isinstance(part, ast.Constant))
    return [word for word in said.split() if word.strip(".,:;()").isalpha()]


if __name__ == "__main__":
    tree.run(violations, "sentences: plumb/words composes them all")
