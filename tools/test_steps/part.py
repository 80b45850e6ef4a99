"""A part of a test run: its commands, how far they are, and what they came to."""

import os
import re
import signal
import subprocess
import sys
import time
from collections.abc import Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import IO

from counts import count

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / ".pio/results"
Command = Sequence[str | Path]

# A line of pytest's workers, and a line of PlatformIO.
OF_PYTEST = re.compile(r"^\[gw\d+\] \[ *(\d+)%\] (PASSED|FAILED|ERROR|SKIPPED) (.*)")
OF_SUITE = re.compile(r"^(\S.*?)\t\[(PASSED|FAILED|ERRORED|SKIPPED)\]")
PASSED = "PASSED"


@dataclass
class Part:
    """Commands that run one after the other.

    junit: the file in which a command counts its tests; without one each command is a test.
    """

    name: str
    commands: Sequence[Command]
    junit: Path | None = None
    passed: int = 0
    failed: int = 0
    share: int | None = None  # [%] that is done, where the command says it
    failures: list[str] = field(default_factory=list)  # the names that are not yet shown
    began: float | None = None
    wall: float = 0.0  # [s]
    cpu: float = 0.0  # [s] of the commands and all that they started
    process: subprocess.Popen[str] | None = None
    stopped: bool = False

    @property
    def log(self) -> Path:
        """Where all is that the commands say."""
        return RESULTS / f"{self.name}.log"

    @property
    def is_running(self) -> bool:
        """Whether it has begun and has not ended."""
        return self.began is not None and not self.wall

    def run(self) -> None:
        """Run the commands; the counts are final when this returns."""
        self.began = time.monotonic()
        with self.log.open("w", encoding="utf-8", errors="replace") as log:
            for command in self.commands:
                if self.stopped:
                    break
                self._run_command(command, log)
        self.wall = time.monotonic() - self.began

    def stop(self) -> None:
        """End the command that runs, with all that it started."""
        self.stopped = True
        if self.process is not None:
            try:
                os.killpg(self.process.pid, signal.SIGTERM)
            except ProcessLookupError:
                return

    def _run_command(self, command: Command, log: IO[str]) -> None:
        words = [str(word) for word in command]
        self.process = process = subprocess.Popen(
            words,
            cwd=ROOT,
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            start_new_session=True,
        )
        assert process.stdout is not None
        for line in process.stdout:
            log.write(line)
            log.flush()
            self._note(line)
        _, waited, used = os.wait4(process.pid, 0)
        process.returncode = status = os.waitstatus_to_exitcode(waited)
        self.cpu += used.ru_utime + used.ru_stime
        if self.junit is not None:
            self.passed, self.failed = count(self.junit, status)
        elif status == 0:
            self.passed += 1
        else:
            self.failed += 1
            self.failures.append(Path(words[-1]).stem if len(self.commands) > 1 else self.name)
        if self.junit is None:
            self.share = 100 * (self.passed + self.failed) // len(self.commands)

    def _note(self, line: str) -> None:
        """Count a test, where the line says how it ended; the file with all counts comes later."""
        if self.junit is None:
            return
        if test := OF_PYTEST.match(line):
            self.share, ending, name = int(test[1]), test[2], test[3]
        elif test := OF_SUITE.match(line):
            ending, name = test[2], test[1]
        else:
            return
        if ending == PASSED:
            self.passed += 1
        else:
            self.failed += 1
            self.failures.append(name.strip())


def host_tests(suites: Sequence[str] = ()) -> Part:
    """Return the suites of the host, or those named."""
    junit = RESULTS / "native.xml"
    chosen = [word for suite in suites for word in ("--filter", suite)]
    pio = ROOT / ".venv/bin/pio"
    return Part(
        "host tests",
        [[pio, "test", "-e", "native", "--junit-output-path", junit, *chosen]],
        junit=junit,
    )


def python_tests(rooms: Sequence[str] = ("tools/tests",), *, slow: bool = False) -> Part:
    """Return the tests of the lab and the project; without those that are slow by nature unless
    asked.

    More workers than cores, since some tests wait for a server or a browser; a worker without work
    takes some of another's.
    """
    junit = RESULTS / "python.xml"
    workers = ["--numprocesses", str(2 * (os.cpu_count() or 1)), "--dist", "worksteal"]
    marks = [] if slow else ["-m", "not slow"]
    pytest = [sys.executable, "-m", "pytest", "-v", "--junitxml", junit]
    return Part("Python tests", [[*pytest, *workers, *marks, *rooms]], junit=junit)


def checks(names: Sequence[str]) -> Part:
    """Run the checks of tools/checks, each of which counts as a test."""
    return Part("checks", [[sys.executable, ROOT / f"tools/checks/{name}.py"] for name in names])


def firmware() -> Part:
    """Return the program for the Mega, which some tests of the lab flash."""
    return Part("firmware", [[ROOT / ".venv/bin/pio", "run", "-e", "megaatmega2560"]])


def setup() -> Part:
    """Return what the other parts need; it does nothing where all is there."""
    return Part("setup", [[ROOT / "tools/setup"]])
