"""Runs the parts of tools/test side by side and sums up; what each says is in .pio/results."""

import os
import shutil
import signal
import sys
import threading
import time
import xml.etree.ElementTree as ElementTree
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path
from subprocess import DEVNULL, STDOUT, Popen

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / ".pio/results"
PIO = ROOT / ".venv/bin/pio"
BAD = {"failure", "error", "skipped"}  # what a case of JUnit's holds that did not pass
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
CHECKS = sorted((ROOT / "tools/checks").glob("[!t]*.py"))  # all but tree.py, which they share


@dataclass
class Part:
    """Commands that run one after the other; each is a test where no `junit` file counts them."""

    name: str
    commands: Sequence[Sequence[str | Path]]
    junit: Path | None = None
    passed: int = 0
    failed: int = 0
    process: Popen[bytes] | None = None

    def run(self) -> None:
        """Run the commands, then print how long they took, how many passed, and why some failed."""
        began, log = time.monotonic(), RESULTS / f"{self.name}.log"
        with log.open("w") as said:
            for command in self.commands:
                how = {"stdin": DEVNULL, "stdout": said, "stderr": STDOUT, "cwd": ROOT}
                self.process = Popen(command, start_new_session=True, **how)
                status = self.process.wait()
                good, bad = counts(self.junit, status) if self.junit else (not status, bool(status))
                self.passed, self.failed = self.passed + good, self.failed + bad
        clock = "{:3}:{:02}".format(*divmod(int(time.monotonic() - began), 60))
        print(f"{self.name:14}{clock} {self.passed:6} passed {self.failed:5} failed", flush=True)
        if self.failed:
            end = log.read_text(errors="replace").splitlines()[-TAIL:]
            print(f"=== the end of {log} ===", *end, "===", sep="\n", flush=True)


def counts(junit: Path, status: int) -> tuple[int, int]:
    """Return how many tests passed and failed; status: the exit code of the command.

    A skipped test failed: it proved nothing. So did a suite without tests and a missing file.
    """
    try:
        suites = list(ElementTree.parse(junit).iter("testsuite"))
    except (OSError, ElementTree.ParseError):
        return 0, 1
    passed = failed = 0
    for suite in suites:
        cases = list(suite.iter("testcase"))
        bad = [case for case in cases if {each.tag for each in case} & BAD]
        # PlatformIO adds a program's exit code as one more case, which is named like the suite.
        own = [case for case in bad if case.get("name") != suite.get("name")] or bad
        passed += len(cases) - len(bad)
        # It also lists suites that did not run, without a time.
        failed += len(own) if cases else int("timestamp" in suite.attrib)
    return passed, failed or int(bool(status) or not passed)


def lanes(what: str) -> list[list[Part]]:
    """Return the parts; those of a lane run one after the other, the lanes side by side."""
    python, native = RESULTS / "python.xml", RESULTS / "native.xml"
    # Twice as many workers as cores, as some tests wait for a server or a browser.
    workers = ["-n", str(2 * (os.cpu_count() or 1)), "--dist", "worksteal"]
    pytest = [sys.executable, "-u", "-m", "pytest", "-v", "--junitxml", python, *workers]
    chosen = [] if what == "all" else ["-m", "not slow"]
    host = [
        Part("host tests", [[PIO, "test", "-e", "native", "--junit-output-path", native]], native),
        Part("fuzz", [["nice", ROOT / "test/fuzz/run"]]),
        Part("bench", [[ROOT / "tools/bench/run"]]),
    ]
    return [
        [Part("Python tests", [[*pytest, *chosen, "tools/tests"]], python)],
        host,
        [Part("checks", [[sys.executable, check] for check in CHECKS])],
    ]


def run(work: Sequence[Sequence[Part]]) -> None:
    """Run the lanes side by side."""

    def in_turn(lane: Sequence[Part]) -> None:
        for part in lane:
            part.run()

    threads = [threading.Thread(target=in_turn, args=(lane,), daemon=True) for lane in work]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()


def main() -> int:
    """Run what is asked, which tools/test has looked at; 0 if all of it passed."""
    os.environ |= ENVIRONMENT
    # A shell may have told its background jobs to ignore Ctrl-C.
    signal.signal(signal.SIGINT, signal.default_int_handler)
    signal.signal(signal.SIGTERM, signal.default_int_handler)
    shutil.rmtree(RESULTS, ignore_errors=True)
    RESULTS.mkdir(parents=True)
    firmware = Part("firmware", [[PIO, "run", "-e", "megaatmega2560"]])
    work = lanes(sys.argv[1] if sys.argv[1:] else "fast")
    parts = [firmware, *(part for lane in work for part in lane)]
    try:
        # Alone, as two runs of PlatformIO would empty each other's folder. If it does not build,
        # the tests that flash it say so, and everything else is tested all the same.
        run([[firmware]])
        run(work)
    except KeyboardInterrupt:
        for part in parts:
            if part.process and part.process.returncode is None:
                os.killpg(part.process.pid, signal.SIGTERM)
        return 130
    passed, failed = sum(part.passed for part in parts), sum(part.failed for part in parts)
    print(f"{passed} passed, {failed} failed")
    return int(failed > 0 or passed == 0)


if __name__ == "__main__":
    sys.exit(main())
