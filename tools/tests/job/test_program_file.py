"""Files that hold no program are refused before any line is sent, each with a fitting line."""

from pathlib import Path

import plumb.cli.send as send_command
import pytest
from example_machine import EXAMPLE
from plumb.cli.main import main
from plumb.job.dry_run import refuse_what_is_no_program

ROOT = Path(__file__).parents[3]
NUMBERS = "numbers are sent from a machine.toml"
CODE = "give a program of G-code"


class ReachedError(Exception):
    """A line was about to be opened."""


@pytest.fixture(autouse=True)
def line(monkeypatch):
    def opened(_path):
        raise ReachedError

    monkeypatch.setattr(send_command, "SerialPort", opened)


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("groundcontrol.ini", f"holds settings of GroundControl, not a program; {NUMBERS}"),
        ("marks.toml", f"holds marks, not a program; {CODE}"),
        (".", "is a folder; name the file inside it"),
        ("nothing.nc", "there is no such file; check the name"),
    ],
)
def test_files_that_are_not_programs_are_refused_before_the_line_is_opened(name, said, capsys):
    path = EXAMPLE / name
    assert main(["send", "--port", "USB", str(path)]) == 2
    assert capsys.readouterr().err == f"plumb: {path}: {said}\n"


@pytest.mark.parametrize("text", ["%\nG21\n", "G5 X1\n", "G1 X1\n", "B05\n", "$$\n", "; nothing\n"])
def test_other_faults_are_left_to_the_machine(text):
    refuse_what_is_no_program("job", text)


def test_lines_and_a_machine_toml_are_accepted(tmp_path):
    text = (EXAMPLE / "machine.toml").read_text()
    (tmp_path / "machine.toml").write_text(f"# Säge\n{text}")  # which is not sent as it is
    for what in ("hello", str(tmp_path / "machine.toml"), str(EXAMPLE / "pocket.nc")):
        with pytest.raises(ReachedError):
            main(["send", "--port", "USB", what])
