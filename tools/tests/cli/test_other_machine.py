"""Commands refuse to mix marks of a machine with numbers of another, and say both values."""

import json
import shutil
from dataclasses import replace
from pathlib import Path

import plumb.cli.send as send_command
import pytest
from example_machine import EXAMPLE
from numbers_machine import NumbersMachine
from plumb import api
from plumb.cure.decision import record_of, toml_of
from plumb.firmware.settings import numbers_in_force
from plumb.settings import form_of, read_settings, with_form, write_machine_toml
from synthetic import BELIEVED, TRUE, csv_of, grid, marks_on

OTHER = replace(BELIEVED, motor_gap=BELIEVED.motor_gap + 30)
BOTH = "motor_gap ($2) is 3008.4 in other.toml and 2978.4 in the machine"


@pytest.fixture(autouse=True)
def board(here, monkeypatch):
    """A board that holds the numbers of machine.toml, in a folder with other.toml."""
    write_machine_toml("machine.toml", BELIEVED)
    write_machine_toml("other.toml", OTHER)
    board = NumbersMachine()
    board.numbers = numbers_in_force(BELIEVED)
    monkeypatch.setattr(send_command, "SerialPort", lambda path: board)
    return board


def grid_cut_with(run, settings):
    """A form and a program of a mark in the middle, made for these settings."""
    shape = ["--places=0,0", "--settings", settings]
    assert run("grid", *shape, "--marks", "marks.toml", "--output", "grid.nc")[0] == 0


def test_marks_of_another_machine_are_not_sent(run, board):
    grid_cut_with(run, "other.toml")
    code, _, said = run("send", "--port", "USB", "grid.nc")
    assert code == 2 and BOTH in said and "Which holds?" in said
    assert board.written == []


def test_marks_of_this_machine_are_sent_and_others_with_force(run, board):
    # The board knows numbers alone, so a line that moves must have come to it.
    for settings, force in (("machine.toml", []), ("other.toml", ["--force"])):
        board.answer = lambda line, answer=board.answer: answer(line) if "$" in line else []
        Path("marks.toml").unlink(missing_ok=True)
        Path("grid.nc").unlink(missing_ok=True)
        grid_cut_with(run, settings)
        code, said, refused = run("send", "--port", "USB", "grid.nc", *force)
        assert code == 0 and "the machine took each" in said, refused


def fitted(name, settings):
    """A machine.toml that was fitted to marks which were cut with these settings."""
    write_machine_toml("before.toml", settings)
    marks = marks_on(TRUE, settings, grid(3, 3), noise=0.1, seed=3)
    Path("read.csv").write_text(csv_of(marks))
    inputs = api.read("before.toml", "read.csv")
    made = api.add(inputs)
    Path(name).write_bytes(toml_of(made, source="read.csv", record=record_of(made, inputs)))
    return read_settings(name)


def test_a_fit_to_marks_of_another_machine_is_not_written(run, board):
    fitted("fit.toml", OTHER)
    code, _, said = run("send", "--port", "USB", "fit.toml")
    assert code == 2 and board.written == []
    assert "fit.toml was fitted to marks of another machine" in said
    assert "motor_gap ($2) is 3008.4 in before.toml and 2978.4 in the machine" in said
    assert run("send", "--port", "USB", "fit.toml", "--force")[0] == 0
    assert board.written != []


def test_a_fit_is_written_into_its_machine_and_into_a_machine_that_holds_it(run, board):
    settings = fitted("fit.toml", BELIEVED)
    assert run("send", "--port", "USB", "fit.toml")[0] == 0
    assert board.numbers[2] == pytest.approx(settings.motor_gap, rel=1e-6)
    code, said, report = run("send", "--port", "USB", "fit.toml", "--json")
    answer = json.loads(said)
    assert code == 0 and answer["changed"] == {} and answer["stopped_at"] is None
    assert answer["lines"] > 10 and "each was read back" in report and Path(answer["kept"]).exists()
    board.numbers[2] -= 1
    answer = json.loads(run("send", "--port", "USB", "fit.toml", "--force", "--json")[1])
    assert answer["changed"]["2"] == pytest.approx([settings.motor_gap - 1, settings.motor_gap])


@pytest.mark.parametrize("command", [["calibrate"], ["add", "--effect", "auto"]])
def test_settings_of_a_machine_that_did_not_cut_the_marks_are_not_corrected(run, command):
    shutil.copy(EXAMPLE / "groundcontrol.ini", "cut.ini")
    text = (EXAMPLE / "groundcontrol.ini").read_text().replace("2978.4", "3008.4")
    Path("wrong.ini").write_text(text)
    text = (EXAMPLE / "marks.toml").read_text()
    Path("marks.toml").write_text(f'cut_with = "cut.ini"\n{text}')
    before = set(Path().iterdir())
    name, *more = command
    code, _, said = run(name, "wrong.ini", "marks.toml", *more)
    assert code == 2 and set(Path().iterdir()) == before
    assert "motor_gap ($2) is 3008.4 in wrong.ini and 2978.4 in cut.ini" in said
    assert run(name, "wrong.ini", "marks.toml", *more, "--cut-with", "cut.ini")[0] != 2
    assert run(name, "cut.ini", "marks.toml", *more)[0] != 2


@pytest.mark.parametrize("form", ["marks.toml", "a b/marks-2.toml", "../marks.toml"])
def test_a_program_says_which_form_is_its_own(form):
    text = with_form("(Plumb calibration grid)\nG21\n", f"jobs/{form}", "jobs/grid.nc")
    assert text.splitlines()[1] == f"(form: {form})"
    assert Path(form_of(text, "jobs/grid.nc")) == Path("jobs", form)


def test_a_form_on_another_drive_is_named_whole(monkeypatch):
    def no_way(*_):
        raise ValueError("path is on mount 'D:', start on mount 'C:'")

    monkeypatch.setattr("os.path.relpath", no_way)
    whole = Path("/form.toml").absolute().as_posix()
    assert form_of(with_form("G21\nM2\n", "/form.toml", "grid.nc"), "grid.nc") == whole
