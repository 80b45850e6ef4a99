"""Tests of tools/test with small commands in place of the tests."""

import os
import signal
import subprocess
import sys

import pytest
from example_machine import ROOT

sys.path.insert(0, str(ROOT / "tools/steps"))
import run_tests as run
from run_tests import Part


@pytest.fixture(autouse=True)
def results(tmp_path, monkeypatch):
    """These parts leave their logs in a folder of their own."""
    monkeypatch.setattr(run, "RESULTS", tmp_path)
    return tmp_path


def summed(capsys, *lanes: list[Part]) -> tuple[int, list[str]]:
    run.run(lanes)
    code = run.sum_up([part for lane in lanes for part in lane])
    return code, capsys.readouterr().out.splitlines()


def test_a_failure_is_named_at_once_shown_at_the_end_and_leaves_the_other_parts_running(capsys):
    lane = [Part("a", [["sh", "-c", "echo why; exit 3"]]), Part("b", [["true"], ["true"]])]
    code, shown = summed(capsys, lane, [Part("c", [["echo", "fine"]])])
    assert code == 1 and shown[0] == "FAILED a: echo why; exit 3"
    assert "why" in shown and "fine" not in shown
    assert shown[-2].split()[:3] == ["c", "0:00", "1"] and shown[-1] == "3 passed, 1 failed"


@pytest.mark.parametrize(
    ("said", "status", "failures"),
    [
        ("", 0, []),
        ("[gw0] [ 25%] FAILED tools/tests/x.py::test_b[1 2]", 1, ["tools/tests/x.py::test_b[1 2]"]),
        ("[gw0] [ 25%] ERROR tools/tests/x.py::test_b", 1, ["tools/tests/x.py::test_b"]),
        ("[gw1] [  5%] SKIPPED tools/tests/x.py::test_b", 0, ["tools/tests/x.py::test_b"]),
        ("test/a.cpp:7: Tile.Law/Soft\t[FAILED]", 1, ["test/a.cpp:7: Tile.Law/Soft"]),
        ("native:test_a\t[ERRORED]", 1, ["native:test_a"]),
        ("", 139, ["ended with 139"]),
    ],
)
def test_nothing_that_failed_or_did_not_run_counts_as_passed(capsys, said, status, failures):
    script = 'printf "%b\\n" "[gw0] [  1%] PASSED x::a" "x.cpp:1: T.b\\t[PASSED]" "$1"; exit $2'
    part = Part("x", [["sh", "-c", script, "", said, str(status)]], is_suite=True)
    code, shown = summed(capsys, [part])
    assert [line for line in shown if line.startswith("FAILED x: ")] == [
        f"FAILED x: {each}" for each in failures
    ]
    assert code == bool(failures) and shown[-1] == f"2 passed, {len(failures)} failed"


def test_a_suite_without_a_test_fails(capsys):
    code, shown = summed(capsys, [Part("x", [["true"]], is_suite=True)])
    assert code == 1 and shown[-1] == "0 passed, 1 failed"


def test_the_usual_run_leaves_out_only_what_is_slow_and_a_word_it_does_not_know_is_refused():
    usual, everything = (
        [part for lane in run.lanes(what) for part in lane] for what in ("fast", "all")
    )
    assert [part.name for part in usual] == [part.name for part in everything]
    changed = [
        part.name
        for part, other in zip(usual, everything, strict=True)
        if part.commands != other.commands
    ]
    assert changed == ["Python tests"]
    done = subprocess.run([ROOT / "tools/test", "fats"], capture_output=True, text=True)
    assert (
        done.returncode == 2 and "use tools/test, tools/test all or tools/test busy" in done.stderr
    )


def test_a_run_that_is_interrupted_ends_all_that_it_started(results):
    """Also the busy loops: none of its children is left when it has ended."""
    script = (
        f"import sys; sys.path[:0] = [{str(ROOT / 'tools/steps')!r}]; import run_tests as run\n"
        "from pathlib import Path\n"
        f"run.RESULTS = Path({str(results / 'r')!r})\n"
        "run.PIO = 'true'\n"
        "long = ['sh', '-c', 'echo begun; sleep 100']\n"
        "run.lanes = lambda what: [[run.Part('x', [long, long]), run.Part('y', [long])]]\n"
        "sys.argv[1:] = ['busy']; code = run.main()\n"
        "import time; time.sleep(0.5)  # in which nothing may begin\n"
        "sys.exit(code)\n"
    )
    work = subprocess.Popen([sys.executable, "-c", script], start_new_session=True)
    log = results / "r/x.log"
    while not (log.is_file() and log.read_text()):
        assert work.poll() is None
    session = ["ps", "-o", "pid=", "--sid", f"{work.pid}"]
    group = subprocess.run(session, capture_output=True, text=True)
    assert len(group.stdout.split()) == 1 + run.CORES
    os.kill(work.pid, signal.SIGINT)
    assert work.wait() == 130
    left = subprocess.run(session, capture_output=True, text=True)
    assert left.stdout.split() == []
    assert log.read_text() == "begun\n" and not (results / "r/y.log").exists()
