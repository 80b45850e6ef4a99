"""Sketches: a twin of an effect of the firmware is ranked and fitted like the effect itself."""

import json
import os
import shutil
import subprocess
from dataclasses import replace
from pathlib import Path

import pytest
from hidden_boards import board
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER, Cause, Hidden
from plumb.settings.toml import machine_toml
from synthetic import csv_of

ROOT = Path(__file__).resolve().parents[3]
PLUMB = ROOT / ".venv/bin/plumb"
FOLDER = ROOT / "tools/plumb/model/sketches"
TWIN = """
from plumb.model.sketches import Sketch, SketchParameter

def extra(parameters, strands):
    return strands.length / (1 + parameters[0] * strands.tension) - strands.length

SKETCH = Sketch(
    name="twin", summary="s", pattern="p", look_alikes="l", remedy="r", extra=extra,
    parameters=(SketchParameter("compliance", "1/N", 0.0, 1e-4, 5.2e-6, "strain per newton"),),
)
"""


@pytest.fixture(scope="module")
def stretched(tmp_path_factory):
    """A folder with a machine that believes its chains stiff, and marks by the judge's chains."""
    folder = tmp_path_factory.mktemp("stretched")
    (folder / "own").mkdir()
    (folder / "own/twin.py").write_text(TWIN)
    sag = {"chain_sag": MAKER.effects["chain_sag"]}
    # What is fitted must start without stretch; the marks are made by chains three times as soft.
    marks = board({"chain_stretch": 2.0}, plan(5, 5), seed=3, noise=0.05, tape_sigma=0.05)
    (folder / "cut.toml").write_text(machine_toml(MAKER))
    (folder / "machine.toml").write_text(machine_toml(replace(MAKER, effects=sag)))
    (folder / "marks.csv").write_text(csv_of(marks.marks))
    return folder


def run(folder, *arguments, folder_of_user="own"):
    """`plumb` in the folder, with the owner's sketches."""
    environment = {**os.environ, "PLUMB_SKETCHES": str(folder / folder_of_user)}
    return subprocess.run(
        [PLUMB, *arguments], cwd=folder, env=environment, capture_output=True, text=True
    )


def answer(folder, *arguments):
    """What `plumb --json` says."""
    done = run(folder, *arguments, "--json")
    assert done.returncode in (0, 1), done.stderr
    return json.loads(done.stdout)


BOARD = ("machine.toml", "marks.csv", "--cut-with", "cut.toml", "--sigma", "0.05")


def test_a_twin_is_ranked_like_the_effect_itself(stretched):
    said = answer(stretched, "diagnose", *BOARD)
    ranking = {words["effect"]: words for words in said["ranking"]}
    twin, real = ranking["twin"], ranking["chain_stretch"]
    assert twin["where"] == "sketch" and real["where"] == "firmware"
    assert twin["gain"] == pytest.approx(real["gain"], rel=1e-3) and real["gain"] > 100
    # Both explain the marks alike, and nothing else does.
    assert {*said["suspects"]} == {"twin", "chain_stretch"}


def test_a_twin_is_fitted_like_the_effect_itself(stretched):
    sizes = {}
    for name in ("twin", "chain_stretch"):
        said = answer(stretched, "add", *BOARD, "--effect", name)
        sizes[name] = {words["name"]: words for words in said["parameters"]}[f"{name}.compliance"]
        assert said["after"]["fit_rms_mm"] < 0.1
    assert sizes["twin"]["value"] == pytest.approx(sizes["chain_stretch"]["value"], rel=0.01)
    assert sizes["twin"]["low"] == pytest.approx(sizes["chain_stretch"]["low"], rel=0.02)
    assert (
        sizes["twin"]["low"]
        < 3 * MAKER.effect("chain_stretch", "compliance")
        < sizes["twin"]["high"]
    )


def test_a_sketch_is_marked_and_never_written_as_a_setting(stretched):
    text = run(stretched, "add", *BOARD, "--effect", "twin").stdout
    assert "a sketch, which no firmware has" in text
    refused = run(stretched, "add", *BOARD, "--effect", "twin", "-o", "new.toml")
    assert refused.returncode == 2 and "twin is a sketch" in refused.stderr
    assert not (stretched / "new.toml").exists()


@pytest.mark.parametrize(
    ("text", "hint"),
    [
        ("SKETCH = 1", "no SKETCH"),
        (TWIN.replace('name="twin"', 'name="chain_sag"'), "there is an effect chain_sag already"),
        (TWIN.replace("- strands.length\n", "\n"), "extra() must give zeros"),
        (TWIN.replace(", extra=extra", ""), "needs extra(), the chain it adds, or push()"),
    ],
    ids=["empty", "taken", "at zero", "no hook"],
)
def test_a_sketch_that_cannot_be_used_is_told_in_one_line(tmp_path, text, hint):
    (tmp_path / "own").mkdir()
    (tmp_path / "own/bad.py").write_text(text)
    done = run(tmp_path, "effects")
    assert done.returncode == 2 and done.stdout == ""
    assert hint in done.stderr and "bad.py" in done.stderr and done.stderr.count("\n") == 1


def test_a_hose_that_pulls_the_sled_is_fitted_in_newtons(tmp_path):
    (tmp_path / "own").mkdir()
    shutil.copy(FOLDER / "_dust_hose.py", tmp_path / "own/dust_hose.py")
    (tmp_path / "machine.toml").write_text(machine_toml(MAKER))
    hose = Cause("", "", lambda _: {"push_right": 6.0, "push_up": -4.0})
    marks = cut(Hidden(((hose, 1.0),)), plan(5, 5), seed=5, noise=0.05, tape_sigma=0.05)
    (tmp_path / "marks.csv").write_text(csv_of(marks.measurements.marks))
    said = answer(tmp_path, "add", *BOARD[:2], *BOARD[4:], "--effect", "dust_hose")
    sizes = {words["name"]: words["value"] for words in said["parameters"]}
    assert sizes["dust_hose.right"] == pytest.approx(6.0, abs=0.3)
    assert sizes["dust_hose.up"] == pytest.approx(-4.0, abs=0.6)
    assert said["after"]["fit_rms_mm"] < 0.1 < said["before"]["fit_rms_mm"]
