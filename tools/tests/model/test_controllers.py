"""Chain lengths by the published formulas, against scalar derivations written here."""

import math
from dataclasses import replace

import numpy as np
import pytest
from plumb.model.predict import chain_lengths, clamped
from plumb.settings.machine import MachineSettings, PublishedSettings

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
