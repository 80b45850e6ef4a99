"""The lab answers only with modules that were compiled from the C++ of its clone."""

import json

import pytest
import write
from plumb.text import compiled

SAG = "lib/Kinematics/src/effects/chain_sag.h"


@pytest.fixture
def clone(tmp_path):
    """A folder with C++ in each place that the lab compiles, and some that it does not."""
    for name in (SAG, "src/machine/cut.cpp", "tools/core/dual.h", "tools/vm/world/sled.cpp"):
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_text("int x;\n")
    for name in ("src/main.cpp", "lib/Kinematics/README.md"):
        (tmp_path / name).write_text("x")
    return tmp_path


def test_the_compiled_modules_are_those_of_the_sources():
    assert compiled.stale_source() is None
    names = {*compiled.digests()}
    assert {SAG, "src/settings_table.h", "tools/core/binding.cpp"} <= names
    assert {"src/machine/waiting.cpp", "tools/vm/binding.cpp"} <= names
    assert not any(name.startswith(("src/board", "test/")) for name in names)


def test_an_edit_a_new_file_and_a_lost_one_are_stale(clone):
    built = compiled.digests(clone)
    assert compiled.stale_source(clone, built) is None
    (clone / "src/main.cpp").write_text("y")
    assert compiled.stale_source(clone, built) is None
    (clone / "lib/Kinematics/src/rust.h").write_text("")
    assert compiled.stale_source(clone, built) == "lib/Kinematics/src/rust.h"
    built = compiled.digests(clone)
    (clone / "tools/core/dual.h").unlink()
    assert compiled.stale_source(clone, built) == "tools/core/dual.h"
    (clone / SAG).write_text("int y;\n")
    assert compiled.stale_source(clone, built) == SAG


def test_a_build_without_a_note_is_stale(clone, monkeypatch, tmp_path):
    monkeypatch.setattr(compiled, "NOTE", "absent.json")
    assert compiled.stale_source(clone) == SAG


@pytest.fixture
def an_edit(monkeypatch):
    """The build noted another chain_sag.h."""
    noted = compiled.digests() | {SAG: "0"}
    monkeypatch.setattr(compiled, "_note", lambda: noted)
    monkeypatch.setattr("plumb.cli.output.refuse_stale", compiled.refuse_stale)


def test_every_program_refuses_in_one_line(an_edit, run):
    said = f"{SAG}: the lab was built without this change; run tools/setup"
    assert run("effects") == (2, "", f"plumb: {said}\n")
    code, answer, _ = run("effects", "--json")
    assert (code, json.loads(answer)) == (2, {"error": said})


def test_the_generators_of_pages_refuse(an_edit, capsys, tmp_path):
    assert write.main(["--folder", str(tmp_path)]) == 2
    assert capsys.readouterr().err.startswith(f"write.py: {SAG}: ")
    assert write.main(["--check"]) == 2
    assert not any(tmp_path.iterdir())
