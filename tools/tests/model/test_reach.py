"""reach: which part of a sheet is usable, on the command line, in a grid and next to the tool."""

import re
from dataclasses import replace

import numpy as np
import plumb.grid as grids
import pytest
from plumb.grid import options
from plumb.model.predict import (
    CANNOT_HANG,
    REACH_LIMITS,
    TOO_SLACK,
    TOO_TIGHT,
    TOO_VERTICAL,
    USABLE,
    reach,
)
from plumb.model.reach import survey_sheet, with_soft_chains
from plumb.plan.sheet_reach import SIGNS, SheetReach
from plumb.settings.toml import write_machine_toml
from published_marks import SETTINGS
from synthetic import BELIEVED, SHEET, TRUE

SOFT, _ = with_soft_chains(BELIEVED)
PLACES = np.stack(
    np.meshgrid(np.linspace(-1219.2, 1219.2, 61), np.linspace(609.6, -609.6, 31)), axis=-1
).reshape(-1, 2)
CORNERS = np.array([[1150.0, -550.0], [1219.2, -609.6], [1200.0, -600.0], [0.0, 609.6]])


@pytest.fixture
def machine(tmp_path):
    """Writes a machine.toml, the usual machine with changes, and gives its path."""

    def write(**changes):
        path = tmp_path / "machine.toml"
        write_machine_toml(path, replace(SOFT, **changes))
        return path

    return write


def straight(**changes):
    """The tool's tensions (n, 2) [N] at PLACES."""
    plain = grids.PlainMachine(**changes)
    return np.array([grids.tensions(plain, x, y) for x, y in PLACES])


def test_every_verdict_has_its_place():
    verdict = reach(SOFT, CORNERS).verdict
    assert verdict.tolist() == [USABLE, TOO_SLACK, TOO_VERTICAL, USABLE]
    heavy = replace(SOFT, sled_weight=1.5 * SOFT.sled_weight)
    assert reach(heavy, CORNERS).verdict[3] == TOO_TIGHT
    assert reach(SOFT, [[0, 1100], [np.nan, 0], [1600, 0]]).verdict.tolist() == [CANNOT_HANG] * 3


@pytest.mark.parametrize("gap, offset", [(2978.4, 463.0), (2900.0, 300.0), (3602.0, 250.0)])
def test_the_tool_and_reach_refuse_the_same_places(gap, offset):
    pulls = straight(motor_spacing=gap, motor_offset=offset)
    most, least = REACH_LIMITS["most_tension"], REACH_LIMITS["least_tension"]
    tool = (pulls.max(axis=1) > most) | (pulls.min(axis=1) < least)
    height = SHEET[1] / 2 + offset
    ours = reach(replace(SOFT, motor_gap=gap, motor_height=height), PLACES).verdict != USABLE
    near = (np.abs(pulls.max(axis=1) / most - 1) < 0.05) | (pulls.min(axis=1) < 1.12 * least)
    near &= pulls.min(axis=1) > 0.94 * least
    assert not ((tool != ours) & ~near).any()
    assert tool.any() and (tool & ours).sum() > 0.5 * ours.sum()


def test_the_tool_has_the_limits_of_reach():
    assert REACH_LIMITS["most_tension"] == options.MAX_TENSION
    assert REACH_LIMITS["least_tension"] == options.MIN_TENSION
    assert REACH_LIMITS["least_free"] == grids.MIN_FREE_CHAIN


def test_chains_without_stretch_in_the_settings_stretch_as_usual():
    sag = SOFT.effect("chain_sag", "weight_ratio_squared")
    assert sag == pytest.approx(8.2e-12, rel=0.01)
    assert SOFT.effect("chain_stretch", "compliance") == pytest.approx(5.2e-6)
    known, assumed = with_soft_chains(TRUE)
    assert known == TRUE and assumed == ()
    absurd = {**TRUE.effects, "chain_sag": {"weight_ratio_squared": -4e-12}}
    cured, assumed = with_soft_chains(replace(TRUE, effects=absurd))
    assert cured.effect("chain_sag", "weight_ratio_squared") == sag
    said = "Your settings have a chain sag that no chain has. A usual chain is taken instead."
    assert assumed == (said,)
    none = {name: sizes for name, sizes in TRUE.effects.items() if name != "chain_sag"}
    _, assumed = with_soft_chains(replace(TRUE, effects=none))
    assert assumed == ("Your settings have no chain sag. A usual chain is taken instead.",)


def test_the_survey_finds_the_lower_corners_of_the_usual_machine():
    answer = survey_sheet(SOFT)
    assert 0.99 < answer.shares["usable"] < 1
    tightest, slackest, softest = answer.extremes
    assert slackest.place[1] == softest.place[1] == pytest.approx(-609.6)
    assert abs(softest.place[0]) == pytest.approx(1219.2)
    assert tightest.value == pytest.approx(165.14, rel=0.01)  # published
    assert slackest.value == pytest.approx(18.04, rel=0.015)
    far = {-1: "right", 1: "left"}[int(np.sign(slackest.place[0]))]
    assert slackest.side == far


def test_the_map_shows_the_sheet_as_it_hangs():
    survey = survey_sheet(replace(SOFT, motor_gap=2900.0, motor_height=909.6))
    lines = SheetReach(survey=survey, expected=None).map
    assert {len(line) for line in lines} == {77} and len(lines) == 39
    assert lines[0][38] == "T" and lines[-1][0] == lines[-1][-1] == "S"
    assert lines[20][38] == "." and set("".join(lines)) <= set(SIGNS)


def test_a_grid_that_the_tool_allows_is_refused_where_the_model_knows_better(run):
    for settings in ([], ["--settings", SETTINGS]):
        code, said, complaint = run("grid", "--places=-1219,-400", *settings)
        assert (code, said) == (2, "")
        assert "lets every newton move the sled 0.66 mm" in complaint
        assert "see plumb reach" in complaint


def test_a_refused_grid_says_which_margin_will_do(run, machine):
    path = machine(effects=SOFT.effects | {"chain_sag": {"weight_ratio_squared": 3.3e-11}})
    code, _, complaint = run("grid", "--settings", path)
    assert code == 2 and "lets every newton move the sled" in complaint
    margin = int(re.search(r"raise --margin to (\d+);", complaint)[1])
    assert run("grid", "--settings", path, "--margin", margin)[0] == 0
    assert run("grid", "--settings", path, "--margin", margin - 10)[0] == 2
