"""Tests of the sheet's rotation: what a fit says of it, and when it is proved."""

import pytest
from plumb.fit.fit import fit
from plumb.fit.observations import model_and_observations
from plumb.fit.problem import PRIORS
from plumb.fit.sighting import SHEET_ROTATION
from plumb.marks.read import Measurements, Round, join_measurements
from synthetic import BELIEVED, grid, marks_on

SIGMA = 0.5


def sheet(turn, name, **how):
    """A file of marks with hardly any noise, read on a sheet that is turned [rad]."""
    seed = ord(name)
    marks = marks_on(BELIEVED, BELIEVED, grid(3, 3), rotation=turn, noise=1e-4, seed=seed)
    return Measurements(marks, source=f"{name}.toml", rounds=(Round(**how),))


def fit_of(*parts):
    _, rows = model_and_observations(BELIEVED, join_measurements(parts))
    return fit(BELIEVED, rows, sigma=SIGMA)


def two_sheets(first, last):
    return fit_of(sheet(first, "a"), sheet(last, "b", new_sheet=True))


def test_of_two_sheets_the_last_counts():
    turned = two_sheets(0.004, -0.003)
    assert turned.sheet_rotation == pytest.approx(0.004, rel=0.01)
    assert turned.last_sheet_rotation == pytest.approx(-0.003, rel=0.01)
    assert turned.proves_sheet_rotation and turned.shows_sheet_rotation
    assert not two_sheets(0.004, 0.0).proves_sheet_rotation
    assert two_sheets(0.0, 0.004).proves_sheet_rotation


def test_where_the_first_sheet_is_held_the_last_is_judged_by_itself():
    for turn, is_proved in ((0.004, True), (0.0, False)):
        parts = sheet(0.0, "a"), sheet(turn, "b", new_sheet=True)
        _, rows = model_and_observations(BELIEVED, join_measurements(parts))
        fitted = fit(BELIEVED, rows, priors={**PRIORS, SHEET_ROTATION: 0.0}, sigma=SIGMA)
        assert fitted.last_sheet_rotation == pytest.approx(turn, abs=1e-5)
        assert fitted.proves_sheet_rotation == is_proved
