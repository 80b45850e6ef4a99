"""What tools/test reads in a JUnit file: nothing that failed is counted as passed."""

import sys
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "test_steps"))
from counts import count, seconds_by_group

GOOD = '<testcase name="a"/>'
EXIT_CODE = '<testcase name="native:test_a"><error/></testcase>'


def suite(cases: str) -> str:
    return f'<testsuite name="native:test_a" timestamp="2020-01-01">{cases}</testsuite>'


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
    assert count(path, status) == tuple(map(int, expected.split()))


def test_an_empty_suite_next_to_a_full_suite_is_a_failure(tmp_path):
    path = tmp_path / "junit.xml"
    path.write_text(f"<testsuites>{suite(GOOD)}{suite('')}</testsuites>")
    assert count(path, 0) == (1, 1)


def test_suite_that_did_not_run_is_not_counted(tmp_path):
    path = tmp_path / "junit.xml"
    path.write_text(f"<testsuites>{suite(GOOD)}<testsuite name='mega:test_a'/></testsuites>")
    assert count(path, 0) == (1, 0)


def test_missing_file_is_a_failure(tmp_path):
    assert count(tmp_path / "none.xml", 0) == (0, 1)


def test_torn_file_is_a_failure(tmp_path):
    path = tmp_path / "junit.xml"
    path.write_text("<testsuites>")
    assert count(path, 0) == (0, 1)


def test_seconds_are_added_up_by_suite_and_by_room(tmp_path):
    path = tmp_path / "junit.xml"
    room = '<testcase classname="tests.lab.test_{}" name="t" time="{}"/>'
    cases = room.format("a", 1.5) + room.format("b.Class", 2) + '<testcase name="c" time="0.5"/>'
    path.write_text(f"<testsuites>{suite(cases)}</testsuites>")
    assert seconds_by_group(path) == {"tools/tests/lab": 3.5, "native:test_a": 0.5}
    assert not seconds_by_group(tmp_path / "none.xml")
