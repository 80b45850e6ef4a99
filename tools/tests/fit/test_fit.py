"""fit: it finds what was hidden, is honest about what it does not know, and of the sheet's turn."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.fit.fit import PRIORS, Problem, fit
from plumb.fit.observations import SHEET_ROTATION, model_and_observations, observe
from plumb.marks.read import Measurements, Round, join_measurements
from synthetic import BELIEVED, EFFECTS, TRUE, distances_between, grid, marks_on

WIDE = {**PRIORS, "motor_gap": 1e4, "motor_height": 1e4, "motor_center_x": 1e4}
WIDE[SHEET_ROTATION] = 10.0


def fitted_to(measurements: Measurements, effects, **how):
    return fit(BELIEVED, observe(BELIEVED, measurements), effects=effects, **how)


def without(measurements: Measurements, name: str) -> Measurements:
    return replace(
        measurements, marks=tuple(mark for mark in measurements.marks if mark.name != name)
    )


def test_hidden_parameters_are_found_again():
    board = Measurements(marks_on(TRUE, BELIEVED, grid(7, 5), rotation=0.002))
    fitted = fitted_to(board, EFFECTS, priors=WIDE)
    assert fitted.settled and fitted.rms < 1e-5
    for effect, parameters in EFFECTS.items():
        for name, value in parameters.items():
            assert fitted.settings.effect(effect, name) == pytest.approx(value, rel=1e-3)
    assert fitted.settings.motor_gap == pytest.approx(TRUE.motor_gap, abs=0.01)
    assert fitted.settings.motor_center_x == pytest.approx(TRUE.motor_center_x, abs=0.01)
    assert fitted.sheet_rotation == pytest.approx(0.002, abs=1e-6)


def test_two_sleds_tell_stretch_from_everything_that_looks_like_it():
    light = marks_on(TRUE, BELIEVED, grid(5, 3))
    heavy = marks_on(TRUE, BELIEVED, grid(5, 3), sled_weight=150.0, prefix="heavy ")
    widths = []
    for marks in (light, light + heavy):
        fitted = fitted_to(Measurements(marks), EFFECTS, priors=WIDE, sigma=0.5)
        assert fitted.rms < 1e-4
        (stretch,) = [each for each in fitted.estimates if each.name == "chain_stretch.compliance"]
        assert stretch.low < 5.2e-6 < stretch.high
        widths.append(stretch.high - stretch.low)
    assert widths[1] < 0.6 * widths[0]


def test_marks_and_distances_are_fitted_together():
    marks = marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.2)
    spans = distances_between(marks_on(TRUE, BELIEVED, grid(5, 3))).distances
    both, alone = (
        fitted_to(Measurements(marks, taped), ["chain_pitch"], sigma=0.2) for taped in (spans, ())
    )
    assert len(both.distance_errors) == len(spans)
    assert both.estimates[-1].high - both.estimates[-1].low < (
        alone.estimates[-1].high - alone.estimates[-1].low
    )


def test_the_left_out_error_is_that_of_a_fit_without_the_mark():
    board = Measurements(marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.5))
    whole = fitted_to(board, ["chain_pitch", "chain_sag"], sigma=0.5)
    rows = observe(BELIEVED, board)
    for i, name in enumerate(rows.names):
        part = fitted_to(without(board, name), ["chain_pitch", "chain_sag"], sigma=0.5)
        left = measured_minus_predicted(part, board, i)
        assert whole.left_out_errors[i] == pytest.approx(left, abs=0.01)
        assert np.hypot(*left) > np.hypot(*whole.errors[i])


def test_repeats_of_a_mark_are_left_out_together():
    once = marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.5)
    again = marks_on(TRUE, BELIEVED, grid(4, 3)[:2], noise=0.5, seed=2)
    board = Measurements(once + again)
    whole = fitted_to(board, ["chain_pitch"], sigma=0.5)
    part = fitted_to(without(board, "0"), ["chain_pitch"], sigma=0.5)
    for i in (0, len(once)):
        left = measured_minus_predicted(part, board, i)
        assert whole.left_out_errors[i] == pytest.approx(left, abs=0.01)


def measured_minus_predicted(fitted, board: Measurements, i: int) -> np.ndarray:
    """The error of one mark against a fit that did not see it: fitted again with no freedom."""
    held = dict.fromkeys(PRIORS, 0.0) | {SHEET_ROTATION: 0.0}
    rows = observe(BELIEVED, board)
    fixed = fit(fitted.settings, rows, priors=held, sigma=0.5)
    where = rows.measured - fixed.errors
    cosine, sine = np.cos(fitted.sheet_rotation), np.sin(fitted.sheet_rotation)
    return rows.measured[i] - where[i] @ np.array([[cosine, sine], [-sine, cosine]])


def test_intervals_hold_the_truth_about_as_often_as_stated():
    inside = []
    for seed in range(40):
        marks = marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.5, seed=seed)
        fitted = fitted_to(Measurements(marks), EFFECTS)
        truth = {f"chain_pitch.{side}": EFFECTS["chain_pitch"][side] for side in ("left", "right")}
        inside += [e.low < truth[e.name] < e.high for e in fitted.estimates if e.name in truth]
    assert 0.86 < np.mean(inside) <= 1.0


def test_a_wider_prior_does_not_narrow_an_interval():
    quiet, loud = (
        fitted_to(Measurements(marks_on(TRUE, BELIEVED, grid(5, 3), noise=noise)), EFFECTS)
        for noise in (0.1, 2.0)
    )
    widths = [
        next(e.high - e.low for e in fitted.estimates if e.name == "motor_height")
        for fitted in (quiet, loud)
    ]
    assert widths[1] > 5 * widths[0]


def test_the_slopes_of_all_residuals_are_those_of_finite_differences():
    light = marks_on(TRUE, BELIEVED, grid(3, 2))
    heavy = marks_on(TRUE, BELIEVED, grid(3, 2), sled_weight=150.0, prefix="heavy ")
    board = Measurements(light + heavy, distances_between(light).distances)
    priors = {**PRIORS, "sled_weight": 5.0}
    problem = Problem.of(TRUE, observe(BELIEVED, board), tuple(EFFECTS), priors, 0.5)
    # The sheet is turned by a fifth of a radian, so that nothing about turning is small.
    place = np.where(np.array(problem.names) == SHEET_ROTATION, 10.0, 0.3)
    slopes = problem.at(place).slopes
    for i in range(len(place)):
        step = 1e-2 * np.eye(len(place))[i]
        ends = [problem.at(place + side * step).residual for side in (1, -1)]
        difference = (ends[1] - ends[0]) / 0.02
        size = np.abs(difference).max()
        assert slopes[:, i] == pytest.approx(difference, abs=0.003 * size + 1e-4)


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
