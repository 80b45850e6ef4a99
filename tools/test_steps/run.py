"""Runs the parts of tools/test side by side, shows how far each is, and sums up."""

import argparse
import os
import re
import shutil
import signal
import subprocess
import sys
import threading
import time
import xml.etree.ElementTree as ElementTree
from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
RESULTS = ROOT / ".pio/results"
PIO = ROOT / ".venv/bin/pio"
CORES = os.cpu_count() or 1
NEWS_EVERY = 20.0  # [s] between two looks at how far the parts are
TAIL = 40  # lines of a failed part's log
CCACHE = Path("/usr/lib/ccache")  # Debian's compilers behind its cache
ENVIRONMENT = {
    "PLUMB_WARNINGS": "error",
    "PLATFORMIO_DISABLE_UPGRADE_CHECK": "true",
    # The parts fill the cores; threads of numpy would only queue for them.
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    # A file that was compiled in another folder is the same file.
    "CCACHE_BASEDIR": str(ROOT),
    "CCACHE_NOHASHDIR": "1",
}
CHECKS = sorted((ROOT / "tools/checks").glob("[!t]*.py"))  # all but tree.py, which they share
# The tests that wait for a browser, a port or a simulated machine.
WAITING = [f"tools/tests/{room}" for room in ("lab", "line", "vm", "firmware", "senders")]
# How pytest's workers and PlatformIO report the end of a test.
ENDED = re.compile(
    r"^\[gw\d+\] \[ *\d+%\] (?P<way>PASSED|FAILED|ERROR|SKIPPED) (?P<name>.*)"
    r"|^(?P<suite>\S.*?)\t\[(?P<end>PASSED|FAILED|ERRORED|SKIPPED)\]"
)


@dataclass
class Part:
    """Commands that run one after the other; each is a test where no `junit` file counts them."""

    name: str
    commands: Sequence[Sequence[str | Path]]
    junit: Path | None = None
    passed: int = 0
    failed: int = 0
    began: float = 0.0
    wall: float = 0.0  # [s]
    cpu: float = 0.0  # [s] of the commands and all that they started
    said: list[str] = field(default_factory=list)  # the end of the output
    process: subprocess.Popen[str] | None = None

    def run(self) -> None:
        """Run the commands; the counts are final when this returns."""
        self.began = time.monotonic()
        for command in self.commands:
            self._run([str(word) for word in command])
        self.wall = time.monotonic() - self.began

    def _run(self, command: Sequence[str]) -> None:
        pipes = {
            "stdin": subprocess.DEVNULL,
            "stdout": subprocess.PIPE,
            "stderr": subprocess.STDOUT,
        }
        self.process = process = subprocess.Popen(
            command, cwd=ROOT, text=True, errors="replace", start_new_session=True, **pipes
        )
        with (RESULTS / f"{self.name}.log").open("a", buffering=1) as log:
            for line in process.stdout:
                log.write(line)
                self.said = [*self.said[1 - TAIL :], line]
                if self.junit and (ended := ENDED.match(line)):
                    self._count(ended["name"] or ended["suite"], ended["way"] or ended["end"])
        _, waited, used = os.wait4(process.pid, 0)
        process.returncode = status = os.waitstatus_to_exitcode(waited)
        self.cpu += used.ru_utime + used.ru_stime
        if self.junit:
            self.passed, self.failed = counts(self.junit, status)
        else:
            self._count(Path(command[-1]).stem, "FAILED" if status else "PASSED")

    def _count(self, test: str, ending: str) -> None:
        self.passed += ending == "PASSED"
        if ending != "PASSED":
            self.failed += 1
            print(f"FAILED {self.name}: {test.strip()}", flush=True)

    def row(self) -> str:
        """Return how long it has run, and what it came to so far."""
        seconds = int(self.wall or time.monotonic() - self.began)
        ending = f"{self.cpu:6.0f} s of CPU" if self.wall else "..."
        clock = f"{seconds // 60:3}:{seconds % 60:02}"
        return f"{self.name:14}{clock} {self.passed:6} passed {self.failed:5} failed  {ending}"


def counts(junit: Path, status: int) -> tuple[int, int]:
    """Return how many tests passed and failed; status: the exit code of the command.

    A skipped test failed: it proved nothing. So did a suite without tests and a missing file.
    """
    passed = failed = 0
    try:
        suites = list(ElementTree.parse(junit).iter("testsuite"))
    except (OSError, ElementTree.ParseError):
        return 0, 1
    for suite in suites:
        cases = list(suite.iter("testcase"))
        bad = [
            case for case in cases if {each.tag for each in case} & {"failure", "error", "skipped"}
        ]
        # PlatformIO adds a program's exit code as one more case, which is named like the suite.
        own = [case for case in bad if case.get("name") != suite.get("name")] or bad
        passed += len(cases) - len(bad)
        # It also lists suites that did not run, without a time.
        failed += len(own) if cases else int("timestamp" in suite.attrib)
    return passed, failed or int(bool(status) or not passed)


def seconds_by_room(junit: Path) -> Iterator[str]:
    """Yield the rooms of tools/tests that took longest: seconds over all workers, and of CPU."""
    wall: Counter[str] = Counter()
    cpu: Counter[str] = Counter()
    for case in ElementTree.parse(junit).iter("testcase") if junit.is_file() else ():
        # A file that cannot be read has its error as a case of no class.
        room = case.get("classname", "tests.").removeprefix("tests.").partition(".")[0]
        wall[room] += float(case.get("time", 0))
        cpu[room] += sum(float(each.get("value", 0)) for each in case.iter("property"))
    for room, seconds in wall.most_common(8):
        yield f"  {room:12}{seconds:6.0f} s, of which {cpu[room]:5.0f} s of CPU"


def pytest(rooms: Sequence[str], *choice: str) -> Part:
    """Return the tests of the lab and the project that are in these rooms.

    Twice as many workers as cores, as some tests wait for a server or a browser.
    """
    junit = RESULTS / "python.xml"
    workers = ["-n", str(2 * CORES), "--dist", "worksteal"]
    words = [sys.executable, "-u", "-m", "pytest", "-v", "--junitxml", junit, *workers, *choice]
    return Part("Python tests", [[*words, *rooms]], junit)


def lanes(what: str) -> list[list[Part]]:
    """Return the parts; those of a lane run one after the other, the lanes side by side."""
    if what == "busy":
        return [[pytest(WAITING, "-m", "not slow")]]
    native = RESULTS / "native.xml"
    suites = [PIO, "test", "-e", "native", "--junit-output-path", native]
    return [
        [pytest(["tools/tests"], *([] if what == "all" else ["-m", "not slow"]))],
        [
            Part("host tests", [suites], native),
            Part("fuzz", [["nice", ROOT / "test/fuzz/run"]]),
            Part("bench", [[ROOT / "tools/bench/run"]]),
        ],
        [Part("checks", [[sys.executable, check] for check in CHECKS])],
    ]


def run(work: Sequence[Sequence[Part]]) -> None:
    """Run the lanes side by side, and print now and then how far they are."""

    def in_turn(lane: Sequence[Part]) -> None:
        for part in lane:
            part.run()

    threads = [threading.Thread(target=in_turn, args=(lane,), daemon=True) for lane in work]
    for thread in threads:
        thread.start()
    news = time.monotonic() + NEWS_EVERY
    while any(thread.is_alive() for thread in threads):
        next(thread for thread in [*threads[::-1], threads[0]] if thread.is_alive()).join(0.25)
        if time.monotonic() >= news:
            news += NEWS_EVERY
            print(
                *(part.row() for lane in work for part in lane if part.began and not part.wall),
                sep="\n",
                flush=True,
            )


def sum_up(parts: Sequence[Part]) -> int:
    """Print the end of what failed, each part and the sum; return 0 if all passed."""
    for part in parts:
        if part.failed:
            print(f"\n=== {part.name}: the end of its output ===", "".join(part.said), sep="\n")
    print("\n=== summary; the whole output of each part is in .pio/results ===")
    print(*(part.row() for part in parts), *seconds_by_room(RESULTS / "python.xml"), sep="\n")
    passed, failed = sum(part.passed for part in parts), sum(part.failed for part in parts)
    print(f"{passed} passed, {failed} failed")
    return int(failed > 0 or passed == 0)


def main() -> int:
    """Run what is asked; 0 if all of it passed."""
    parser = argparse.ArgumentParser(prog="tools/test")
    parser.add_argument("what", nargs="?", choices=("fast", "all", "busy"), default="fast")
    what = parser.parse_args().what
    os.environ |= ENVIRONMENT
    # Without compiled files each command that a test starts would compile the lab anew.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    if CCACHE.is_dir():
        os.environ["PATH"] = f"{CCACHE}{os.pathsep}{os.environ['PATH']}"
    # A shell may have told its background jobs to ignore Ctrl-C.
    for number in (signal.SIGINT, signal.SIGTERM):
        signal.signal(number, signal.default_int_handler)
    shutil.rmtree(RESULTS, ignore_errors=True)
    RESULTS.mkdir(parents=True)
    # Alone, as two runs of PlatformIO would empty each other's folder. If it does not build, the
    # tests that flash it say so, and everything else is tested all the same.
    firmware = [[Part("firmware", [[PIO, "run", "-e", "megaatmega2560"]])]]
    work = [*firmware, *lanes(what)]
    parts = [part for lane in work for part in lane]
    loops = [
        subprocess.Popen(["sh", "-c", "while :; do :; done"])
        for _ in range(CORES * (what == "busy"))
    ]
    try:
        run(firmware)
        run(work[1:])
    except KeyboardInterrupt:
        for part in parts:
            if part.process and part.process.returncode is None:
                os.killpg(part.process.pid, signal.SIGTERM)
        return 130
    finally:
        for loop in loops:
            loop.kill()
            loop.wait()
    return sum_up(parts)


if __name__ == "__main__":
    sys.exit(main())
