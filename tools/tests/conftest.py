"""Fixtures that run a command, and ask it for JSON."""

import json
import os
import shutil
import sys
import tempfile
from unittest.mock import MagicMock

import asked_again
import pytest
from chromium import QUIET
from jsonschema import Draft202012Validator
from plumb.cli import output
from plumb.cli.answers import schema
from plumb.cli.main import main
from plumb.text.compiled import stale_source

if os.name == "nt":  # there the tests without a browser run alone
    none = MagicMock(sync_playwright=lambda: pytest.skip("Wine has no browser"))
    sys.modules["playwright"] = sys.modules["playwright.sync_api"] = none
SCHEMA = schema()


def pytest_configure(config):
    """Old modules would be tested in place of the sources that are here."""
    if source := stale_source():
        pytest.exit(f"{source}: the lab was built without this change; run tools/setup", 2)
    output.refuse_stale = lambda: None  # no command of this process has to look again
    if asked_again.FOLDER not in os.environ:  # else the run has begun in another process
        folder = tempfile.TemporaryDirectory()
        os.environ[asked_again.FOLDER] = folder.name
        config.add_cleanup(folder.cleanup)
    asked_again.remember()


@pytest.fixture
def run(capsys):
    """Runs one command; gives exit code, standard output and standard error."""

    def command(*arguments):
        code = main([str(argument) for argument in arguments])
        said = capsys.readouterr()
        return code, said.out, said.err

    return command


@pytest.fixture
def ask(run):
    """Runs one command with --json; gives exit code and the object, which is as the schema says."""

    def command(*arguments):
        code, said, complaint = run(*arguments, "--json")
        assert complaint == ""
        answer = json.loads(said, parse_constant=pytest.fail)
        command_schema = {**SCHEMA, "anyOf": [{"$ref": f"#/$defs/{arguments[0]}"}]}
        Draft202012Validator(command_schema).validate(answer)
        return code, answer

    return command


@pytest.fixture
def here(tmp_path, monkeypatch):
    """A folder in which the commands of a test run."""
    monkeypatch.chdir(tmp_path)
    return tmp_path


@pytest.fixture
def file(tmp_path):
    """Writes a file and gives its path."""

    def write(name, text):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write


@pytest.fixture(scope="session")
def browser():
    """Debian's Chromium, one for all rooms that a worker tests."""
    from playwright.sync_api import sync_playwright  # most rooms need no browser

    with sync_playwright() as playwright:
        running = playwright.chromium.launch(
            executable_path=shutil.which("chromium"), args=QUIET, headless=True
        )
        yield running
        running.close()
