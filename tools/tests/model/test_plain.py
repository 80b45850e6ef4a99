"""Sizes in a maker's words, with no more figures than known; and the order of computed numbers."""

import math
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import plumb
import pytest
from plumb.model.catalogue import every_effect, parameter_words
from plumb.model.plain import TIE, ascending, greatest, least, noun_of, plain_before, plain_size
from plumb.model.predict import judged, with_parameters
from plumb.text.values import INCHES, MM
from synthetic import BELIEVED


@pytest.mark.parametrize(
    ("name", "numbers", "said"),
    [
        ("chain_pitch.left", (0.0024, 0.0021, 0.0027), "left chain 0.24 % too long (0.21 to 0.27)"),
        (
            "chain_pitch.right",
            (-0.0024, -0.0027, -0.0021),
            "right chain 0.24 % too short (0.21 to 0.27)",
        ),
        ("tape_scale.strain", (-0.0005,), "tape reads 0.0500 % too short"),
        ("motor_level.height_difference", (-4, -9, 1), "right motor 4 mm lower (-1 to 9)"),
        # The parameter is a square: 1600 mm^2 is 40 mm.
        (
            "chain_plane.gap_squared",
            (1600, 900, 2500),
            "sprockets and ring differ by 40 mm in their distance from the sheet (30 to 50)",
        ),
        # The square of the tangent of 15 degrees.
        ("frame_lean.tangent_squared", (0.0718,), "frame leans 15.0 degrees from the vertical"),
        ("chain_sag.weight_ratio_squared", (4.1e-12,), "chains sag 0.500 times the usual amount"),
        (
            "chain_stretch.compliance",
            (5e-6, 4e-6, 6e-6),
            "chains 0.50 mm longer for each metre at 100 N (0.40 to 0.60)",
        ),
        ("sheet_skew.angle", (-0.001,), "sheet edges -1.00 mm out of square for each metre"),
        ("sheet_rotation", (0.001,), "sheet turned by 1.00 mm for each metre"),
        (
            "motor_gap",
            (2978.27, 2977.2, 2979.3),
            "gap between the motors 2978.3 mm (2977.2 to 2979.3)",
        ),
        ("residual_patch.left_x", (0.5,), "residual_patch.left_x 0.500 mm"),
    ],
)
def test_sizes_are_in_a_makers_words(name, numbers, said):
    assert plain_size(name, *numbers, unit=MM) == said


@pytest.mark.parametrize(
    "name", [f"{e['name']}.{p['name']}" for e in every_effect() for p in e["parameters"]]
)
def test_every_parameter_has_plain_words_and_its_size_can_be_read_back(name):
    words = parameter_words()[name]["plain"]
    assert words and words["more"].count("#") == 1 and words["less"].count("#") <= 1
    assert words["more"] != words["less"]
    said = plain_size(name, parameter_words()[name]["typical"], unit=MM)
    shown = float(said.partition(f" {words['unit']}")[0].split()[-1])
    by_angle = math.tan(math.radians(shown)) ** 2
    back = {"as is": shown, "root": shown**2, "angle": by_angle}[words["shown"]]
    assert back / words["times"] == pytest.approx(parameter_words()[name]["typical"], rel=0.01)


def test_every_effect_has_a_noun():
    for effect in every_effect():
        assert noun_of(effect["name"]) == effect["noun"] != effect["name"]
    assert noun_of("mount_give") == "mount_give"


@pytest.mark.parametrize(
    ("unit", "now", "before"),
    [(MM, "2980.2 mm", "2978.4 mm"), (INCHES, "117.330 inch", "117.260 inch")],
)
def test_a_size_before_is_as_fine_as_the_size_now(unit, now, before):
    interval = (2979.8, 2980.6)
    assert f"motors {now} (" in plain_size("motor_gap", 2980.18, *interval, unit=unit)
    assert plain_before("motor_gap", 2978.4, *interval, unit=unit) == before


@pytest.mark.parametrize("feed", ["top", "bottom"])
@pytest.mark.parametrize(("side", "inwards"), [("left", 1), ("right", -1)])
@pytest.mark.parametrize("size", [0.1, -0.1])
@pytest.mark.parametrize("wave", ["sine", "cosine"])
def test_the_high_spot_of_a_sprocket_is_where_the_judge_has_its_middle(
    feed, side, inwards, size, wave
):
    name = f"sprocket_runout.{side}_{wave}"
    numbers = judged(with_parameters(replace(BELIEVED, feed=feed), {name: size}))
    x, y = (numbers[f"{side}.eccentric_{axis}"] for axis in "xy")
    clockwise = inwards if feed == "top" else -inwards  # as chain is paid out
    if wave == "sine":
        said = "high spot up" if y > 0 else "high spot down"
    else:  # a clockwise turn lifts what is left of the axis
        said = "that rises" if x * clockwise < 0 else "that sinks"
    assert max(abs(x), abs(y)) == pytest.approx(0.1)
    assert plain_size(name, size, unit=MM).endswith(said)
    assert plain_size(name, size, unit=MM).startswith(f"{side} sprocket 0.100 mm off its middle")


def rounded_otherwise(numbers, seed):
    """The numbers as another processor may round them."""
    return numbers * (1 + 1e-12 * np.random.default_rng(seed).standard_normal(len(numbers)))


@pytest.mark.parametrize("seed", range(5))
def test_rounding_changes_no_order(seed):
    numbers = np.array([5.0, 3.0, 5.0, -2000.0, 3.0, 1e-15, 0.0, -1e-14, np.inf, 3.0])
    assert ascending(rounded_otherwise(numbers, seed)).tolist() == [3, 5, 6, 7, 1, 4, 9, 0, 2, 8]
    assert least(rounded_otherwise(numbers[:3], seed)) == 1
    assert greatest(rounded_otherwise(numbers[:3], seed)) == 0


def test_values_that_differ_are_in_order():
    assert ascending([2.0 + 2 * TIE, 2.0 - 2 * TIE, 2.0]).tolist() == [1, 2, 0]
    assert ascending([1e6, 1e6 - 1, 1e6 - 0.05]).tolist() == [1, 0, 2]  # a share of large numbers
    assert ascending([0.0, -0.5 * TIE, -5 * TIE]).tolist() == [2, 0, 1]
    assert ascending([np.inf, 1e300, -np.inf, np.inf]).tolist() == [2, 1, 0, 3]
    assert ascending([]).tolist() == []


def test_nothing_that_users_get_is_ranked_by_the_last_bit():
    """These alone may: they rank yes and no, whole numbers, or places that nobody is shown."""
    allowed = {
        "model/plain.py",
        "diagnosis/every_machine.py",
        "diagnosis/evidence.py",  # the order in which signs are conditioned on, which is not shown
        "job/check.py",
        "job/fixes.py",  # the first of yes and no
        "job/wood.py",  # the first of yes and no
    }
    root, ranks = Path(plumb.__file__).parent, re.compile(r"arg(?:min|max|sort)\(")
    users = [path for path in root.rglob("*.py") if path.parent.name != "vm"]
    ranking = [
        path.relative_to(root).as_posix() for path in users if ranks.search(path.read_text())
    ]
    assert {*ranking} <= allowed and "model/plain.py" in ranking
