"""What tools/test runs, shows and counts, and what its short run touches."""

import io
import subprocess
import sys
import threading
import time
from pathlib import Path

import pytest
from rich.console import Console

ROOT = Path(__file__).resolve().parents[3]
sys.path.insert(0, str(ROOT / "tools/test_steps"))
import part as part_module  # noqa: E402
import quick  # noqa: E402
import run  # noqa: E402
from part import Part  # noqa: E402

ENDING = 300.0  # [s] after which what has not happened will not happen


@pytest.fixture(autouse=True)
def results(tmp_path, monkeypatch):
    """The logs of these parts lie in a folder for them."""
    for module in (part_module, run):
        monkeypatch.setattr(module, "RESULTS", tmp_path)
        monkeypatch.setattr(module, "ROOT", tmp_path)
    return tmp_path


def awaited(condition) -> None:
    """Wait until it holds."""
    end = time.monotonic() + ENDING
    while not condition():
        assert time.monotonic() < end
        time.sleep(0.01)


def ended(*lanes, first=()) -> list[Part]:
    """The parts of lanes that have been run."""
    run.run(first, lanes)
    return [*first, *(part for lane in lanes for part in lane)]


def test_parts_that_passed_are_summed_with_their_times(capsys):
    parts = ended([Part("a", [["echo", "it is done"]])], [Part("b", [["true"], ["true"]])])
    assert run.sum_up(parts) == 0
    shown = capsys.readouterr().out
    *_, row_a, row_b, slowest, last = shown.splitlines()
    assert row_a.split()[:6] == ["a", "0:00", "1", "passed", "0", "failed"]
    assert row_b.split()[:3] == ["b", "0:00", "2"] and row_b.endswith("s of CPU")
    assert slowest.startswith("Slowest: ") and last == "3 passed, 0 failed"
    assert (parts[0].log).read_text() == "it is done\n" and "it is done" not in shown


def test_a_part_that_fails_is_named_at_once_and_its_end_is_shown(capsys):
    parts = ended([Part("a", [["sh", "-c", "echo why; exit 3"]])], [Part("b", [["true"]])])
    assert run.sum_up(parts) == 1
    shown = capsys.readouterr().out
    assert shown.startswith("FAILED a: a\n") and "\nwhy\n" in shown
    assert shown.splitlines()[-1] == "1 passed, 1 failed"


@pytest.mark.parametrize("script", ["true", "kill -KILL $$"])
def test_a_part_that_counts_nothing_or_dies_has_failed(results, script):
    parts = ended([Part("a", [["sh", "-c", script]], junit=results / "absent.xml")])
    assert run.sum_up(parts) == 1 and (parts[0].passed, parts[0].failed) == (0, 1)


def test_what_comes_first_and_fails_ends_the_run(capsys):
    parts = ended([Part("b", [["true"]])], first=[Part("a", [["false"]])])
    assert run.sum_up(parts) == 1
    shown = capsys.readouterr().out.splitlines()
    assert shown[-3].split() == ["b", "was", "not", "reached"] and shown[-1] == "0 passed, 2 failed"


def test_a_run_of_nothing_does_not_pass(capsys):
    assert run.sum_up([]) == 1
    assert capsys.readouterr().out.endswith("0 passed, 0 failed\n")


LINES = (
    "[gw1] [ 12%] PASSED tools/tests/x/test_x.py::test_a \n"
    "[gw0] [ 25%] FAILED tools/tests/x/test_x.py::test_b[1 2] \n"
    "Machines/Tile.Law/Wide\t[PASSED]\nMachines/Tile.Law/Soft\t[FAILED]\n[gw9] no test\n"
)


def test_a_part_shows_how_far_it_is_and_names_failures_as_they_come(results):
    release = results / "release"
    script = f"printf %b '{LINES}'; until [ -e {release} ]; do sleep 0.01; done"
    part = Part("tests", [["sh", "-c", script]], junit=results / "none.xml")
    worker = threading.Thread(target=part.run)
    worker.start()
    awaited(lambda: len(part.failures) == 2)
    (row,) = run.rows([part, Part("waits", [["true"]])])
    assert row.split()[2:] == ["2", "passed", "2", "failed", "...", "25", "%"]
    shown = io.StringIO()
    run.show_failures([part], Console(file=shown, soft_wrap=True))
    names = ["tools/tests/x/test_x.py::test_b[1 2]", "Machines/Tile.Law/Soft"]
    assert shown.getvalue() == "".join(f"FAILED tests: {name}\n" for name in names)
    release.touch()
    worker.join(ENDING)
    # The file of the counts has the last word.
    assert (part.passed, part.failed) == (0, 1)


def test_a_part_that_is_stopped_ends_with_all_that_it_started():
    part = Part("long", [["sh", "-c", "sleep 1000 & wait"], ["true"]])
    worker = threading.Thread(target=part.run)
    worker.start()
    awaited(lambda: part.process)
    part.stop()
    worker.join(ENDING)
    assert not worker.is_alive() and (part.passed, part.failed) == (0, 1)


def test_the_usual_run_leaves_out_what_is_slow_by_nature_and_nothing_else():
    def names_and_words(slow):
        first, lanes = run.everything(slow=slow)
        parts = [*first, *(part for lane in lanes for part in lane)]
        return [part.name for part in parts], parts[-1].commands[0]

    usual, words = names_and_words(False)
    all_of_it, all_words = names_and_words(True)
    assert (
        usual == all_of_it == ["firmware", "host tests", "fuzz", "bench", "checks", "Python tests"]
    )
    left_out = ["-m", "not slow"]
    assert [word for word in words if word not in left_out] == [
        word for word in all_words if word != "-m" or word not in left_out
    ]
    assert words[-3:-1] == left_out and "not slow" not in all_words
    checks = {path.stem for path in (ROOT / "tools/checks").glob("*.py")}
    library = {"calls", "tree"}
    assert {*quick.QUICK_CHECKS, *quick.SLOW_CHECKS} == checks - library


def test_an_unknown_word_is_refused():
    done = subprocess.run([ROOT / "tools/test", "fats"], capture_output=True, text=True)
    assert (done.returncode, done.stdout) == (2, "")
    assert "use tools/test, tools/test all or tools/test quick" in done.stderr


def touched(*files: str) -> quick.Touched:
    asked = quick.Touched()
    for file in files:
        asked.add(file)
    return asked


@pytest.fixture
def project(monkeypatch):
    monkeypatch.setattr(quick, "ROOT", ROOT)


@pytest.mark.parametrize(
    ("file", "slow"),
    [
        ("tools/plumb/fit/fit.py", {"annotations", "generated"}),
        ("lib/Kinematics/src/frame.h", {"generated"}),
        ("src/settings_table.h", {"generated"}),
        ("docs/effects.md", {"generated"}),
        ("lib/Motion/src/corner.h", set()),
    ],
)
def test_the_short_run_asks_a_slow_check_where_an_edit_could_fail_it(project, file, slow):
    asked = touched(file, file)
    assert asked.checks[: len(quick.QUICK_CHECKS)] == list(quick.QUICK_CHECKS)
    assert sorted(asked.checks[len(quick.QUICK_CHECKS) :]) == sorted(slow)
    for check in quick.SLOW_CHECKS:
        assert (f"check {check}," in asked.left_out()) == (check not in slow)


@pytest.mark.parametrize(
    ("file", "suites", "rooms", "firmware"),
    [
        ("src/machine/pause.cpp", "test_machine test_dialogues", "tools/tests/settings", True),
        ("lib/GCode/src/Words.cpp", "test_gcode test_dialogues", "", True),
        ("lib/Motion/src/Motion.h", "test_motion test_control", "", True),
        ("test/test_motion/test_mover.cpp", "test_motion", "", False),
        ("tools/plumb/fit/fit.py", "", "tools/tests/fit", False),
        # An edited test alone asks for itself, and a tool or a page for the tests of its room.
        ("tools/tests/fit/test_fit.py", "", "tools/tests/fit/test_fit.py", False),
        ("tools/tests/lab/screens.py", "", "tools/tests/lab", False),
        ("tools/setup_steps/debian.sh", "", "tools/tests/project/test_setup.py", False),
        ("tools/demo", "", "tools/tests/project", False),
        ("tools/plumb/effects/new/gone.py", "", "", False),
    ],
)
def test_the_short_run_runs_what_belongs_to_an_edited_file(project, file, suites, rooms, firmware):
    asked = touched(file)
    assert asked.suites == {*suites.split()} and asked.rooms == {*rooms.split()}
    assert asked.builds_firmware == firmware
    _, (checks, builds) = asked.parts()
    names = ["firmware"] * firmware + ["host tests"] * bool(suites)
    assert [part.name for part in checks] == ["checks"]
    assert [part.name for part in builds] == names + ["setup", "Python tests"] * bool(rooms)


def test_every_suite_and_room_that_the_short_run_names_is_there():
    for _, suites, rooms in quick.ROWS:
        assert all((ROOT / "test" / suite).is_dir() for suite in suites)
        assert all((ROOT / room).exists() for room in rooms)
