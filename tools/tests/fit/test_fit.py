"""fit: it finds what was hidden, and is honest about what it does not know."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.fit.fit import fit
from plumb.fit.observations import observe
from plumb.fit.problem import PRIORS, Problem
from plumb.fit.sighting import SHEET_ROTATION
from plumb.marks.read import Measurements
from synthetic import BELIEVED, EFFECTS, TRUE, distances_between, grid, marks_on

WIDE = {**PRIORS, "motor_gap": 1e4, "motor_height": 1e4, "motor_center_x": 1e4}
WIDE[SHEET_ROTATION] = 10.0


def without(measurements: Measurements, name: str) -> Measurements:
    return replace(
        measurements, marks=tuple(mark for mark in measurements.marks if mark.name != name)
    )


def test_hidden_parameters_are_found_again():
    board = Measurements(marks_on(TRUE, BELIEVED, grid(7, 5), rotation=0.002))
    fitted = fit(BELIEVED, observe(BELIEVED, board), effects=EFFECTS, priors=WIDE)
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
        fitted = fit(
            BELIEVED,
            observe(BELIEVED, Measurements(marks)),
            effects=EFFECTS,
            priors=WIDE,
            sigma=0.5,
        )
        assert fitted.rms < 1e-4
        stretch = next(
            estimate for estimate in fitted.estimates if estimate.name == "chain_stretch.compliance"
        )
        assert stretch.low < 5.2e-6 < stretch.high
        widths.append(stretch.high - stretch.low)
    assert widths[1] < 0.6 * widths[0]


def test_marks_and_distances_are_fitted_together():
    marks = marks_on(TRUE, BELIEVED, grid(5, 3), noise=0.2)
    spans = distances_between(marks_on(TRUE, BELIEVED, grid(5, 3))).distances
    rows = observe(BELIEVED, Measurements(marks, spans))
    both = fit(BELIEVED, rows, effects=["chain_pitch"], sigma=0.2)
    alone = fit(
        BELIEVED, observe(BELIEVED, Measurements(marks)), effects=["chain_pitch"], sigma=0.2
    )
    assert len(both.distance_errors) == len(spans)
    assert both.estimates[-1].high - both.estimates[-1].low < (
        alone.estimates[-1].high - alone.estimates[-1].low
    )


def test_the_left_out_error_is_that_of_a_fit_without_the_mark():
    board = Measurements(marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.5))
    whole = fit(BELIEVED, observe(BELIEVED, board), effects=["chain_pitch", "chain_sag"], sigma=0.5)
    rows = observe(BELIEVED, board)
    for i, name in enumerate(rows.names):
        part = fit(
            BELIEVED,
            observe(BELIEVED, without(board, name)),
            effects=["chain_pitch", "chain_sag"],
            sigma=0.5,
        )
        left = measured_minus_predicted(part, board, i)
        assert whole.left_out_errors[i] == pytest.approx(left, abs=0.01)
        assert np.hypot(*left) > np.hypot(*whole.errors[i])


def test_repeats_of_a_mark_are_left_out_together():
    once = marks_on(TRUE, BELIEVED, grid(4, 3), noise=0.5)
    again = marks_on(TRUE, BELIEVED, grid(4, 3)[:2], noise=0.5, seed=2)
    board = Measurements(once + again)
    whole = fit(BELIEVED, observe(BELIEVED, board), effects=["chain_pitch"], sigma=0.5)
    part = fit(BELIEVED, observe(BELIEVED, without(board, "0")), effects=["chain_pitch"], sigma=0.5)
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
        fitted = fit(BELIEVED, observe(BELIEVED, Measurements(marks)), effects=EFFECTS)
        truth = {f"chain_pitch.{side}": EFFECTS["chain_pitch"][side] for side in ("left", "right")}
        inside += [e.low < truth[e.name] < e.high for e in fitted.estimates if e.name in truth]
    assert 0.86 < np.mean(inside) <= 1.0


def test_a_wider_prior_does_not_narrow_an_interval():
    quiet, loud = (
        fit(
            BELIEVED,
            observe(BELIEVED, Measurements(marks_on(TRUE, BELIEVED, grid(5, 3), noise=noise))),
            effects=EFFECTS,
        )
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
