"""The hole to touch next: it settles what touches leave open, and no other hole does it better."""

from itertools import product

import numpy as np
import pytest
from plumb.bench.causes import MAKER
from plumb.bench.slipped_chains import MISHAPS, fitted_machine, touched
from plumb.job.home import Touch
from plumb.job.slip import CANNOT_TELL, LINK, SHEET, SLIP, find_slip, next_hole
from plumb.model.predict import lengths, places

FIRST = (-900.0, 250.0)


def touch_of(hole, *, links=(0, 0), moved=(0.0, 0.0, 0.0)):
    """A touch without noise; moved: the sheet's x, y [mm] and rotation."""
    x, y, turn = moved
    sled = np.array([[hole[0] - turn * hole[1] + x, hole[1] + turn * hole[0] + y]])
    shown = places(MAKER, lengths(MAKER, sled)[0] - LINK * np.array(links))[0][0]
    return Touch("1", tuple(hole), (float(shown[0]), float(shown[1])))


@pytest.mark.parametrize("links", [(1, 0), (0, -2), (-1, 2)])
@pytest.mark.parametrize("first", [FIRST, (900.0, -250.0), (0.0, 0.0)])
def test_no_other_hole_is_much_better(links, first):
    single = touch_of(first, links=links)
    finding = find_slip(MAKER, [single])
    assert finding.verdict == CANNOT_TELL

    def rest(hole):
        """What remains of the odds of the sheet, after a touch as the likeliest account has it."""
        again = find_slip(MAKER, [single, touch_of(hole, links=finding.best.links)])
        return sum(each.odds for each in again.accounts if each.kind == SHEET)

    place = next_hole(MAKER, finding)
    assert np.hypot(*np.subtract(place, first)) > 400
    others = [rest(hole) for hole in product((-800.0, 0.0, 800.0), (-300.0, 0.0, 300.0))]
    assert np.log(rest(place)) < 0.7 * np.log(max(others))
    assert np.log(rest(place)) < 0.85 * np.log(min(others))


def test_the_worst_pair_of_slips_is_named_after_it():
    mishap = next(each for each in MISHAPS if each.links == (3, -3))
    machine = fitted_machine(1054)  # its first two touches are the least lucky of 300
    two = touched(machine, mishap, np.random.default_rng([1054, 41]))
    finding = find_slip(machine.settings, two)
    assert (finding.verdict, finding.best.links) == (CANNOT_TELL, (3, -3))
    place = next_hole(machine.settings, finding)
    for seed in range(5):
        source = np.random.default_rng(seed)
        (third,) = touched(machine, mishap, source, marks=np.array([place]))
        settled = find_slip(machine.settings, [*two, third])
        assert (settled.verdict, settled.best.links) == (SLIP, (3, -3))
