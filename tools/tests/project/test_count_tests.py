"""Tests of tools/count_tests.py: nothing that failed is counted as passed."""

import subprocess
import sys
from pathlib import Path

import pytest

SCRIPT = Path(__file__).resolve().parents[2] / "count_tests.py"
GOOD = '<testcase name="a"/>'
EXIT_CODE = '<testcase name="native:test_a"><error/></testcase>'


def suite(cases: str) -> str:
    return f'<testsuite name="native:test_a" timestamp="2020-01-01">{cases}</testsuite>'


def counted(path: Path, status: int) -> str:
    command = [sys.executable, SCRIPT, path, str(status)]
    return subprocess.run(command, capture_output=True, text=True, check=True).stdout.strip()


@pytest.mark.parametrize(
    ("cases", "status", "expected"),
    [
        (GOOD * 2, 0, "2 0"),
        (GOOD + "<testcase name='b'><failure/></testcase>", 1, "1 1"),
        ("<testcase name='b'><error/></testcase>", 1, "0 1"),
        (GOOD + "<testcase name='b'><skipped/></testcase>", 0, "1 1"),
        (GOOD, 139, "1 1"),
        (GOOD + "<testcase name='a'><failure/></testcase>" + EXIT_CODE, 1, "1 1"),
        (GOOD + EXIT_CODE, 1, "1 1"),
        ("", 0, "0 1"),
    ],
    ids=[
        "all pass",
        "failure",
        "error",
        "skipped",
        "unexplained status",
        "failure and exit code",
        "crash",
        "no tests",
    ],
)
def test_counts_what_the_file_says(tmp_path, cases, status, expected):
    path = tmp_path / "junit.xml"
    path.write_text(f"<testsuites>{suite(cases)}</testsuites>")
    assert counted(path, status) == expected


def test_empty_suite_beside_a_full_one_is_a_failure(tmp_path):
    path = tmp_path / "junit.xml"
    path.write_text(f"<testsuites>{suite(GOOD)}{suite('')}</testsuites>")
    assert counted(path, 0) == "1 1"


def test_suite_that_did_not_run_is_not_counted(tmp_path):
    path = tmp_path / "junit.xml"
    path.write_text(f"<testsuites>{suite(GOOD)}<testsuite name='mega:test_a'/></testsuites>")
    assert counted(path, 0) == "1 0"


def test_missing_file_is_a_failure(tmp_path):
    assert counted(tmp_path / "none.xml", 0) == "0 1"


def test_torn_file_is_a_failure(tmp_path):
    path = tmp_path / "junit.xml"
    path.write_text("<testsuites>")
    assert counted(path, 0) == "0 1"
