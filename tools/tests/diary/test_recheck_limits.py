"""Limits and sizes of a recheck, on a diary whose fit knew what a test says that it knew."""

import math

import numpy as np
import pytest
from plumb.bench.causes import MAKER
from plumb.diary.file import FIT, append
from plumb.diary.recheck import SHEET_Y, recheck
from plumb.job.home import HomeTouch
from plumb.settings.toml import machine_toml

AT = np.array([(-900.0, 250.0), (900.0, -250.0)])
SIGMA = 0.1  # [mm] of a coordinate
SURE_OF = {2: 9.210, 3: 11.345, 4: 13.277}  # chi-square, 99 %, by degrees of freedom


@pytest.fixture
def checked(tmp_path):
    def check(errors, *, known=None, sigma=SIGMA):
        """A recheck with these errors (n, 2) [mm]; known: sigmas of what the fit did not know."""
        names = list(known or {})
        covariance = np.diag([known[name] ** 2 for name in names]).tolist() if names else [[0.0]]
        entry = {
            "settings": machine_toml(MAKER),
            "unknowns": names or ["motor_gap"],
            "covariance": covariance,
        }
        fit = append(tmp_path, FIT, entry)
        touches = [
            HomeTouch(str(i), tuple(hole), tuple(at))
            for i, (hole, at) in enumerate(zip((AT + errors).tolist(), AT.tolist(), strict=True))
        ]
        return recheck(fit, MAKER, touches, sigma=sigma)

    return check


def expected(checked):
    return [mark.expected_mm for mark in checked.marks]


@pytest.mark.parametrize(("share", "holds"), [(0.99, True), (1.01, False)])
def test_marks_hold_up_to_the_99_percent_of_chi_square(checked, share, holds):
    size = SIGMA * math.sqrt(share * SURE_OF[4] / 4)
    assert checked(np.full((2, 2), size) * [[1, -1], [-1, 1]]).holds is holds


def test_a_mark_is_expected_as_far_off_as_touch_and_fit_allow(checked):
    plain = checked(np.zeros((2, 2)))
    assert expected(plain) == pytest.approx([SIGMA * math.sqrt(SURE_OF[2])] * 2, rel=1e-3)
    turned = checked(np.zeros((2, 2)), known={"sheet_rotation": 0.002})
    far = 0.002 * np.hypot(*AT[0])
    wide = math.sqrt(SURE_OF[2] * (SIGMA**2 + far**2))
    assert expected(turned) == pytest.approx([wide] * 2, rel=1e-3)


@pytest.mark.parametrize(("share", "explains"), [(0.99, True), (1.01, False)])
def test_a_change_explains_what_it_leaves_within_the_99_percent(checked, share, explains):
    # One of four numbers is spent on the change; what is left is across it.
    across = np.array([[1.0, 0.0], [-1.0, 0.0]]) * SIGMA * math.sqrt(share * SURE_OF[3] / 2)
    again = checked(np.array([[0.0, 3.0], [0.0, 3.0]]) + across)
    change = next(each for each in again.changes if each.name == SHEET_Y)
    assert change.explains is explains and change.size == pytest.approx(3.0)
    assert change.chi_square == pytest.approx(share * SURE_OF[3], rel=1e-3)
