"""The styles of a component's folder touch no other folder: all of them are in a single sheet."""

import re
from collections import defaultdict
from pathlib import Path

SOURCE = Path(__file__).resolve().parents[2] / "lab/src"
FRAME = {"screen"}  # of the shell: what is in it looks alike on all screens
MOST_LINES = 1400  # of all styles: what looks alike is a component of the shell
COMMENT = re.compile(r"/\*.*?\*/", re.DOTALL)
CLASS = re.compile(r"[a-z]*\.([\w-]+)")


def outermost_classes(text):
    """The classes at the beginning of each selector."""
    for selectors in re.findall(r"([^{}@;]+)\{", COMMENT.sub("", text)):
        for selector in selectors.split(","):
            if match := CLASS.match(selector.strip()):
                yield match[1]


def test_a_class_is_styled_in_a_single_file():
    files = defaultdict(set)
    for path in SOURCE.rglob("*.css"):
        for name in outermost_classes(path.read_text()):
            files[name].add(str(path.relative_to(SOURCE)))
    assert len(files) > 60
    twice = {name: where for name, where in files.items() if len(where) > 1 and name not in FRAME}
    assert twice == {}


def test_each_class_that_is_styled_is_on_the_page():
    source = "\n".join(path.read_text() for path in SOURCE.rglob("*.ts*"))
    styles = "".join(path.read_text() for path in SOURCE.rglob("*.css"))
    selectors = re.findall(r"([^{};]+)\{", COMMENT.sub("", styles))
    classes = {name for each in selectors for name in re.findall(r"\.([a-z][\w-]*)", each)}
    unused = [name for name in classes if not re.search(rf"(?<![\w-]){name}(?![\w-])", source)]
    assert len(classes) > 80 and unused == []
    assert styles.count("\n") <= MOST_LINES
