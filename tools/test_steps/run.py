"""Runs the parts of tools/test side by side, shows how far each is, and sums up."""

import argparse
import os
import shutil
import subprocess
import sys
import threading
import time
from collections import Counter
from collections.abc import Iterator, Sequence
from pathlib import Path

import quick
from counts import seconds_by_group
from part import RESULTS, ROOT, Part, checks, firmware, host_tests, python_tests
from rich.console import Console
from rich.live import Live
from rich.text import Text

NEWS_EVERY = 20.0  # [s] between two looks where the output is no terminal
LOOK_EVERY = 0.25  # [s]
SLOWEST = 5
TAIL = 40  # lines of a failed part's log
CCACHE = Path("/usr/lib/ccache")  # Debian's compilers behind its cache
ENVIRONMENT = {
    "PLUMB_WARNINGS": "error",
    "PLATFORMIO_DISABLE_UPGRADE_CHECK": "true",
    # The parts fill the cores; threads of numpy would only queue for them.
    "OMP_NUM_THREADS": "1",
    "OPENBLAS_NUM_THREADS": "1",
    # What another folder compiled is the same.
    "CCACHE_BASEDIR": str(ROOT),
    "CCACHE_NOHASHDIR": "1",
}


def main() -> int:
    """Run what is asked; 0 if all of it passed."""
    parser = argparse.ArgumentParser(prog="tools/test", description=__doc__)
    parser.add_argument("what", nargs="?", choices=("fast", "all", "quick"), default="fast")
    what = parser.parse_args().what
    os.environ |= ENVIRONMENT
    # A test that starts a command would compile all of the lab anew.
    os.environ.pop("PYTHONDONTWRITEBYTECODE", None)
    if CCACHE.is_dir():
        os.environ["PATH"] = f"{CCACHE}{os.pathsep}{os.environ['PATH']}"
    note = ""
    if what == "quick":
        try:
            asked = quick.touched()
        except (OSError, subprocess.CalledProcessError):
            print("test: quick asks git what was edited; this is no clone, so use tools/test")
            return 2
        (first, lanes), note = asked.parts(), asked.left_out()
    else:
        first, lanes = everything(slow=what == "all")
    # Nothing of an earlier run counts.
    shutil.rmtree(RESULTS, ignore_errors=True)
    RESULTS.mkdir(parents=True)
    run(first, lanes)
    parts = [*first, *(part for lane in lanes for part in lane)]
    return sum_up(parts, note)


def everything(*, slow: bool) -> tuple[list[Part], list[list[Part]]]:
    """Return what comes first, and then the lanes that run side by side."""
    cxx = [
        host_tests(),
        Part("fuzz", [["nice", ROOT / "test/fuzz/run"]]),
        Part("bench", [[ROOT / "tools/bench/run"]]),
    ]
    names = [*quick.SLOW_CHECKS, *quick.QUICK_CHECKS]
    return [firmware()], [cxx, [checks(names)], [python_tests(slow=slow)]]


def run(first: Sequence[Part], lanes: Sequence[Sequence[Part]]) -> None:
    """Run what comes first; if that passed, the lanes; show how far they are."""
    parts = [*first, *(part for lane in lanes for part in lane)]

    def lane_after(lane: Sequence[Part]) -> None:
        for part in lane:
            part.run()

    def all_of_it() -> None:
        lane_after(first)
        if any(part.failed for part in first):
            return
        threads = [threading.Thread(target=lane_after, args=(lane,)) for lane in lanes]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()

    worker = threading.Thread(target=all_of_it)
    worker.start()
    try:
        watch(worker, parts)
    except KeyboardInterrupt:
        for part in parts:
            part.stop()
        worker.join()
        raise SystemExit(130) from None


def watch(worker: threading.Thread, parts: Sequence[Part]) -> None:
    """Show how far the parts are until the worker ends, and failures as they come."""
    console = Console(highlight=False, soft_wrap=True)
    if console.is_terminal:
        table = Live(
            console=console, get_renderable=lambda: Text("\n".join(rows(parts))), transient=True
        )
        with table:
            while worker.is_alive():
                show_failures(parts, console)
                worker.join(LOOK_EVERY)
    else:
        news = time.monotonic() + NEWS_EVERY
        while worker.is_alive():
            show_failures(parts, console)
            if time.monotonic() >= news:
                news += NEWS_EVERY
                console.print(*(row for row in rows(parts) if "..." in row), sep="\n")
            worker.join(LOOK_EVERY)
    show_failures(parts, console)


def show_failures(parts: Sequence[Part], console: Console) -> None:
    """Name what failed since the last look."""
    for part in parts:
        while part.failures:
            console.print(Text(f"FAILED {part.name}: {part.failures.pop(0)}"))


def rows(parts: Sequence[Part]) -> Iterator[str]:
    """Yield a line for each part that has begun: its time, its counts, and how much is done."""
    for part in parts:
        if part.began is None:
            continue
        seconds = part.wall or time.monotonic() - part.began
        counts = f"{part.passed:6} passed {part.failed:5} failed"
        ending = f"{part.cpu:6.0f} s of CPU"
        if part.is_running:
            ending = "..." if part.share is None else f"... {part.share} %"
        yield f"{part.name:14}{clock(seconds)} {counts}  {ending}"


def sum_up(parts: Sequence[Part], note: str = "") -> int:
    """Show what failed, each part, the slowest groups and the sum; 0 if all passed."""
    for part in parts:
        if part.failed:
            print(f"\n=== {part.name}: the end of {part.log.relative_to(ROOT)} ===")
            print("\n".join(part.log.read_text(errors="replace").splitlines()[-TAIL:]))
    print("\n=== summary ===")
    print("\n".join(rows(parts)))
    # A part that was never reached failed.
    missing = [part for part in parts if part.began is None]
    for part in missing:
        print(f"{part.name:14}was not reached")
    if slowest := _slowest(parts):
        print(f"Slowest: {slowest}")
    if note:
        print(note)
    passed = sum(part.passed for part in parts)
    failed = sum(part.failed for part in parts) + len(missing)
    print(f"{passed} passed, {failed} failed")
    return int(failed > 0 or passed == 0)


def _slowest(parts: Sequence[Part]) -> str:
    """Return the groups of tests that took the longest, added up over the workers."""
    seconds: Counter[str] = Counter()
    for part in parts:
        if part.junit is None:
            seconds[part.name] = part.wall
        else:
            seconds += seconds_by_group(part.junit)
    return ", ".join(f"{name} {value:.0f} s" for name, value in seconds.most_common(SLOWEST))


def clock(seconds: float) -> str:
    """Minutes and seconds."""
    return f"{int(seconds) // 60:3}:{int(seconds) % 60:02}"


if __name__ == "__main__":
    sys.exit(main())
