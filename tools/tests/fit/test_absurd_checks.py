"""Measured numbers that no machine has are refused; what is odd but possible is taken."""

from dataclasses import replace

import pytest
from plumb.bench.causes import MAKER
from plumb.fit.expected import refuse_absurd
from plumb.fit.problem import Checked
from plumb.text.errors import InputError

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
