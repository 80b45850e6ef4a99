"""What tools/test counts, and what its short run touches."""

import subprocess
from pathlib import Path

import pytest

ROOT = Path(__file__).resolve().parents[3]
STEPS = """
set -uo pipefail
root=$1 results=$2 python=python3
source "$root/tools/test_steps/parts.sh"
source "$root/tools/test_steps/quick.sh"
set_out
"""


def run(tmp_path: Path, script: str) -> subprocess.CompletedProcess:
    command = ["bash", "-c", STEPS + script, "steps", ROOT, tmp_path / "results"]
    return subprocess.run(command, capture_output=True, text=True, cwd=ROOT)


def test_parts_that_passed_are_summed_with_their_times(tmp_path):
    done = run(tmp_path, "parts=(a b); one a echo said; one b true; summary")
    assert done.returncode == 0
    assert "=== a ===\nsaid\n" in done.stdout
    *_, row_a, row_b, last = done.stdout.splitlines()
    assert row_a.split()[:5] == ["a", "1", "passed", "0", "failed"] and row_a.endswith(" s")
    assert row_b.split()[0] == "b"
    assert last.startswith("2 passed, 0 failed in ")


@pytest.mark.parametrize(
    "script",
    [
        "parts=(a b); one a true; one b false; summary",
        "parts=(a b); one a true; summary",  # b was never reached
        "parts=(a b); one a true; (kill -KILL $BASHPID; one b true) & wait; summary",  # it died
        f"parts=(a b); one a true; many b {ROOT}/absent.xml true; summary",  # it counted nothing
    ],
)
def test_a_part_that_fails_or_dies_counts_as_failed(tmp_path, script):
    done = run(tmp_path, script)
    assert done.returncode == 1
    assert done.stdout.splitlines()[-1].startswith("1 passed, 1 failed in ")


def test_a_run_of_nothing_does_not_pass(tmp_path):
    assert run(tmp_path, "parts=(); summary").returncode == 1


def test_counts_of_an_earlier_run_are_forgotten(tmp_path):
    assert run(tmp_path, "parts=(a); one a true; set_out; summary").returncode == 1


def test_each_check_counts(tmp_path):
    folder = tmp_path / "tools/checks"
    folder.mkdir(parents=True)
    (folder / "arrows.py").write_text("print('no arrow is wrong')")
    (folder / "size.py").write_text("raise SystemExit(1)")
    done = run(tmp_path, f"parts=(checks); cd {tmp_path}; checks; summary")
    assert done.returncode == 1
    assert "no arrow is wrong" in done.stdout
    # Those that are not there fail, too.
    names = len(list((ROOT / "tools/checks").glob("*.py")))
    row = done.stdout.splitlines()[-2].split()
    assert row[1] == "1" and 5 < int(row[3]) < names


def touched(tmp_path: Path, file: str) -> str:
    script = f"suites=() rooms=() to_check=() builds_firmware=no; touched_by {file}\n"
    show = 'echo "${suites[*]} ${rooms[*]} $builds_firmware"'
    return run(tmp_path, script + show).stdout.strip()


@pytest.mark.parametrize(
    ("file", "slow"),
    [
        ("tools/plumb/fit/fit.py", "annotations generated"),
        ("lib/Kinematics/src/frame.h", "generated"),
        ("src/settings_table.h", "generated"),
        ("docs/effects.md", "generated"),
        ("lib/Motion/src/corner.h", ""),
    ],
)
def test_the_short_run_asks_a_slow_check_where_an_edit_could_fail_it(tmp_path, file, slow):
    script = f"suites=() rooms=() to_check=(); touched_by {file}; "
    assert run(tmp_path, script + 'echo "${to_check[*]}"').stdout.strip() == slow
    said = run(tmp_path, script + "say_left_out").stdout
    for check in ("annotations", "generated"):
        assert (f", check {check}," in said) == (check not in slow.split())


def test_the_short_run_runs_the_suites_and_rooms_of_an_edited_file(tmp_path):
    assert touched(tmp_path, "src/machine/pause.cpp") == (
        "test_machine test_dialogues tools/tests/settings yes"
    )
    assert touched(tmp_path, "lib/GCode/src/Words.cpp") == "test_gcode test_dialogues  yes"
    assert touched(tmp_path, "test/test_motion/test_mover.cpp") == "test_motion  no"
    assert touched(tmp_path, "tools/plumb/fit/fit.py") == "tools/tests/fit no"
    # An edited test alone asks for itself, and a tool or a page for the tests of its room.
    assert touched(tmp_path, "tools/tests/fit/test_fit.py") == "tools/tests/fit/test_fit.py no"
    project = "tools/tests/project"
    assert touched(tmp_path, "docs/words.md") == (
        f"{project}/test_docs.py {project}/test_recipes.py no"
    )
    assert touched(tmp_path, "tools/setup_steps/debian.sh") == f"{project}/test_setup.py no"
    assert touched(tmp_path, "tools/mutation/cxx.py") == f"{project}/test_mutation.py no"
    assert touched(tmp_path, "tools/demo") == f"{project} no"


def test_every_suite_and_room_that_the_short_run_names_is_there():
    text = (ROOT / "tools/test_steps/quick.sh").read_text()
    named = {word.strip("()") for word in text.replace("+=(", " ").split()}
    suites = {word for word in named if word.startswith("test_") and word.isidentifier()}
    rooms = {word for word in named if word.startswith("tools/tests/") and "$" not in word}
    named_files = {word.strip('"()') for word in named if word.startswith('"$project/')}
    for file in named_files:
        assert (ROOT / file.replace("$project", "tools/tests/project")).is_file(), file
    assert len(named_files) >= 8
    assert all((ROOT / "test" / suite).is_dir() for suite in suites)
    assert {"test_kinematics", "test_dialogues"} <= suites
    assert all((ROOT / room).is_dir() for room in rooms if "*" not in room)
