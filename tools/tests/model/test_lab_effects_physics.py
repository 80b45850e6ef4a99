"""Lab effects by their numbers: friction at places, readings of edges and tape, by hand."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.fit.observations import observe
from plumb.fit.sighting import SHEET_ROTATION, sighted
from plumb.marks.read import Distance, Mark, Measurements
from plumb.model.predict import values_of
from synthetic import BELIEVED

CHAINS = {
    "chain_sag": {"weight_ratio_squared": (0.00137293 / 97.9) ** 2 / 24},
    "chain_stretch": {"compliance": 5.17e-6},
}
MACHINE = replace(BELIEVED, effects=CHAINS)
CORNER = (1000.0, 500.0)
TWO = (Mark("corner", CORNER), Mark("middle", (0.0, 0.0)))


def seen(marks, distances=(), **outside):
    rows = observe(MACHINE, Measurements(marks, distances))
    return sighted(
        values_of(MACHINE),
        {name.replace("__", "."): value for name, value in outside.items()},
        rows,
        over_top=True,
        usual_weight=MACHINE.sled_weight,
        names=(),
    )


def lag(place, approach, drag=6.6):
    """The distance by which friction moves a mark [mm]."""
    marks = (Mark("one", place, approach=approach),)
    return (seen(marks, sled_friction__drag=drag).read.where - seen(marks).read.where)[0]


# Friction of 6.6 N, published, rounded to one or two digits: top centre 0.24 mm in y, right middle
# 0.8 and right bottom 2.5 mm in x, lower calibration mark (965, -356) 0.48 mm in x.
@pytest.mark.parametrize(
    ("place", "axis", "published", "slack"),
    [
        ((0, 550), 1, 0.24, 0.03),
        ((1150, 0), 0, 0.8, 0.05),
        ((1150, -550), 0, 2.5, 0.06),
        ((965, -356), 0, 0.48, 0.01),
        ((0, 0), 0, 0.05, 0.01),
    ],
)
def test_friction_holds_the_sled_back_as_far_as_published(place, axis, published, slack):
    ahead = [0.0, 0.0]
    ahead[axis] = 30.0
    back = [-part for part in ahead]
    assert lag(place, tuple(ahead))[axis] == pytest.approx(-published, abs=slack)
    assert lag(place, tuple(back))[axis] == pytest.approx(published, abs=slack)


def test_a_sideways_lag_in_a_lower_corner_drags_the_mark_up_or_down_too():
    # Coming from the middle it stays behind, and the slacker chain lets it stay higher.
    x, y = lag((1150, -550), (1.0, 0.0))
    assert x < 0 < y and abs(y) == pytest.approx(0.0733 * 6.6, rel=0.02)


def test_a_tape_that_reads_too_long_gives_larger_numbers():
    sighting = seen(TWO, (Distance(("corner", "middle"), 1.0),), tape_scale__strain=0.001)
    for places in (sighting.read, sighting.taped):
        assert places.where == pytest.approx(np.array([(1001.0, 500.5), (0, 0)]), abs=1e-4)


def test_a_skew_sheet_moves_the_top_right_in_readings_and_leaves_distances_alone():
    sighting = seen(TWO, (Distance(("corner", "middle"), 1.0),), sheet_skew__angle=0.002)
    assert sighting.read.where == pytest.approx(np.array([(1001.0, 500.0), (0, 0)]), abs=1e-4)
    assert sighting.taped.where == pytest.approx(np.array([CORNER, (0, 0)]), abs=1e-4)


def test_readings_from_the_edges_are_those_of_the_turned_sheet():
    # A quarter turn: what was to the right is up, and is read too far right.
    sighting = seen(TWO, sheet_skew__angle=0.01, **{SHEET_ROTATION: np.pi / 2})
    assert sighting.read.where[0] == pytest.approx([-500.0 + 10.0, 1000.0], abs=1e-3)
