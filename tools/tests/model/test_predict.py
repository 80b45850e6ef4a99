"""The lab's door to the core: chains, slopes, give and reach; chains by the published formulas."""

import math
import re
from dataclasses import replace

import numpy as np
import plumb.grid as grids
import pytest
from plumb.fit.observations import chains_to, loaded, observe, visited
from plumb.grid import MAX_TENSION, MIN_TENSION
from plumb.marks.read import Measurements
from plumb.model.predict import (
    CANNOT_HANG,
    NAMES,
    REACH_LIMITS,
    TOO_SLACK,
    TOO_TIGHT,
    TOO_VERTICAL,
    USABLE,
    believed_lengths,
    chain_lengths,
    clamped,
    known_effects,
    lengths,
    reach,
    values_of,
)
from plumb.model.reach import survey_sheet, with_soft_chains
from plumb.plan.preview import SIGNS, SheetReach
from plumb.settings import MachineSettings, PublishedSettings, write_machine_toml
from published_marks import SETTINGS
from synthetic import BELIEVED, SHEET, TRUE, grid, marks_on


def test_every_parameter_of_the_library_has_its_place_among_the_values():
    names = {f"{effect}.{name}" for effect, several in known_effects().items() for name in several}
    assert names == {name for name in NAMES if "." in name}


def test_the_stock_controller_believes_its_own_formula_and_plumb_ours():
    published = PublishedSettings(chain_sag_correction=8.2)
    stock = replace(BELIEVED, controller="stock", published=published)
    target = np.array([[1000.0, -400.0]])
    ours = believed_lengths(stock, target, controller="plumb")
    # Our model of these settings has their sag, though it is written in published units.
    assert ours == pytest.approx(lengths(stock.as_plumb_model(), target)[0])
    assert ours != pytest.approx(lengths(BELIEVED, target)[0], abs=0.5)
    assert believed_lengths(stock, target) != pytest.approx(ours, abs=1e-3)


def test_a_heavier_sled_stretches_more_and_sags_less():
    values, factors = loaded(values_of(TRUE), 2 * TRUE.sled_weight, TRUE.sled_weight)
    sag = NAMES.index("chain_sag.weight_ratio_squared")
    assert values[sag] == pytest.approx(8.2e-12 / 4)
    assert factors[sag] == pytest.approx(1 / 4)
    assert values[NAMES.index("sled_weight")] == 2 * TRUE.sled_weight
    assert factors[NAMES.index("sled_weight")] == 0


def test_each_visit_has_its_own_sled():
    light = marks_on(TRUE, BELIEVED, grid(3, 2))
    heavy = marks_on(TRUE, BELIEVED, grid(3, 2), sled_weight=150.0, prefix="heavy ")
    rows = observe(BELIEVED, Measurements(light + heavy))
    where, slopes, _ = visited(values_of(TRUE), rows, over_top=True, usual_weight=TRUE.sled_weight)
    assert where == pytest.approx(rows.measured, abs=5e-5)
    assert np.abs(where[:6] - where[6:]).max() > 0.3
    weight = NAMES.index("sled_weight")
    assert slopes[:6, :, weight].any() and not slopes[6:, :, weight].any()
    chains, _ = chains_to(TRUE, where, rows.sled_weights)
    assert chains == pytest.approx(rows.chains, abs=5e-5)


RADIUS = 63.5 / (2 * math.pi)
OWNER = MachineSettings(  # the machine of the published sag figures
    motor_gap=3602.6,
    motor_height=609.6 + 468.4,
    rotation_radius=139.1,
    sheet_width=2438.4,
    sheet_height=1219.2,
    feed="top",
    controller="stock",
)
POINTS = [(0.0, 0.0), (965.2, -355.6), (-1100.0, 550.0), (1219.2, -609.6), (-17.0, 609.6)]


def tangent(motor_x, motor_y, x, y, over):
    """Tangent point and wrapped angle by vectors: no arc sine of a sum, no shared formula."""
    inwards = math.copysign(1.0, -motor_x)
    gap_x, gap_y = (x - motor_x) * inwards, motor_y - y  # both positive on the sheet
    distance = math.hypot(gap_x, gap_y)
    # The tangent point seen from the axis makes the angle acos(r / d) with the line to the bit.
    line = math.atan2(-gap_y, gap_x)
    turn = math.acos(RADIUS / distance)
    spoke = line + turn if over else line - turn  # counted from the inward horizontal
    point = (motor_x + inwards * RADIUS * math.cos(spoke), motor_y + RADIUS * math.sin(spoke))
    # From 12 o'clock, inwards over the top or outwards and round to the tangent point.
    return point, math.pi / 2 - spoke if over else spoke + 3 / 2 * math.pi


def parts_of(settings, x, y):
    """Of each chain: the wrapped part, and how far the straight part goes across and down."""
    for motor_x in (-settings.motor_gap / 2, settings.motor_gap / 2):
        over = settings.feed == "top"
        (at_x, at_y), wrapped = tangent(motor_x, settings.motor_height, x, y, over)
        yield wrapped, abs(x - at_x), at_y - y


def stock_by_hand(settings, x, y):
    published, lines = settings.published, [*parts_of(settings, x, y)]
    lengths = []
    tolerances = (published.left_tolerance, published.right_tolerance)
    for (wrapped, across, drop), other, tolerance in zip(
        lines, (lines[1], lines[0]), tolerances, strict=True
    ):
        straight = math.hypot(across, drop)
        cosine, sine = across / straight, drop / straight
        slope = other[2] / other[1]
        share = published.chain_sag_correction / 1e12 * cosine**2 * straight**2
        share *= (slope * cosine + sine) ** 2
        paid = straight * (1 + share) / (1 + tolerance / 100)
        lengths.append(RADIUS * wrapped + paid - settings.rotation_radius)
    return lengths


@pytest.mark.parametrize("feed", ["top", "bottom"])
@pytest.mark.parametrize("published", [PublishedSettings(), PublishedSettings(27.4, 0.348, -0.08)])
def test_stock_agrees_with_a_derivation_by_vectors(feed, published):
    settings = replace(OWNER, feed=feed, published=published)
    lengths = chain_lengths(settings, POINTS)
    for row, (x, y) in zip(lengths, POINTS, strict=True):
        # The published 3.14159 makes the wrap under the sprocket 0.00003 mm shorter.
        assert row == pytest.approx(stock_by_hand(settings, x, y), abs=4e-5)


@pytest.mark.parametrize(("gap", "added"), [(3602.6, 2.616), (3000.0, 3.884)])
def test_published_sag_figures(gap, added):
    """An owner's printed 2.6 and 3.8 mm: correction 27.4, far chain at the lower mark."""
    plain = replace(OWNER, motor_gap=gap)
    sagging = replace(plain, published=PublishedSettings(27.4))
    mark = [(965.2, -355.6)]
    difference = chain_lengths(sagging, mark) - chain_lengths(plain, mark)
    assert difference[0, 0] == pytest.approx(added, abs=0.001)


HOLEY = replace(
    OWNER,
    controller="holey",
    published=PublishedSettings(33.0, 0.1, 0.25, chain_elasticity=8.1e-6, holey_sled_weight=113.68),
)


def holey_by_hand(settings, x, y):
    published, lines = settings.published, [*parts_of(settings, x, y)]
    density = 0.001372
    weight = published.holey_sled_weight + density / 2 * sum(
        math.hypot(*line[1:]) for line in lines
    )
    # Equal horizontal pulls H; H (drop/across left + drop/across right) carries the weight.
    horizontal = weight / sum(drop / across for _, across, drop in lines)
    lengths = []
    tolerances = (published.left_tolerance, published.right_tolerance)
    for (wrapped, across, drop), tolerance in zip(lines, tolerances, strict=True):
        tension = horizontal * math.hypot(across, drop) / across
        # The curve y = a cosh(x / a) through both ends: find where it starts, then its length
        # a sinh(x / a) between the ends; no square root of squares as in the formula under test.
        a = horizontal / density
        middle = a * math.asinh(drop / (2 * a * math.sinh(across / (2 * a))))
        first = (middle - across / 2) / a
        length = a * (math.sinh(first + across / a) - math.sinh(first))
        length /= (1 + tolerance / 100) * (1 + tension * published.chain_elasticity)
        lengths.append(RADIUS * wrapped + length - settings.rotation_radius)
    return lengths


@pytest.mark.parametrize("feed", ["top", "bottom"])
def test_holey_agrees_with_a_catenary_by_its_equation(feed):
    settings = replace(HOLEY, feed=feed)
    lengths = chain_lengths(settings, POINTS)
    for row, (x, y) in zip(lengths, POINTS, strict=True):
        assert row == pytest.approx(holey_by_hand(settings, x, y), abs=5e-5)


@pytest.mark.parametrize("weight", [0.0, -1.0])
def test_holey_without_a_sled_weight_is_stock(weight):
    published = replace(HOLEY.published, holey_sled_weight=weight, chain_elasticity=None)
    off = replace(HOLEY, published=published)
    stock = chain_lengths(off, POINTS, controller="stock")
    assert np.array_equal(chain_lengths(off, POINTS), stock)


def test_targets_off_the_sheet_are_moved_to_its_edge():
    outside, edge = [(1300.0, -700.0), (-5000.0, 9.0)], [(1219.2, -609.6), (-1219.2, 9.0)]
    assert np.array_equal(clamped(OWNER, np.array(outside)), edge)
    for settings in (OWNER, HOLEY):
        assert np.array_equal(chain_lengths(settings, outside), chain_lengths(settings, edge))


def test_our_own_kinematics_is_not_a_published_one():
    with pytest.raises(ValueError, match="stock, holey"):
        chain_lengths(OWNER, POINTS, controller="plumb")


SOFT, _ = with_soft_chains(BELIEVED)
PLACES = np.stack(
    np.meshgrid(np.linspace(-1219.2, 1219.2, 61), np.linspace(609.6, -609.6, 31)), axis=-1
).reshape(-1, 2)


def test_every_verdict_has_its_place():
    corners = [(1150.0, -550.0), (1219.2, -609.6), (1200.0, -600.0), (0.0, 609.6)]
    verdict = reach(SOFT, corners).verdict
    assert verdict.tolist() == [USABLE, TOO_SLACK, TOO_VERTICAL, USABLE]
    heavy = replace(SOFT, sled_weight=1.5 * SOFT.sled_weight)
    assert reach(heavy, corners).verdict[3] == TOO_TIGHT
    assert reach(SOFT, [[0, 1100], [np.nan, 0], [1600, 0]]).verdict.tolist() == [CANNOT_HANG] * 3


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
    assert REACH_LIMITS["most_tension"] == MAX_TENSION
    assert REACH_LIMITS["least_tension"] == MIN_TENSION
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
