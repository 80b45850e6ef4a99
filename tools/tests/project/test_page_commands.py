"""The commands on the pages run as shown: they print what the page shows, and their exit codes."""

import os
import subprocess
from pathlib import Path

import page_commands
import pytest
from page_commands import faults_on, pages, rewritten
from preloaded import preloaded

PAGES = pages()
# Their commands drive a machine, or fit and draw much. Those of README are run by
# cli/test_client_files.py too.
COMMANDS = ("bench", "calibrate", "lab", "next", "practice", "recover", "report", "send")
LONG = {"README.md", *(f"docs/commands/{name}.md" for name in COMMANDS)}


@pytest.mark.parametrize(
    "page", [pytest.param(page, marks=pytest.mark.slow if page in LONG else ()) for page in PAGES]
)
def test_the_commands_of_a_page_run_as_shown(page: str, tmp_path: Path) -> None:
    faults = faults_on(PAGES[page], tmp_path)
    assert not faults, "\n".join(faults)


@pytest.mark.parametrize(
    ("text", "fault"),
    [
        ("```console\n$ echo a\na\n```\n", ""),
        ("```console\n$ echo a\n```\n", "shown:\n\nprinted:\na\n"),
        ("```console\n$ echo a\nb\n```\n", "shown:\nb\n\nprinted:\na\n"),
        ("```console\n$ x=a\n\n$ echo $x\na\n```\n", ""),
        ("```console\n$ false\n```\n", "$ false\nexit 1:\n"),
        ('```console\n$ false; echo "exit $?"\nexit 1\n```\n', ""),
        ("```\nplumb gird      # a comment\n```\n", "exit 2:"),
        ("```\nplumb reach machine.toml --most-give 0.01\n```\n", ""),
        ("```\ntools/test\n```\n", ""),
        ("```toml\nplumb gird\n```\n", ""),
    ],
)
def test_a_page_that_shows_something_else_is_caught(text: str, fault: str, tmp_path: Path) -> None:
    said = "\n".join(faults_on(text, tmp_path))
    assert bool(said) == bool(fault)
    assert fault in said


def test_a_command_that_does_not_end_is_named(tmp_path: Path, monkeypatch) -> None:
    monkeypatch.setattr(page_commands, "PATIENCE", 2)
    text = "```console\n$ echo a\na\n$ echo b; sleep 1000\n```\n"
    assert faults_on(text, tmp_path) == ["$ echo b; sleep 1000\nhas not ended:\nb\n"]


def test_a_page_is_written_with_what_its_commands_print(tmp_path: Path) -> None:
    old = "text\n\n```console\n$ echo a\nb\n\n$ x=c\n$ echo $x\n```\n```\nplumb --help\n```\n"
    new = "text\n\n```console\n$ echo a\na\n\n$ x=c\n$ echo $x\nc\n```\n```\nplumb --help\n```\n"
    assert rewritten(old, tmp_path / "first") == new
    assert rewritten(new, tmp_path / "second") == new


def test_a_command_ends_with_the_client_that_asked_for_it(tmp_path: Path) -> None:
    endless = tmp_path / "machine.toml"
    os.mkfifo(endless)
    with preloaded() as folder:
        client = subprocess.Popen(
            [folder / "plumb", "settings", endless],
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
        )
        writer = os.open(endless, os.O_WRONLY)  # opens when the command reads
        client.kill()
        client.communicate(timeout=60)  # its output ends when nobody is left who could write it
        os.close(writer)
