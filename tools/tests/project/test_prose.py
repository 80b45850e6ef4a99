"""Tests of tools/checks/prose.py: it refuses crutches in prose and leaves quotes alone."""

import pytest
from test_project_checks import plant, said

# Put together here, so that the check does not meet them in this file.
PROSE = [
    "its o" + "wn name",
    "the left o" + "ne pulls",
    "a chain, and the ne" + "xt one.",
    "no chain is a short o" + "ne",
    "longer ones than these",
    "if there is o" + "ne, it counts",
    "what was to" + "ld",
    "be" + "side it",
    "So ma" + "ny marks",
    "written a" + "new",
    "it stan" + "ds in for a board",
]


@pytest.mark.parametrize("line", PROSE)
def test_prose_refuses_in_a_page(tmp_path, line):
    code, out = said("prose", plant(tmp_path, {"docs/page.md": f"first\n{line}\n"}))
    assert code == 1
    assert out.startswith("docs/page.md:2:") and out.count("\n") == 1


@pytest.mark.parametrize(
    ("name", "text", "line"),
    [
        ("src/a.h", 'int a;\nf("x");  // {}\n', 2),
        ("src/a.cpp", "/// first\n/// {}\nint a;\n", 2),
        ("src/a.h", "int a;\n/* first\n   {} */\n", 3),
        ("tools/a.py", '"""First.\n\n{}\n"""\n', 3),
        ("tools/a.py", "x = 1\ny = 2  # {}\n", 2),
        ("tools/a.py", 'def f():\n    """{}"""\n', 2),
    ],
)
def test_prose_refuses_in_a_comment(tmp_path, name, text, line):
    code, out = said("prose", plant(tmp_path, {name: text.format(PROSE[0])}))
    assert code == 1
    assert out.startswith(f"{name}:{line}:") and out.count("\n") == 1


@pytest.mark.parametrize(
    ("name", "text"),
    [
        ("docs/page.md", "one mark, one of them, one by one, at least one line\n"),
        ("docs/page.md", "```\nthe o" + "wn screen\n```\n"),
        ("docs/page.md", "the file `o" + "wn.toml`, [a page](o" + "wn.md)\n"),
        ("CHANGELOG.md", "its o" + "wn history\n"),
        ("src/a.cpp", 'say("o" "wn, // its o' + 'wn");\n'),
        ("tools/a.py", "print('its o" + "wn')\n"),
    ],
)
def test_prose_allows(tmp_path, name, text):
    assert said("prose", plant(tmp_path, {name: text}))[0] == 0
