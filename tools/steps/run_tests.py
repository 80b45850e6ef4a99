"""Runs the parts of tools/test side by side, shows how far each is, and sums up."""

import os
import re
import shutil
import signal
import sys
import threading
import time
from collections import deque
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from pathlib import Path
from subprocess import DEVNULL, PIPE, STDOUT, Popen

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / ".pio/results"
PIO = ROOT / ".venv/bin/pio"
CORES = os.cpu_count() or 1
NEWS_EVERY = 20.0  # [s] between two looks at how far the parts are
PATIENCE = 5.0  # [s] until what was interrupted has ended
STOPPED = threading.Event()  # by Ctrl-C: no further command begins
LOOP = ["sh", "-c", "while :; do :; done"]
TAIL = 40  # lines of a failed part's log
ENVIRONMENT = {
    "PLUMB_WARNINGS": "error",
    "PLATFORMIO_DISABLE_UPGRADE_CHECK": "true",
    # The parts fill the cores; threads of numpy would only queue for them.
    "OMP_NUM_THREADS": "1",
    # A file that was compiled in another folder is the same file.
    "CCACHE_BASEDIR": str(ROOT),
    "CCACHE_NOHASHDIR": "1",
    # Debian's compilers behind their cache, where it is there.
    "PATH": f"/usr/lib/ccache{os.pathsep}{os.environ['PATH']}",
    # Without compiled files each command that a test starts would compile the lab anew.
    "PYTHONDONTWRITEBYTECODE": "",
}
CHECKS = [[each] for each in sorted((ROOT / "tools/checks").glob("[!t]*.py"))]  # without tree.py
CHECKS.append([ROOT / "docs/written_by/write.py", "--check"])  # whether written pages are fresh
# The tests that wait for a browser, a port or a simulated machine.
WAITING = [f"tools/tests/{room}" for room in ("lab", "line", "vm", "firmware", "senders")]
# How pytest's workers and PlatformIO report the end of a test. One that was skipped proved nothing.
ENDED = re.compile(
    r"^\[gw\d+\] \[ *\d+%\] (?P<way>PASSED|FAILED|ERROR|SKIPPED) (?P<name>.*)"
    r"|^(?P<suite>\S.*?)\t\[(?P<end>PASSED|FAILED|ERRORED|SKIPPED)\]"
)


@dataclass
class Part:
    """Commands that run in turn; each is a test, or a suite that says how each of its own ended."""

    name: str
    commands: Sequence[Sequence[str | Path]]
    is_suite: bool = False
    passed: int = 0
    failed: int = 0
    began: float = 0.0
    wall: float = 0.0  # [s]
    cpu: float = 0.0  # [s] of the commands and all that they started
    said: deque[str] = field(default_factory=lambda: deque(maxlen=TAIL))  # the end of the output
    process: Popen[str] | None = None

    def run(self) -> None:
        """Run the commands; the counts are final when this returns."""
        self.began = time.monotonic()
        for command in self.commands:
            status = self._said_by([str(word) for word in command])
            if STOPPED.is_set():
                return
            if not self.is_suite:
                self._count(Path(command[-1]).stem, "FAILED" if status else "PASSED")
            elif not self.failed and (status or not self.passed):
                self._count(f"ended with {status}", "FAILED")
        self.wall = time.monotonic() - self.began

    def stop(self) -> None:
        """End what runs, with all that it started."""
        if self.process and self.process.returncode is None:
            with suppress(ProcessLookupError):
                os.killpg(self.process.pid, signal.SIGTERM)

    def _said_by(self, command: Sequence[str]) -> int:
        """Return the exit code of a command, whose output goes to the part's log."""
        how = {"text": True, "errors": "replace", "start_new_session": True}
        self.process = Popen(command, stdin=DEVNULL, stdout=PIPE, stderr=STDOUT, cwd=ROOT, **how)
        with (RESULTS / f"{self.name}.log").open("a", buffering=1) as log:
            for line in self.process.stdout:
                log.write(line)
                self.said.append(line)
                if self.is_suite and (ended := ENDED.match(line)):
                    self._count(ended["name"] or ended["suite"], ended["way"] or ended["end"])
        _, waited, used = os.wait4(self.process.pid, 0)
        self.process.returncode = os.waitstatus_to_exitcode(waited)
        self.cpu += used.ru_utime + used.ru_stime
        return self.process.returncode

    def _count(self, test: str, ending: str) -> None:
        self.passed += ending == "PASSED"
        self.failed += ending != "PASSED"
        if ending != "PASSED":
            print(f"FAILED {self.name}: {test.strip()}", flush=True)

    def row(self) -> str:
        """Return how long it has run, and what it came to so far."""
        clock = "{:3}:{:02}".format(*divmod(int(self.wall or time.monotonic() - self.began), 60))
        ending = f"{self.cpu:6.0f} s of CPU" if self.wall else "..."
        return f"{self.name:14}{clock} {self.passed:6} passed {self.failed:5} failed  {ending}"


def lanes(what: str) -> list[list[Part]]:
    """Return the parts; those of a lane run one after the other, the lanes side by side."""
    # One more worker than cores, as some tests wait for a server or a browser.
    workers = ["-n", str(CORES + 1), "--dist", "worksteal"]
    pytest = [sys.executable, "-u", "-m", "pytest", "-v", *workers]
    chosen = [] if what == "all" else ["-m", "not slow"]
    rooms = WAITING if what == "busy" else ["tools/tests"]
    tests = [Part("Python tests", [[*pytest, *chosen, *rooms]], is_suite=True)]
    if what == "busy":
        return [tests]
    host = [
        Part("host tests", [[PIO, "test", "-e", "native"]], is_suite=True),
        Part("fuzz", [["nice", ROOT / "test/fuzz/run"]]),
        Part("bench", [[ROOT / "tools/bench/run"]]),
    ]
    return [tests, host, [Part("checks", [[sys.executable, *check] for check in CHECKS])]]


def run(work: Sequence[Sequence[Part]]) -> None:
    """Run the lanes side by side, and print now and then how far they are. An interruption goes on
    up when all has ended: who prints while Python leaves would break it off.
    """

    def in_turn(lane: Sequence[Part]) -> None:
        for part in lane:
            if not STOPPED.is_set():
                part.run()

    threads = [threading.Thread(target=in_turn, args=(lane,), daemon=True) for lane in work]
    for thread in threads:
        thread.start()
    parts = [part for lane in work for part in lane]
    try:
        for thread in threads:
            while thread.join(NEWS_EVERY) or thread.is_alive():
                running = [part for part in parts if part.began and not part.wall]
                print(*(part.row() for part in running), sep="\n", flush=True)
    except KeyboardInterrupt:
        STOPPED.set()
        end = time.monotonic() + PATIENCE
        while any(thread.is_alive() for thread in threads) and time.monotonic() < end:
            for part in parts:
                part.stop()
            time.sleep(0.05)
        raise


def sum_up(parts: Sequence[Part]) -> int:
    """Print the end of what failed, each part and the sum; return 0 if all passed."""
    for part in (part for part in parts if part.failed):
        print(f"\n=== {part.name}: the end of its output ===", "".join(part.said), sep="\n")
    print("\n=== summary; the whole output of each part is in .pio/results ===")
    passed, failed = sum(part.passed for part in parts), sum(part.failed for part in parts)
    print(*(part.row() for part in parts), f"{passed} passed, {failed} failed", sep="\n")
    return int(failed > 0 or passed == 0)


def main() -> int:
    """Run what is asked, which tools/test has looked at; 0 if all of it passed."""
    what = sys.argv[1] if sys.argv[1:] else "fast"
    os.environ |= ENVIRONMENT
    # A shell may have told its background jobs to ignore Ctrl-C.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    shutil.rmtree(RESULTS, ignore_errors=True)
    RESULTS.mkdir(parents=True)
    firmware, work = Part("firmware", [[PIO, "run", "-e", "megaatmega2560"]]), lanes(what)
    parts = [firmware, *(part for lane in work for part in lane)]
    loops = [Popen(LOOP) for _ in range(CORES)] if what == "busy" else []
    try:
        # Alone, as two runs of PlatformIO would empty each other's folder. If it does not build,
        # the tests that flash it say so, and everything else is tested all the same.
        run([[firmware]])
        run(work)
    except KeyboardInterrupt:
        return 130
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()
    return sum_up(parts)


if __name__ == "__main__":
    sys.exit(main())
