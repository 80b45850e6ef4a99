"""Tests of interrupted commands, closed pipes and full disks."""

import errno
import functools
import json
import os
import signal
import subprocess
import sys
from pathlib import Path

import pytest
from plumb.cli.output import INTERRUPTED, ended
from published_marks import MARKS, SETTINGS
from systems import ON_POSIX

TOOLS = Path(__file__).resolve().parents[2]
PLUMB = [sys.executable, "-m", "plumb.cli.main"]
COMPARE = [*PLUMB, "compare", str(SETTINGS), str(MARKS)]

# A lane of tools/test ignores Ctrl-C, and what it starts would too.
INTERRUPTIBLE = functools.partial(
    subprocess.Popen, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)
)


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["diagnoze"], "there is no command 'diagnoze'; did you mean diagnose?; see plumb --help"),
        (["xyz"], "there is no command 'xyz'; see plumb --help"),
        (["effects", "--jason"], "no option --jason here; did you mean --json?; see plumb effects"),
        (["effects", "--jason=1"], "no option --jason here; did you mean --json?"),
        (
            ["compare", str(SETTINGS), str(MARKS), "--lnie", "5"],
            "there is no option --lnie here; see plumb compare --help",
        ),
        (["resume", str(SETTINGS), "--lnie", "5"], "no option --lnie here; did you mean --line?"),
        (["effects", "--colour"], "there is no option --colour here; see plumb effects --help"),
        (["effects", "more"], "there is no argument more here; see plumb effects --help"),
        (["bench", "--kinds"], "expected at least one argument; see plumb bench --help"),
        (
            ["compare", str(SETTINGS), str(MARKS), "--controller", "holy"],
            "--controller: 'holy' is not known; did you mean holey?; see plumb compare --help",
        ),
        (
            ["compare", str(SETTINGS), str(MARKS), "--controller", "grbl"],
            "'grbl' is not known; give stock, holey, plumb; see plumb compare --help",
        ),
    ],
)
def test_a_wrong_word_is_answered_with_the_nearest_right_one(words, said, run):
    code, out, complaint = run(*words)
    assert code == 2 and out == "" and complaint.count("\n") == 1
    assert said in complaint


@ON_POSIX
def test_an_interrupt_while_the_package_loads_is_quiet(tmp_path):
    (tmp_path / "plumb/cli").mkdir(parents=True)
    (tmp_path / "plumb/__init__.py").write_text("import os, time; os.kill(os.getpid(), 2)\n")
    command = [sys.executable, "-S", str(TOOLS / "core/plumb"), "effects"]
    look_here = {"PYTHONPATH": str(tmp_path)}
    with INTERRUPTIBLE(command, stderr=subprocess.PIPE, env=look_here) as process:
        _, complaint = process.communicate(timeout=60)
    assert (process.returncode, complaint) == (-signal.SIGINT, b"")
    # In the background of a shell a signal that is ignored stays so.
    ignored = f"trap '' INT; exec {sys.executable} -S {TOOLS / 'core/plumb'} --version"
    done = subprocess.run(["bash", "-c", ignored], env=look_here, capture_output=True, text=True)
    assert "No module named 'plumb.cli.start'" in done.stderr


@ON_POSIX
def test_ctrl_c_ends_quietly(tmp_path):
    pipe = tmp_path / "log"
    os.mkfifo(pipe)
    command = [*PLUMB, "settings", str(pipe)]
    with (
        INTERRUPTIBLE(command, stdout=subprocess.PIPE, stderr=subprocess.PIPE) as started,
        open(pipe, "wb"),  # opens when the command reads
    ):
        started.send_signal(signal.SIGINT)
        said, complaint = started.communicate(timeout=60)
    assert (started.returncode, said, complaint) == (INTERRUPTED, b"", b"")


def test_a_closed_pipe_ends_quietly():
    reader, writer = os.pipe()
    os.close(reader)
    done = subprocess.run([*COMPARE, "--json"], stdout=writer, stderr=subprocess.PIPE)
    os.close(writer)
    assert (done.returncode, done.stderr) == (141, b"")


def test_a_full_disk_is_an_object_with_json(run, capsys):
    full = ["add", SETTINGS, MARKS, "--effect", "none", "-o", "/dev/full", "--json"]
    code, said, complaint = run(*full)
    assert code == 2 and complaint.count("\n") == 1
    assert json.loads(said) == {"error": complaint.removeprefix("plumb: ").rstrip()}

    def full_disk() -> int:
        raise OSError(errno.ENOSPC, os.strerror(errno.ENOSPC), "results.json")

    assert ended(full_disk, name="plumb", as_json=True) == 2
    said = capsys.readouterr().out
    assert json.loads(said) == {"error": "results.json: No space left on device"}
