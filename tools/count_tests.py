"""Counts a JUnit file: `count_tests.py FILE STATUS` prints how many tests passed and failed.

STATUS is the exit code of the command that wrote the file. A skipped test counts as failed: it
proved nothing. So does a suite without tests, a missing file, and a status unexplained.
"""

import sys
import xml.etree.ElementTree as ElementTree
from pathlib import Path

FAILED = {"failure", "error", "skipped"}


def count(path: Path, status: int) -> tuple[int, int]:
    """Tests that passed, tests that failed."""
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
    """The same for one suite."""
    cases = list(suite.iter("testcase"))
    if not cases:
        # Only a suite that ran has a time stamp; PlatformIO also lists those of other environments.
        return 0, int("timestamp" in suite.attrib)
    failed = [case for case in cases if any(child.tag in FAILED for child in case)]
    # PlatformIO adds the program's exit code as one more case, named like the suite.
    added = [case for case in failed if case.get("name") == suite.get("name")]
    return len(cases) - len(failed), len(failed) - (len(added) if len(failed) > len(added) else 0)


if __name__ == "__main__":
    print(*count(Path(sys.argv[1]), int(sys.argv[2])))
