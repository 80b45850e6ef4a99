"""Ranges of sizes: their ends, how far beyond them is still near, and what the catalogue says."""

import numpy as np
import pytest
from plumb.fit.expected import PlausibleRange, plausible_range


def test_a_range_holds_its_ends_and_is_near_half_as_far_again():
    strain = PlausibleRange(-0.001, 0.006)
    assert strain.holds(-0.001) and strain.holds(0.006)
    assert not strain.holds(-0.0011) and not strain.holds(0.0061)
    assert strain.is_near(0.0089, 0.02) and not strain.is_near(0.0091, 0.02)
    assert strain.is_near(-0.1, -0.0014) and not strain.is_near(-0.1, -0.0016)


def test_a_range_without_zero_widens_away_from_itself():
    gap = PlausibleRange(1000.0, 6000.0)
    assert gap.is_near(0.0, 700.0) and not gap.is_near(0.0, 600.0)
    assert gap.is_near(8900.0, 9900.0) and not gap.is_near(9100.0, 9900.0)
    below = PlausibleRange(-6000.0, -1000.0)
    assert below.is_near(-700.0, 0.0) and not below.is_near(-600.0, 0.0)


@pytest.mark.parametrize("unit", [1e-3, 1.0, 1e3])
def test_a_range_widens_by_its_share_whatever_the_unit(unit):
    above, below = PlausibleRange(0.4 * unit, unit), PlausibleRange(-unit, -0.4 * unit)
    for low, high, is_near in ((0.1, 0.26, False), (0.1, 0.28, True), (1.49, 2, True)):
        assert above.is_near(low * unit, high * unit) == is_near
        assert below.is_near(-high * unit, -low * unit) == is_near


def test_many_intervals_are_judged_at_once():
    near = PlausibleRange(-1.0, 2.0).is_near(np.array([-9.0, 0.0, 3.1]), np.array([-1.6, 1.0, 4.0]))
    assert near.tolist() == [False, True, False]


def test_an_end_that_is_not_known_is_none():
    assert PlausibleRange(-1.0, 2.0).limits == (-1.0, 2.0)
    assert PlausibleRange(low=-1.0).limits == (-1.0, None)
    assert PlausibleRange().limits == (None, None) and PlausibleRange().holds(-1e9)


def test_ranges_are_those_of_the_catalogue_and_endless_where_it_says_nothing():
    assert plausible_range("chain_pitch.left") == PlausibleRange(-0.001, 0.006)
    assert plausible_range("motor_gap") == PlausibleRange(1000.0, 6000.0)
    assert plausible_range("zero2.left").holds(1e9)
