"""The commands on the pages run as shown: they print what the page shows, and their exit codes."""

from pathlib import Path

import pytest
from page_commands import faults_on, pages, rewritten

PAGES = pages()
# Their commands drive a machine, or fit and draw much. Those of README are run by
# cli/test_add.py too.
COMMANDS = ("calibrate", "lab", "next", "practice", "recover", "report", "send")
LONG = {"README.md", "docs/tutorial.md", *(f"docs/commands/{name}.md" for name in COMMANDS)}


@pytest.mark.parametrize(
    "page", [pytest.param(page, marks=pytest.mark.slow if page in LONG else ()) for page in PAGES]
)
def test_the_commands_of_a_page_run_as_shown(page: str, tmp_path: Path) -> None:
    faults = faults_on(PAGES[page], tmp_path)
    assert not faults, "\n".join(faults)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("```console\n$ echo a\nb\n```\n", "shown:\nb\n\nprinted:\na\n"),
        ("```console\n$ x=a\n\n$ echo $x\na\n```\n", ""),
        ("```console\n$ seq 4\n1\n...\n4\n```\n", ""),
        ("```console\n$ seq 4\n...\n1\n...\n```\n", ""),
        ("```console\n$ seq 4\n1\n...\n5\n```\n", "printed:\n1\n"),
        ("```console\n$ echo .....; seq 4\n.....\n1\n...\n4\n```\n", ""),
        ("```console\n$ echo ....\n.....\n```\n", "printed:\n....\n"),
        ('```console\n$ false; echo "exit $?"\nexit 1\n```\n', ""),
        ("```\nplumb gird      # a comment\n```\n", "exit 2:"),
        ("```\nplumb diagnose groundcontrol.ini marks.toml\n```\n", ""),
    ],
)
def test_a_page_that_shows_other_output_is_refused(text: str, fault: str, tmp_path: Path) -> None:
    said = "\n".join(faults_on(text, tmp_path))
    assert bool(said) == bool(fault)
    assert fault in said


def test_a_page_is_written_with_the_output_of_its_commands(tmp_path: Path) -> None:
    old = "text\n\n```console\n$ echo a\nb\n\n$ x=c\n$ echo $x\n```\n```\nplumb --help\n```\n"
    new = "text\n\n```console\n$ echo a\na\n\n$ x=c\n$ echo $x\nc\n```\n```\nplumb --help\n```\n"
    assert rewritten(old, tmp_path / "first") == new
    assert rewritten(new, tmp_path / "second") == new
