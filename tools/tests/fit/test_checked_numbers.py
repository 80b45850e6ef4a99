"""Numbers that were measured directly or are held: what they do to a fit; absurd ones."""

from dataclasses import replace

import pytest
from plumb.bench.boards import MAKER
from plumb.fit.expected import refuse_absurd
from plumb.fit.fit import PRIORS, Checked, fit
from plumb.fit.observations import observe
from plumb.marks.read import Measurements
from plumb.text.errors import InputError
from synthetic import BELIEVED, TRUE, grid, marks_on

ROWS = observe(BELIEVED, Measurements(marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.3)))


def fitted(**how):
    return fit(BELIEVED, ROWS, sigma=0.3, **how)


def estimate(of_fit, name):
    (only,) = [each for each in of_fit.estimates if each.name == name]
    return only


def test_a_sharp_check_holds_its_number():
    check = Checked("motor_gap", 2985.0, 0.001)
    gap = estimate(fitted(checked=[check]), "motor_gap")
    assert gap.value == pytest.approx(2985.0, abs=0.01)
    assert gap.high - gap.low == pytest.approx(2 * 1.96 * 0.001, rel=0.01)
    # A blunt check says nothing.
    blunt = estimate(fitted(checked=[replace(check, sigma=1e4)]), "motor_gap")
    assert blunt.value == pytest.approx(estimate(fitted(), "motor_gap").value, abs=1e-3)


@pytest.mark.parametrize("side", [-1, 1])
def test_a_check_pulls_from_either_side(side):
    free = estimate(fitted(effects=["chain_pitch"]), "chain_pitch.left").value
    check = Checked("chain_pitch.left", free + side * 0.001, 0.0002)
    pulled = estimate(fitted(effects=["chain_pitch"], checked=[check]), check.name).value
    assert 0 < side * (pulled - free) < 0.001


def test_checks_of_what_is_not_fitted_do_not_count():
    checks = [Checked("chain_pitch.left", 0.005, 1e-5), Checked("motor_gap", 2990.0, 0.01)]
    priors = {**PRIORS, "motor_gap": 0.0}
    with_checks, without = (fitted(priors=priors, checked=each) for each in (checks, ()))
    assert with_checks.settings == without.settings
    assert with_checks.settings.motor_gap == BELIEVED.motor_gap
    held = {"chain_pitch.left": 0.001}
    one_held = fitted(effects=["chain_pitch"], checked=checks[:1], held=held)
    assert one_held.settings.effect("chain_pitch", "left") == 0.001
    assert "chain_pitch.left" not in [each.name for each in one_held.estimates]
    assert "chain_pitch.right" in [each.name for each in one_held.estimates]


def test_sizes_without_a_setting_can_be_held_too():
    free = fitted(effects=["tape_scale"])
    held = fitted(held={"tape_scale.strain": 0.002})
    assert held.lab_effects == {"tape_scale": {"strain": 0.002}}
    assert free.lab_effects.keys() == {"tape_scale"}
    assert held.rms != pytest.approx(fitted().rms, rel=0.05)


def test_a_search_from_another_fit_finds_the_same_minimum():
    moved = observe(BELIEVED, Measurements(marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.3, seed=9)))
    elsewhere = fit(BELIEVED, moved, sigma=0.3)
    cold = fitted(effects=["chain_pitch"])
    warm = fitted(effects=["chain_pitch"], near=elsewhere)
    for known, again in zip(cold.estimates, warm.estimates, strict=True):
        assert again.value == pytest.approx(known.value, abs=1e-3 * (known.high - known.low))
    # Where the sled of the other fit cannot hang, the search begins as ever.
    gone = tuple(replace(each, value=1e5) for each in elsewhere.estimates)
    lost = fitted(effects=["chain_pitch"], near=replace(elsewhere, estimates=gone))
    assert lost.settings.motor_gap == pytest.approx(cold.settings.motor_gap, abs=1e-4)


MACHINE = replace(MAKER, motor_gap=3000.0, motor_center_x=0.0, sled_weight=110.0)
POSSIBLE = [
    ("tape_scale.strain", 0.0089, 1e-5),
    ("tape_scale.strain", -0.0089, 1e-5),
    ("tape_scale.strain", 0.1, 0.05),  # says hardly anything
    ("frame_flex.inward", -0.01, 0.001),  # noise
    ("motor_gap", 3290.0, 1.0),
    ("motor_gap", 2710.0, 1.0),
    ("motor_gap", 3500.0, 100.0),
    ("motor_center_x", -190.0, 1.0),
    ("sled_weight", 38.0, 1.0),  # of 110 N
    ("sled_weight", 255.0, 1.0),
    ("sled_weight", 9.8, 14.0),
]
ABSURD = [
    ("tape_scale.strain", 0.0091, 1e-5),
    ("tape_scale.strain", -0.0091, 1e-5),
    ("tape_scale.strain", 0.1, 0.045),
    ("motor_gap", 3310.0, 1.0),
    ("motor_gap", 2690.0, 1.0),
    ("motor_gap", 3500.0, 95.0),
    ("motor_center_x", -210.0, 1.0),
    ("sled_weight", 9.8, 2.0),  # a kilogram
    ("sled_weight", 32.0, 1.0),
    ("sled_weight", 265.0, 1.0),
]


@pytest.mark.parametrize("check", POSSIBLE)
def test_odd_but_possible_values_are_accepted(check):
    refuse_absurd([Checked(*check)], MACHINE)


@pytest.mark.parametrize("check", ABSURD)
def test_values_that_no_machine_has_are_refused(check):
    with pytest.raises(InputError, match=f"--checked {check[0]}="):
        refuse_absurd([Checked(*POSSIBLE[0]), Checked(*check)], MACHINE)
