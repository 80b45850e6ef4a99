"""Tests of the table of commands: a file for each, with the same name."""

import inspect
import os
import shlex
import subprocess
import sys
from importlib import import_module
from pathlib import Path

import pytest
from plumb.cli import main
from plumb.cli.main import COMMANDS, GROUPS, build_parser

EXAMPLE = Path(__file__).resolve().parents[3] / "docs/example"
# What takes longer to load than the help of all commands may take.
HEAVY = ("numpy", "scipy", "matplotlib")


@pytest.mark.parametrize("name", COMMANDS)
def test_a_command_has_its_file_and_its_names(name):
    module = import_module(f"plumb.cli.{name}")
    assert COMMANDS[name][0].islower() and not COMMANDS[name].endswith(".")
    assert module.EXIT.startswith("Exit: 0 ")
    assert len(module.EXAMPLES) == 2
    assert list(inspect.signature(module.add_arguments).parameters) == ["parser"]
    assert list(inspect.signature(module.run).parameters) == ["arguments"]


@pytest.mark.parametrize("name", COMMANDS)
def test_the_examples_of_the_help_are_understood(name, monkeypatch, capsys, tmp_path):
    """Each file that they name is there; nothing is run."""
    for file in ("groundcontrol.ini", "machine.toml", "marks.toml", "pocket.nc"):
        (tmp_path / file).write_bytes((EXAMPLE / file).read_bytes())
    for file in ("first.toml", "check.toml", "errors.toml"):
        (tmp_path / file).write_text("")
    monkeypatch.chdir(tmp_path)
    with pytest.raises(SystemExit):
        main.main([name, "--help"])
    shown = capsys.readouterr().out
    assert import_module(f"plumb.cli.{name}").EXIT in " ".join(shown.split())
    for example in import_module(f"plumb.cli.{name}").EXAMPLES:
        assert f"\n  {example}\n" in shown
        words = shlex.split(example)
        assert build_parser().parse_args(words[1:]).command == name


def test_help_lists_the_commands_in_the_order_of_the_table():
    lines = build_parser().format_help().splitlines()
    listed = [line.split()[0] for line in lines if line.startswith("  ") and line[2:3].isalpha()]
    assert listed == [*COMMANDS]
    titles = [line[:-1] for line in lines if line.endswith(":") and not line.startswith("usage")]
    assert titles == [*GROUPS, "options"]


def test_help_of_all_and_refusals_of_commands_load_no_numerics():
    """One after the other in a fresh program: what a command loads, all later commands have too."""
    commands = [
        (["--help"], 0),
        (["--version"], 0),
        (["diagnoze"], 2),
    ]
    program = (
        "import sys\nfrom plumb.cli.main import main\n"
        f"for command, expected in {commands}:\n"
        "    try:\n        code = main(command)\n"
        "    except SystemExit as end:\n        code = end.code\n"
        f"    heavy = [name for name in {HEAVY} if name in sys.modules]\n"
        "    assert (code, heavy) == (expected, []), (command, code, heavy)\n"
    )
    done = subprocess.run([sys.executable, "-c", program], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr


def test_the_linear_algebra_has_one_thread():
    # On 405 marks `plumb next` took 14 s of CPU on two cores instead of 5.6.
    code = (
        "import os; from plumb.cli.main import main; main(['effects']); "
        "import sys; print(os.environ['OPENBLAS_NUM_THREADS'], file=sys.stderr)"
    )
    environment = {name: value for name, value in os.environ.items() if "_NUM_THREADS" not in name}
    run = subprocess.run(
        [sys.executable, "-c", code], env=environment, capture_output=True, text=True, check=True
    )
    assert run.stderr.split() == ["1"]
