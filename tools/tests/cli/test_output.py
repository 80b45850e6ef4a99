"""Where results go: nothing is replaced that plumb did not write, devices and pipes stay."""

import os
import stat
import threading
import tomllib
from pathlib import Path

import pytest
from example_machine import EXAMPLE
from plumb.cli.main import main
from systems import ON_POSIX

SETTINGS, MARKS, MACHINE = (
    str(EXAMPLE / name) for name in ("groundcontrol.ini", "marks.toml", "machine.toml")
)
ADD = ("add", SETTINGS, MARKS, "--effect", "chain_pitch")
LINES = ("settings", MACHINE, "--client", "none", "-o")
GRID = ("grid", "--preset", "nine")
# Commands with the option that names their result, and the name of a file for it.
WRITERS = [
    pytest.param((*ADD, "-o"), "machine.toml", id="add"),
    pytest.param(LINES, "machine.nc", id="settings"),
    pytest.param(("compare", SETTINGS, MARKS, "--picture"), "errors.png", id="png"),
    pytest.param((*GRID, "--output"), "grid.nc", id="grid"),
]


pytestmark = pytest.mark.usefixtures("here")


@pytest.mark.parametrize(("command", "name"), WRITERS)
def test_a_second_run_replaces_its_result_and_no_other_file(command, name, run):
    assert run(*command, name)[0] == 0
    first = Path(name).read_bytes()
    assert run(*command, name)[0] == 0
    assert Path(name).read_bytes() == first
    Path(name).write_text("my notes of a year\n")
    code, said, complaint = run(*command, name)
    assert code == 2 and said == "" and "--force" in complaint and complaint.count("\n") == 1
    assert Path(name).read_text() == "my notes of a year\n"
    assert run(*command, name, "--force")[0] == 0
    assert Path(name).read_bytes() == first
    Path(name).write_text("")
    assert run(*command, name)[0] == 0


def read_from(pipe, into):
    into.append(Path(pipe).read_bytes())


def through_a_pipe(name, write):
    """The bytes that `write` sends into a new pipe of that name, and its return value."""
    os.mkfifo(name)
    got = []
    reader = threading.Thread(target=read_from, args=(name, got), daemon=True)
    reader.start()
    answer = write()
    reader.join(10)
    assert stat.S_ISFIFO(os.stat(name).st_mode)
    return got[0], answer


@ON_POSIX
@pytest.mark.parametrize(("command", "name"), WRITERS)
def test_a_pipe_stays_a_pipe_and_gets_the_bytes(command, name, run):
    got, answer = through_a_pipe(name, lambda: run(*command, name))
    Path(name).unlink()
    assert answer[0] == 0 and run(*command, name)[0] == 0
    assert got == Path(name).read_bytes()


@ON_POSIX
def test_a_link_to_a_pipe_or_a_device_is_not_replaced(run):
    os.symlink("/dev/null", "null.toml")
    os.symlink("pipe", "link.toml")
    assert run(*ADD, "-o", "null.toml")[0] == 0
    assert os.path.islink("null.toml") and stat.S_ISCHR(os.stat("/dev/null").st_mode)
    got, answer = through_a_pipe("pipe", lambda: run(*ADD, "-o", "link.toml"))
    assert answer[0] == 0 and b"[frame]" in got and os.path.islink("link.toml")


@ON_POSIX
def test_a_link_to_a_file_stays_and_its_file_is_replaced(run):
    assert run(*ADD, "-o", "machine.toml")[0] == 0
    written = Path("machine.toml").read_bytes()
    os.symlink("machine.toml", "link.toml")
    os.symlink("nothing.toml", "dangling.toml")
    assert run(*ADD, "-o", "link.toml")[0] == 0 and os.path.islink("link.toml")
    assert run(*ADD, "-o", "dangling.toml")[0] == 0
    assert Path("nothing.toml").read_bytes() == written
    Path("machine.toml").write_text("notes\n")
    assert run(*ADD, "-o", "link.toml")[0] == 2 and Path("machine.toml").read_text() == "notes\n"


def test_a_full_disk_is_reported_in_one_line_and_leaves_nothing(run):
    picture = ("--picture", "fall.png")
    for command in ((*ADD, *picture, "-o"), LINES, (*GRID, "--output")):
        code, said, complaint = run(*command, "/dev/full")
        assert code == 2 and said == "" and complaint.count("\n") == 1
        assert "/dev/full" in complaint and "No space left" in complaint
        assert stat.S_ISCHR(os.stat("/dev/full").st_mode)
    assert os.listdir() == []


def test_a_dash_is_the_standard_output_and_the_report_goes_beside(run):
    code, said, report = run(*ADD, "-o", "-")
    assert code == 0 and "frame" in tomllib.loads(said) and "The error falls from" in report
    code, said, report = run(*LINES, "-")
    assert code == 0 and said.startswith("$0=2438.4\n") and "Written" in report
    code, said, _ = run(*GRID, "--output", "-")
    assert code == 0 and said == run(*GRID)[1]
    code, said, _ = run(*GRID, "--output", "grid.nc", "--marks", "-")
    assert code == 0 and "mark" in tomllib.loads(said)
    assert not Path("-").exists()


@ON_POSIX
def test_a_pipe_is_read_once(run):
    os.mkfifo("settings.ini")
    content = Path(SETTINGS).read_bytes()
    writer = threading.Thread(target=Path("settings.ini").write_bytes, args=(content,), daemon=True)
    writer.start()
    code, said, _ = run("compare", "settings.ini", MARKS)
    # The next command names the file that was given.
    report, usual = (
        text.partition("\nWhat is missing:") for text in (said, run("compare", SETTINGS, MARKS)[1])
    )
    assert code == 0 and report[1] and report[0] == usual[0]


def test_main_forgets_the_force_of_an_earlier_run():
    Path("machine.nc").write_text("notes\n")
    assert main([*LINES, "machine.nc", "--force"]) == 0
    Path("machine.nc").write_text("notes\n")
    assert main([*LINES, "machine.nc"]) == 2
