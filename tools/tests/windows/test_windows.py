"""The package for Windows, by a Windows Python under Wine: the main way, from marks to a cut."""

import re
import shutil
import socket
import subprocess
import sys
import time
from pathlib import Path
from urllib.request import Request, urlopen

import asked_again
import pytest

pytestmark = pytest.mark.slow
ROOT = Path(__file__).resolve().parents[3]
PLUMB, PYTHON = ROOT / "tools/windows/plumb", ROOT / "tools/windows/python"
HEARD = {"stdout": subprocess.PIPE, "stderr": subprocess.STDOUT}  # Wine knows not all files
# Not: pages, project and rates, which are of the tree; senders, whose machine is at a pseudo
# terminal.
SUITES = (
    "text settings marks grid diary line model report",
    *("fit", "diagnosis", "plan", "cure", "cli", "job", "api guide firmware", "vm", "lab"),
)
NOT_UNDER_WINE = (
    "cli/test_short_answers.py",  # rich takes it for an old console, whose lines are one shorter
    "diagnosis/test_evidence_by_force.py",  # asks SciPy for what that of Wine 8 lacks
    *("text/test_compiled.py", "lab/test_built_page.py"),  # of the tree, not of a package
    # They need the simulated Mega.
    *(f"firmware/test_{name}.py" for name in ("firmware_elf", "two_events_on_the_mega")),
    # They open pseudo terminals.
    "lab/test_broken_cut.py",
    *("line/test_line_lock.py", "vm/test_clients.py", "vm/test_flash.py", "vm/test_links.py"),
    "vm/test_serial_port.py",
)
START = 120  # [s] in which a program under Wine must have begun


@pytest.fixture(scope="module")
def folder(tmp_path_factory):
    """A folder with settings and marks; what setup says if there is no Windows Python."""
    done = subprocess.run([ROOT / "tools/setup", "windows"], capture_output=True, text=True)
    assert done.returncode == 0, done.stderr
    folder = tmp_path_factory.mktemp("garage")
    for file in ("groundcontrol.ini", "marks.toml"):
        shutil.copy(ROOT / "docs/example" / file, folder)
    return folder


def plumb(folder: Path, *words: str, code: int = 0) -> str:
    """What a command says, which must end with this exit code."""
    done = subprocess.run([PLUMB, *words], cwd=folder, input="", text=True, timeout=600, **HEARD)
    assert done.returncode == code, done.stdout
    return done.stdout


@pytest.fixture
def served(folder):
    """Starts a command that goes on, and returns what it says first; ended with the test."""
    running = []

    def start(pattern: str, *words: str) -> str:
        program = subprocess.Popen(
            [PLUMB, *words], cwd=folder, stdin=subprocess.PIPE, text=True, **HEARD
        )
        running.append(program)
        end = time.monotonic() + START
        while time.monotonic() < end:
            line = program.stdout.readline()
            assert line, "it ended"
            if found := re.search(pattern, line):
                return found[1]
        raise AssertionError("it says nothing")

    yield start
    for program in running:
        program.kill()
        program.wait()


def test_the_diagnosis_is_that_of_linux(folder):
    words = ["diagnose", "groundcontrol.ini", "marks.toml"]
    command = [sys.executable, "-m", "plumb.cli.start", *words]
    linux = subprocess.run(command, cwd=folder, capture_output=True, text=True)
    assert plumb(folder, *words, code=linux.returncode) == linux.stdout


@pytest.mark.parametrize("suite", SUITES)
def test_a_suite_that_needs_no_pseudo_terminal_passes(folder, suite, monkeypatch):
    monkeypatch.delenv(asked_again.FOLDER, raising=False)  # it works out answers of its own
    paths = [f"tools/tests/{name}" for name in suite.split()]
    left_out = [f"--ignore=tools/tests/{name}" for name in NOT_UNDER_WINE]
    command = [PYTHON, "-m", "pytest", "-q", "-p", "no:cacheprovider", "-m", "not slow"]
    how = {"cwd": ROOT, "input": "", "text": True, "timeout": 1800, **HEARD}
    done = subprocess.run([*command, *left_out, *paths], **how)
    assert done.returncode == 0, done.stdout[-3000:]


def test_the_error_falls_and_all_is_written(folder):
    words = ["--checked", "tape_scale.strain=0+-0.1mm", "--checked", "motor_gap=2980.4+-1"]
    words += ["--checked", "motor_height=1069.6+-1", "-o", "new.toml"]
    said = plumb(folder, "calibrate", "groundcontrol.ini", "marks.toml", *words)
    before, after = map(float, re.search(r"from\s+([\d.]+) to ([\d.]+) mm", said).groups())
    assert after < before / 2
    plumb(folder, "report", "groundcontrol.ini", "marks.toml", "-o", "report.html")
    assert (folder / "new.toml").read_bytes().count(b"\r") == 0
    for name in ("new-groundcontrol.ini", "diary.jsonl", "report.html"):
        assert (folder / name).is_file()


def test_a_virtual_machine_is_sent_a_program_and_read(folder, served):
    link = ("--link", "socket://localhost:0")
    port = served(r"The machine is at (socket://localhost:\d+)", "vm", "--speed", "10", *link)
    plumb(folder, "grid", "--places=0,100 100,100", "--output", "grid.nc")
    assert "the machine took each" in plumb(folder, "send", "--port", port, "grid.nc")
    assert "The sled is at x " in plumb(folder, "read", "--port", port)


def test_the_lab_answers_a_browser_outside(folder, served):
    with socket.create_server(("127.0.0.1", 0)) as free:
        number = free.getsockname()[1]
    address = served(r"(http://\S+)", "lab", ".", "--no-browser", "--port", str(number))
    begin, token = address.split("/?token=")
    assert b"<title>" in urlopen(address, timeout=START).read()
    asked = Request(f"{begin}/api/project", headers={"x-plumb-token": token})
    assert b"groundcontrol.ini" in urlopen(asked, timeout=START).read()
