"""Readings to look at again while others are still being typed: which, by how much, and why."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.diagnosis.readings import look_over
from plumb.fit.inputs import Inputs
from plumb.marks.read import Mark, Measurements
from synthetic import BELIEVED, distances_between, grid, marks_on, read_elsewhere


def board(columns=5, rows=3):
    return Measurements(marks_on(BELIEVED, BELIEVED, grid(columns, rows), noise=0.3))


def doubts(measurements, **how):
    return look_over(Inputs(BELIEVED, measurements, **how)).doubts


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
