"""Tests of the table of commands: a file for each, with the same four names."""

import inspect
from pathlib import Path

import pytest
from plumb.cli import main
from plumb.cli.main import COMMANDS, build_parser

FOLDER = Path(main.__file__).parent
# Files of the room that are no commands.
SHARED = {"__init__", "add_text", "checked", "demo", "files", "main", "places_text", "text"}


def test_each_file_is_a_command_or_shared():
    assert {path.stem for path in FOLDER.glob("*.py")} == set(COMMANDS) | SHARED


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_has_its_file_and_its_four_names(name):
    module = COMMANDS[name]
    assert module.__name__ == f"plumb.cli.{name}"
    assert module.HELP and module.HELP[0].islower() and not module.HELP.endswith(".")
    assert module.EXIT.startswith("Exit: 0 ")
    assert list(inspect.signature(module.add_arguments).parameters) == ["parser"]
    assert list(inspect.signature(module.run).parameters) == ["arguments"]


def test_help_lists_the_commands_in_the_order_of_the_table():
    lines = build_parser().format_help().splitlines()
    listed = [line.split()[0] for line in lines if line.startswith("    ") and line[4:5].isalpha()]
    assert listed == [*COMMANDS]
