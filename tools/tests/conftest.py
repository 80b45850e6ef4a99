"""What tests of the command line share: running one command, and asking it for JSON."""

import json

import pytest
from plumb.cli.main import main


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
    """Runs one command with --json; gives exit code and the object."""

    def command(*arguments):
        code, said, complaint = run(*arguments, "--json")
        assert complaint == ""
        return code, json.loads(said, parse_constant=pytest.fail)

    return command


@pytest.fixture
def file(tmp_path):
    """Writes a file and gives its path."""

    def write(name, text):
        path = tmp_path / name
        path.write_bytes(text if isinstance(text, bytes) else text.encode())
        return path

    return write
