"""The hole to touch next: it settles what touches leave open, and no other hole does it better."""

from itertools import product

import numpy as np
import pytest
from plumb.bench.causes import MAKER
from plumb.job.home import HomeTouch
from plumb.job.slip import CANNOT_TELL, LINK, SHEET, SLIP, find_slip, next_hole
from plumb.model.predict import lengths, places
from slipped_machine import fitted_machine, touched

FIRST = (-900.0, 250.0)


def touch_of(hole, *, links=(0, 0), moved=(0.0, 0.0, 0.0)):
    """A touch without noise; moved: the sheet's x, y [mm] and rotation."""
    x, y, turn = moved
    sled = np.array([[hole[0] - turn * hole[1] + x, hole[1] + turn * hole[0] + y]])
    shown = places(MAKER, lengths(MAKER, sled)[0] - LINK * np.array(links))[0][0]
    return HomeTouch("1", tuple(hole), (float(shown[0]), float(shown[1])))


@pytest.mark.parametrize("links", [(1, 0), (0, -2), (-1, 2)])
@pytest.mark.parametrize("first", [FIRST, (900.0, -250.0), (0.0, 0.0)])
def test_the_next_hole_is_nearly_the_best(links, first):
    single = touch_of(first, links=links)
    finding = find_slip(MAKER, [single])
    assert finding.verdict == CANNOT_TELL

    def rest(hole):
        """The odds of the sheet after a touch that fits the likeliest account."""
        again = find_slip(MAKER, [single, touch_of(hole, links=finding.best.links)])
        return sum(each.odds for each in again.accounts if each.kind == SHEET)

    place = next_hole(MAKER, finding)
    assert np.hypot(*np.subtract(place, first)) > 400
    others = [rest(hole) for hole in product((-800.0, 0.0, 800.0), (-300.0, 0.0, 300.0))]
    assert np.log(rest(place)) < 0.7 * np.log(max(others))
    assert np.log(rest(place)) < 0.85 * np.log(min(others))


def test_the_worst_pair_of_slips_is_found_after_the_next_hole():
    pair, number = (3, -3), 1054  # its first two touches are the least lucky of 300
    settings = fitted_machine(number)[1]
    two = touched(number, links=pair, seed=[number, 41])
    finding = find_slip(settings, two)
    assert (finding.verdict, finding.best.links) == (CANNOT_TELL, pair)
    place = np.array([next_hole(settings, finding)])
    for seed in range(5):
        third = touched(number, links=pair, seed=seed, holes=place)
        settled = find_slip(settings, [*two, *third])
        assert (settled.verdict, settled.best.links) == (SLIP, pair)
