"""A `plumb vm` that runs for a test, as a program with a serial port."""

import contextlib
import functools
import io
import os
import signal
import subprocess
import sys
import time
from pathlib import Path

import hurried_plumb
import pytest
from hurried_plumb import SPEED
from plumb.cli.main import main
from plumb.line.sender import Watch

PLUMB = [sys.executable, hurried_plumb.__file__]
START = 120  # [s] in which a program on a busy computer must have begun

# A lane of tools/test ignores Ctrl-C, and what it starts would too.
HEARS_CTRL_C = None if os.name == "nt" else lambda: signal.signal(signal.SIGINT, signal.SIG_DFL)
INTERRUPTIBLE = functools.partial(subprocess.Popen, preexec_fn=HEARS_CTRL_C)


def plumb(*words: str, folder: Path, code: int = 0, typed: str | None = None) -> str:
    """The output of a command, which must end with this exit code."""
    if typed is None:
        said, complaint = io.StringIO(), io.StringIO()
        with pytest.MonkeyPatch.context() as patch, contextlib.chdir(folder):
            patch.setattr(Watch, "speed", SPEED)
            with contextlib.redirect_stdout(said), contextlib.redirect_stderr(complaint):
                ended = main([*words])
        heard = said.getvalue() + complaint.getvalue()
    else:
        done = subprocess.run(
            [*PLUMB, *words], cwd=folder, capture_output=True, text=True, timeout=120, input=typed
        )
        ended, heard = done.returncode, done.stdout + done.stderr
    assert ended == code, heard
    return heard


class Served:
    """A `plumb vm` that runs in a folder."""

    def __init__(self, folder: Path, *words: str):
        (folder / "maslow").unlink(missing_ok=True)  # that of a machine which was killed
        command = [*PLUMB, "vm", "--link", "maslow", "--speed", str(SPEED), *words]
        self.program = INTERRUPTIBLE(
            command, cwd=folder, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        end = time.monotonic() + START
        while not (folder / "maslow").exists():
            assert self.program.poll() is None and time.monotonic() < end, "no machine"
            time.sleep(0.05)

    def stop(self) -> str:
        """Ctrl-C; what was printed."""
        self.program.send_signal(2)
        printed = self.program.communicate(timeout=START)[0]
        assert self.program.returncode == 0, printed
        return printed
