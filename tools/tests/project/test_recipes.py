"""The recipes of docs/ and tools/demo are carried out as they stand; a recipe, in a copy."""

import json
import re
import shutil
import subprocess
import sys
import types

import pytest
from example_machine import ROOT
from plumb.cli import main

sys.path.insert(0, str(ROOT / "tools/bench"))
from commands import compiled

PAGE = ROOT / "docs/new-effect.md"
EIGEN = ROOT / ".pio/libdeps/native/ArduinoEigen/ArduinoEigen"
HEADER = re.compile(r"`([\w/.]+\.h)`, with its words.*?```cpp\n(.*?)```", re.DOTALL)
RECIPES = ROOT / "docs/recipes.md"
NAMED = re.compile(r"\[`(\w+)`\]\(([^)#]+)[^)]*\)")
LINES = 25  # of a recipe, at most
DIFF = re.compile(r"```diff\n--- a/(\S+)\n\+\+\+ b/\S+\n(.*?)```", re.DOTALL)


@pytest.fixture(scope="module")
def copy(tmp_path_factory):
    """The files that the recipe of a new effect changes, and the program that asks the judge."""
    folder = tmp_path_factory.mktemp("tree")
    for part in ("lib/Kinematics/src", "tools/judge/reference", "test/test_effects"):
        shutil.copytree(ROOT / part, folder / part)
    shutil.copy(ROOT / "tools/tests/project/judge_errors.cpp", folder)
    return folder


@pytest.mark.slow
def test_the_page_of_a_new_effect_leads_to_the_judges_approval(copy):
    path, header = HEADER.search(PAGE.read_text(encoding="utf-8")).groups()
    (copy / "lib/Kinematics/src" / path).write_text(header, encoding="utf-8")
    assert "mount_give.h: has no setting: give it a line At<NUMBER, MountGive>" in checked(copy)
    line, mechanics = DIFF.findall(PAGE.read_text(encoding="utf-8"))
    apply(copy, *line)
    assert "each has its line" in checked(copy)
    refused = judged(copy)
    assert refused.returncode and "no number left.give: add its mechanics" in refused.stderr
    apply(copy, *mechanics)
    approved = judged(copy)
    assert approved.returncode == 0, approved.stderr
    with_it, without, at_the_bit = json.loads(approved.stdout)["mount_give_soft_mounts"]
    assert with_it < 0.006 and at_the_bit < 0.008 and without > 0.3


def section(title):
    """One recipe of the page."""
    return RECIPES.read_text(encoding="utf-8").partition(f"## {title}\n")[2].partition("\n## ")[0]


def test_every_name_of_a_recipe_is_in_its_file():
    named = NAMED.findall(RECIPES.read_text(encoding="utf-8"))
    missing = [
        f"docs/recipes.md: {path} has no {name}: correct the recipe"
        for name, path in named
        if not re.search(rf"\b{name}\b", (RECIPES.parent / path).read_text(encoding="utf-8"))
    ]
    assert len(named) > 15 and not missing, "\n".join(missing)


def test_recipes_are_short():
    for text in RECIPES.read_text(encoding="utf-8").split("\n## ")[1:]:
        prose = re.sub(r"```.*?```", "", text, flags=re.DOTALL)
        assert len(prose.strip().splitlines()) <= LINES, text.partition("\n")[0]


def test_a_row_is_all_that_a_setting_needs(tmp_path):
    for part in ("lib/Kinematics/src", "lib/Settings/src", "src"):
        shutil.copytree(ROOT / part, tmp_path / part)
    row = re.search(r"```cpp\n(.*?)```", section("A setting"), re.DOTALL)[1]
    row = "".join(line.removeprefix("   ") for line in row.splitlines(keepends=True)).rstrip()
    table = tmp_path / "src/settings_table.h"
    text = table.read_text(encoding="utf-8")
    assert text.count("\n\n#define PLUMB_KEPT_SETTINGS") == 1
    taken = {int(number) for number in re.findall(r"ROW\(k\w+, (\d+),", text)}
    assert int(re.search(r"ROW\(k\w+, (\d+),", row)[1]) not in taken
    text = text.replace(
        "\n\n#define PLUMB_KEPT_SETTINGS", f" \\\n{row}\n\n#define PLUMB_KEPT_SETTINGS"
    )
    table.write_text(text, encoding="utf-8")
    (tmp_path / "ask.cpp").write_text(
        '#include <cstdio>\n#include "settings_flash.h"\n'
        "int main() { std::puts(flash_rows::kComments[kBeepLength]); "
        "return flash_rows::kRows[kBeepLength].number; }\n"
    )
    flash = ROOT / "tools/vm/host_avr"
    includes = ["-Ilib/Kinematics/src", "-Ilib/Settings/src", "-Isrc", f"-I{flash}"]
    sources = ["ask.cpp", *sorted(map(str, (tmp_path / "lib/Settings/src").glob("*.cpp")))]
    command = ["g++", "-std=c++17", "-O0", *includes, *sources, "-o", "ask"]
    subprocess.run(command, cwd=tmp_path, check=True)
    said = subprocess.run([tmp_path / "ask"], capture_output=True, text=True)
    assert (said.stdout, said.returncode) == ("beep_length, ms\n", 79)


def test_a_file_and_a_line_are_all_that_a_command_needs(monkeypatch, capsys):
    (code,) = re.findall(r"```python\n(.*?)```", section("A command of the lab"), re.DOTALL)
    module = types.ModuleType("plumb.cli.hello")
    exec("".join(line.removeprefix("   ") for line in code.splitlines(True)), module.__dict__)
    monkeypatch.setitem(sys.modules, "plumb.cli.hello", module)
    monkeypatch.setattr(main, "COMMANDS", {**main.COMMANDS, "hello": "say hello"})
    assert main.main(["hello"]) == 0 and capsys.readouterr().out == "hello\n"


def checked(folder):
    """The output of the registry's check on a copy."""
    command = [ROOT / ".venv/bin/python", ROOT / "tools/checks/effects.py", folder]
    return subprocess.run(command, capture_output=True, text=True).stdout


def apply(folder, path, hunks):
    """Changes a file as a diff without line numbers says; each hunk must fit exactly once."""
    text = (folder / path).read_text(encoding="utf-8")
    for hunk in re.split(r"^@@.*\n", hunks, flags=re.MULTILINE)[1:]:
        lines = hunk.splitlines(keepends=True)
        old = "".join(line[1:] for line in lines if line[0] in " -")
        new = "".join(line[1:] for line in lines if line[0] in " +")
        assert text.count(old) == 1, f"{PAGE.name}: {path} has changed, correct the page:\n{hunk}"
        text = text.replace(old, new)
    (folder / path).write_text(text, encoding="utf-8")


def judged(folder):
    """The distances between the laws of a copy and its judge."""
    program = folder / "judge_errors"
    includes = ["lib/Kinematics/src", "tools/judge", "test/test_effects"]
    judge = (path.relative_to(folder) for path in folder.glob("tools/judge/reference/*.cpp"))
    sources = ["judge_errors.cpp", "lib/Kinematics/src/Kinematics.cpp", *sorted(judge)]
    options = ["-O1", "-isystem", EIGEN, *(f"-I{part}" for part in includes)]
    compiled(program, sources, options=options, folder=folder)
    return subprocess.run([program, "mount_give"], capture_output=True, text=True)


@pytest.mark.slow
def test_the_demo_ends_with_the_hidden_effect_named_and_a_better_machine():
    program = [ROOT / "tools/demo", "--seed", "2"]
    said = subprocess.run(program, capture_output=True, text=True, check=True).stdout
    played, revealed = said.split("$ plumb practice reveal")
    assert "chain_stretch" not in played
    assert "Hidden was chain_stretch" in revealed and "You found chain stretch." in revealed
    before, after = map(float, re.findall(r"\d\.\d+$", revealed, re.MULTILINE))
    assert after < 0.2 * before
    assert "The machine is as it was fitted" in played
    assert (ROOT / "build/demo/error-falls.png").read_bytes().startswith(b"\x89PNG")
