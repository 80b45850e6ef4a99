"""Tests of the words for slips, and of parts that only slow boards use."""

import numpy as np
import pytest
from plumb.diagnosis.outliers import Reading, Shift, described
from plumb.fit.inputs import Inputs
from plumb.marks.read import Distance, Mark, Measurements
from synthetic import BELIEVED


def slip_of(read, expected, sigma=0.3):
    """The slip of a mark that was read here and expected there."""
    marks = Measurements((Mark("A", (0.0, 0.0), read),))
    offset = np.subtract(read, expected)
    return described(
        Shift(Reading(0, True), offset, np.full(2, sigma), 99.0), Inputs(BELIEVED, marks)
    )


def slip_of_distance(read, expected):
    """The slip of a distance."""
    ends = (Mark("A", (0.0, 0.0)), Mark("B", (900.0, 0.0)))
    marks = Measurements(ends, (Distance(("A", "B"), read),))
    offset = np.array([read - expected])
    return described(
        Shift(Reading(0, False), offset, np.array([0.3]), 99.0), Inputs(BELIEVED, marks)
    )


@pytest.mark.parametrize(
    ("read", "expected", "guess"),
    [
        ((412.0, 100.0), (421.0, 100.0), "412 written for 421?"),
        ((300.0, -200.0), (-200.0, 300.0), "x and y may be exchanged"),
        ((410.0, 100.0), (400.0, 100.0), "misread by 10 mm in x?"),
        ((400.0, 125.4), (400.0, 100.0), "misread by an inch in y?"),
        ((407.3, 107.3), (400.0, 100.0), ""),
    ],
)
def test_usual_mistakes_are_guessed(read, expected, guess):
    slip = slip_of(read, expected)
    assert slip.guess == guess and slip.expected == pytest.approx(expected)
    assert slip.length == pytest.approx(np.hypot(*np.subtract(read, expected)))


def test_digits_on_both_sides_of_the_point_are_neighbours():
    assert slip_of((412.3, 100.0), (413.2, 100.0), sigma=0.05).guess == "412.3 written for 413.2?"
    # With a digit between them they are not.
    assert slip_of((214.0, 100.0), (412.0, 100.0)).guess == ""


def test_five_deviations_are_surely_wrong():
    assert slip_of((412.0, 100.0), (421.0, 100.0), sigma=9 / 5.5).guess == "412 written for 421?"
    assert "written" not in slip_of((412.0, 100.0), (421.0, 100.0), sigma=9 / 4.5).guess


def test_a_distance_has_no_axis():
    slip = slip_of_distance(925.4, 900.0)
    assert slip.guess == "misread by an inch?" and slip.way == "too long"
    assert slip_of_distance(890.0, 900.0).way == "too short"
