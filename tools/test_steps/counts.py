"""What a JUnit file says: how many tests passed, and which groups of them took the longest.

A skipped test counts as failed: it proved nothing. So does a suite without tests, a missing file,
and a command that failed without a failed test.
"""

import xml.etree.ElementTree as ElementTree
from collections import Counter
from pathlib import Path

FAILED = {"failure", "error", "skipped"}


def count(path: Path, status: int) -> tuple[int, int]:
    """Count tests that passed and failed; status: the exit code of the command that wrote it."""
    try:
        suites = list(ElementTree.parse(path).iter("testsuite"))
    except (OSError, ElementTree.ParseError):
        return 0, 1
    counts = [count_suite(suite) for suite in suites]
    passed, failed = (sum(column) for column in zip((0, 0), *counts, strict=True))
    if not passed + failed or (status and not failed):
        failed += 1
    return passed, failed


def count_suite(suite: ElementTree.Element) -> tuple[int, int]:
    """Return the same for one suite."""
    cases = list(suite.iter("testcase"))
    if not cases:
        # Only a suite that ran has a time stamp; PlatformIO also lists those of other environments.
        return 0, int("timestamp" in suite.attrib)
    failed = [case for case in cases if any(child.tag in FAILED for child in case)]
    # PlatformIO adds the program's exit code as one more case, named like the suite.
    added = [case for case in failed if case.get("name") == suite.get("name")]
    return len(cases) - len(failed), len(failed) - (len(added) if len(failed) > len(added) else 0)


def seconds_by_group(path: Path) -> Counter[str]:
    """Seconds of the tests in each suite of the host and in each room of tools/tests."""
    seconds: Counter[str] = Counter()
    try:
        suites = list(ElementTree.parse(path).iter("testsuite"))
    except (OSError, ElementTree.ParseError):
        return seconds
    for suite in suites:
        name = suite.get("name", "")
        for case in suite.iter("testcase"):
            # pytest names the module of a test: tests.ROOM.FILE
            parts = case.get("classname", "").split(".")
            room = f"tools/tests/{parts[1]}" if parts[0] == "tests" and len(parts) > 2 else name
            seconds[room] += float(case.get("time", 0))
    return seconds
