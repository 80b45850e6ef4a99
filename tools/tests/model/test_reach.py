"""reach: which part of a sheet is usable, on the command line, in a grid and next to the tool."""

import re
import xml.etree.ElementTree as ElementTree
from dataclasses import replace

import numpy as np
import plumb.grid as grids
import pytest
from plumb.cli.reach import SIGNS, ReachAnswer, drawn_map
from plumb.cure.machine_file import SETTINGS
from plumb.grid import options
from plumb.model.predict import (
    CANNOT_HANG,
    REACH_LIMITS,
    TOO_SLACK,
    TOO_TIGHT,
    TOO_VERTICAL,
    USABLE,
    places,
    reach,
)
from plumb.model.predict import lengths as lengths_of
from plumb.model.reach import percent, survey_sheet, with_soft_chains
from plumb.settings.toml import write_machine_toml
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
    assert reach(SOFT, CORNERS, most_tension=150).verdict[3] == TOO_TIGHT
    assert reach(SOFT, [[0, 1100], [np.nan, 0], [1600, 0]]).verdict.tolist() == [CANNOT_HANG] * 3


def test_where_nothing_hangs_all_is_zero():
    answer = reach(SOFT, [[0, 1100]])
    assert not answer.tension.any() and not answer.compliance.any() and not answer.give.any()


def test_compliance_is_what_a_changed_load_does_to_the_sled():
    # A push straight down is a heavier sled: both chains held, the place follows from the model.
    more, point = 0.5, np.array([[700.0, -300.0]])
    chains, _ = lengths_of(SOFT, point)
    sag = SOFT.effect("chain_sag", "weight_ratio_squared")

    def pulled(push):
        weight = SOFT.sled_weight + push
        ratio = sag * (SOFT.sled_weight / weight) ** 2
        effects = {**SOFT.effects, "chain_sag": {"weight_ratio_squared": ratio}}
        return places(replace(SOFT, sled_weight=weight, effects=effects), chains)[0][0]

    moved = (pulled(more) - pulled(-more)) / (2 * more)
    assert reach(SOFT, point).compliance[0] @ [0, -1] == pytest.approx(moved, rel=0.02)


def test_compliance_is_symmetric_and_give_its_larger_root():
    answer = reach(TRUE, PLACES)
    xx, xy, yy = (answer.compliance[:, i, j] for i, j in ((0, 0), (0, 1), (1, 1)))
    assert (answer.compliance[:, 1, 0] == xy).all() and np.abs(xy).max() > 0.05
    assert answer.give**2 - answer.give * (xx + yy) + xx * yy - xy**2 == pytest.approx(0, abs=1e-12)
    assert (answer.give >= np.maximum(xx, yy)).all()


def test_straight_chains_without_weight_are_the_tools_within_5_percent():
    # What remains is the sprocket's radius, most where the chains are flat.
    tension = reach(replace(BELIEVED, chain_weight=0.0), PLACES).tension
    assert np.abs(straight() / tension - 1).max() < 0.05


def test_the_chains_own_weight_is_what_the_tool_leaves_out():
    ratio = straight() / reach(SOFT, PLACES).tension
    assert ratio.max() < 1.02
    assert ratio.min() > 0.94 and (ratio < 0.95).mean() < 0.01


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


def test_the_tools_limits_are_reachs():
    assert REACH_LIMITS["most_tension"] == options.MAX_TENSION
    assert REACH_LIMITS["least_tension"] == options.MIN_TENSION
    assert REACH_LIMITS["least_free"] == grids.MIN_FREE_CHAIN


def test_chains_that_no_setting_makes_soft_are_made_so():
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
    assert answer.slackest.place[1] == answer.softest.place[1] == pytest.approx(-609.6)
    assert abs(answer.softest.place[0]) == pytest.approx(1219.2)
    assert answer.tightest.value == pytest.approx(165.14, rel=0.01)  # published
    assert answer.slackest.value == pytest.approx(18.04, rel=0.015)
    far = {-1: "right", 1: "left"}[int(np.sign(answer.slackest.place[0]))]
    assert answer.slackest.side == far


def test_the_map_shows_the_sheet_as_it_hangs():
    survey = survey_sheet(replace(SOFT, motor_gap=2900.0, motor_height=909.6))
    lines = ReachAnswer(survey, None, []).map
    assert {len(line) for line in lines} == {77} and len(lines) == 20
    assert lines[0][38] == "T" and lines[-1][0] == lines[-1][-1] == "S"
    assert lines[10][38] == "." and set("".join(lines)) <= set(SIGNS)


def test_reach_begins_with_its_conclusion_and_tells_what_it_assumed(run):
    code, said, _ = run("reach", SETTINGS)
    assert code == 0 and said.splitlines()[0].startswith("99.7 % of the sheet is usable")
    assert "too slack" in said and "too tight" not in said
    assert "A usual chain is taken instead." in " ".join(said.split())
    assert max(map(len, said.splitlines())) <= 80
    assert "10 N move it 8.9 mm" in said


def test_a_machine_for_the_whole_sheet_is_good_news(run, machine):
    code, said, _ = run("reach", machine(motor_gap=3602.0))
    assert code == 0 and said.startswith("The whole sheet is usable.")
    assert "assumed" not in said


def test_no_place_at_all_is_an_answer_too(ask, machine):
    code, answer = ask("reach", machine(), "--most-tension", 30, "--least-tension", 29)
    assert code == 0 and answer["usable_share"] == 0
    code, answer = ask("reach", machine(motor_height=700.0), "--least-free", 5000)
    assert code == 0 and answer["shares"]["cannot_hang"] == 1
    assert answer["tightest"] is answer["slackest"] is answer["softest"] is None


def test_json_has_every_number(ask, machine):
    code, answer = ask("reach", machine(), "--most-give", 0.3)
    assert code == 0 and answer["limits"] == {**REACH_LIMITS, "most_give": 0.3}
    assert sum(answer["shares"].values()) == pytest.approx(1)
    assert answer["shares"]["too_vertical"] > 0.01 and answer["assumed"] == []
    assert answer["softest"]["give_mm_per_n"] == pytest.approx(0.89, abs=0.02)
    assert answer["tightest"]["tension_n"] > 160 > 20 > answer["slackest"]["tension_n"]


@pytest.mark.parametrize("form", ["png", "svg"])
def test_the_drawn_map_is_written(form, run, machine, tmp_path):
    path = tmp_path / f"map.{form}"
    code, _, _ = run("reach", machine(motor_gap=2900.0, motor_height=909.6), "-o", path)
    assert code == 0
    if form == "png":
        assert path.read_bytes().startswith(b"\x89PNG")
    else:
        assert ElementTree.parse(path).getroot().tag.endswith("svg")


def test_the_drawn_map_follows_the_limits():
    maps = [drawn_map(survey_sheet(SOFT, most_give=most)) for most in (0.3, 0.3, 0.4)]
    assert maps[0] == maps[1] != maps[2]


def test_a_map_of_nowhere_is_drawn_too(run, machine, tmp_path):
    path = tmp_path / "map.png"
    assert run("reach", machine(), "--least-free", 5000, "-o", path)[0] == 0
    assert path.read_bytes().startswith(b"\x89PNG")


@pytest.mark.parametrize(
    "words, hint",
    [
        (["--most-tension", "10"], "--least-tension 18 is not below"),
        (["--most-tension", "nan"], "--most-tension"),
        (["--most-give", "-1"], "--most-give"),
        (["-o", "map.txt"], "-o map.txt: end the name with"),
    ],
)
def test_limits_and_names_that_cannot_be_are_refused(words, hint, run):
    code, said, complaint = run("reach", SETTINGS, *words)
    assert (code, said) == (2, "")
    assert hint in complaint and complaint.count("\n") == 1


def test_the_settings_are_never_drawn_over(run, machine, tmp_path):
    path = machine()
    picture = path.rename(tmp_path / "machine.png")
    code, _, complaint = run("reach", picture, "-o", picture)
    assert code == 2 and "is read here" in complaint


def test_the_usual_grid_is_within_reach(run):
    assert run("grid")[0] == run("grid", "--settings", SETTINGS)[0] == 0


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


def test_a_refused_grid_leaves_no_file(run, tmp_path):
    code, _, _ = run("grid", "--places=-1219,-400", "--output", tmp_path / "grid.nc")
    assert code == 2 and list(tmp_path.iterdir()) == []


def test_what_the_tool_refuses_is_still_told_by_the_tool(run):
    code, _, complaint = run("grid", "--places=1219,-500")
    assert code == 2 and "less than 18: move that place" in complaint


def test_a_grid_goes_by_the_weight_in_its_settings(run, file):
    text = SETTINGS.read_text().replace(
        "[Advanced Settings]", "sledweight = 60\n[Advanced Settings]"
    )
    code, _, complaint = run("grid", "--settings", file("light.ini", text))
    assert code == 2 and "leaves 14" in complaint


def test_shares_that_are_nearly_nothing_do_not_look_it():
    assert percent(0.0) == "0.0 %" and percent(1.0) == "100.0 %"
    assert percent(0.0003) == "0.03 %" and percent(0.973) == "97.3 %"
