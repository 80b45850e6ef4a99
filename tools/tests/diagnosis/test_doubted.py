"""Readings to look at again while others are still being typed, and the words for slips."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.diagnosis.outliers import Reading, Shift, described
from plumb.diagnosis.readings import look_over
from plumb.fit.inputs import Inputs
from plumb.marks.read import Distance, Mark, Measurements
from synthetic import BELIEVED, distances_between, grid, marks_on, read_elsewhere


def board(columns=5, rows=3):
    return Measurements(marks_on(BELIEVED, BELIEVED, grid(columns, rows), noise=0.3))


def doubts(measurements, **how):
    return look_over(Inputs(BELIEVED, measurements, **how))


@pytest.mark.parametrize("sigma", [None, 0.3])
def test_a_reading_that_no_machine_explains_is_named_with_its_row(sigma):
    assert doubts(board(), sigma=sigma) == ()
    (doubt,) = doubts(read_elsewhere(board(), 8, (31.0, -22.0)), sigma=sigma)
    assert (doubt.index, doubt.is_mark) == (8, True)
    assert doubt.off == pytest.approx(np.hypot(31.0, 22.0), abs=2.0)
    assert doubt.sentence.startswith("it reads 38") and "remeasure" not in doubt.sentence


def test_a_reading_half_a_sheet_away_is_named_first_and_the_rest_is_looked_at_without_it():
    twice = read_elsewhere(read_elsewhere(board(), 3, (700.0, 0.0)), 11, (0.0, 40.0))
    far, near = doubts(twice)
    assert (far.index, near.index) == (3, 11) and far.is_mark and near.is_mark
    assert far.off == pytest.approx(700.0, abs=2.0)
    assert "it reads 700 mm from where the mark was sent" in far.sentence
    only_far = read_elsewhere(board(1, 1), 0, (900.0, 0.0))
    assert [doubt.index for doubt in doubts(only_far)] == [0]


def test_a_distance_is_counted_among_the_distances():
    spans = list(distances_between(board(4, 3).marks).distances)
    spans[17] = replace(spans[17], length=spans[17].length + 23.0)
    marks = tuple(replace(mark, measured=None) for mark in board(4, 3).marks)
    (doubt,) = doubts(Measurements(marks, tuple(spans)))
    assert (doubt.index, doubt.is_mark) == (17, False)
    assert doubt.off == pytest.approx(23.0, abs=2.0) and "too long" in doubt.sentence


def test_marks_that_wait_for_their_reading_are_no_slips():
    waiting = Mark("later", (0.0, 300.0), is_unread=True)
    marks = (waiting, *read_elsewhere(board(), 8, (31.0, -22.0)).marks)
    (doubt,) = doubts(Measurements(marks))
    assert doubt.index == 9
    assert doubts(Measurements((waiting,))) == ()


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
