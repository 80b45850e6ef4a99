"""Ranges of sizes: their ends, how far beyond them is still near, and what the catalogue says."""

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


def test_ranges_are_those_of_the_catalogue_and_endless_where_it_says_nothing():
    assert plausible_range("chain_pitch.left") == PlausibleRange(-0.001, 0.006)
    assert plausible_range("motor_gap") == PlausibleRange(1000.0, 6000.0)
    assert plausible_range("zero2.left").holds(1e9)
