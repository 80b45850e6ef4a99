"""Tests of the proposals where no effect is in question: places and chances."""

from dataclasses import replace
from math import sqrt

import numpy as np
import pytest
from plan_cases import MACHINE, SIGMA, case_on, nine
from plumb.diagnosis.outliers import Outlier
from plumb.plan.planned_visits import BELOW, grid, proof_places, usable
from plumb.plan.proposal import (
    BESIDE,
    MARK,
    READ_AGAIN,
    READING,
    ROUND,
    SURE,
    for_slips,
    near_the_worst,
)
from synthetic import distances_between, marks_on, read_elsewhere
from synthetic import grid as targets_of


def slip(name, *offset):
    return Outlier(name, offset, (SIGMA,) * len(offset), (0.0,) * len(offset), offset, "")


def test_a_second_reading_shows_a_slip_as_often_as_noise_allows():
    case = case_on(nine(), "chain_pitch")
    even = SURE * sqrt(2) * SIGMA  # as often as not
    far = -even - 2 * sqrt(2) * SIGMA
    several = [slip("3", even, 0.0), slip("3", 0.0, far), slip("3", 0.0, 0.0)]
    chances = [chance for _, chance in for_slips(several, case.board.rows, case.noise)]
    assert chances == pytest.approx([0.5, 0.9772, 0.00135], abs=1e-3)


def test_marks_around_the_worst_place_lie_inwards_of_it():
    case = case_on(read_elsewhere(nine(), 8, (6.0, 0.0)), "chain_pitch")
    again, near = near_the_worst(case)
    worst, second = list(dict.fromkeys(again.visits.names))
    assert worst == "8" and len(again.visits) == 2 * READ_AGAIN
    assert again.minutes == ROUND + READING * 2 * READ_AGAIN
    assert near.minutes == ROUND + MARK * len(near.visits)
    assert f"around {worst}, {second}" in near.do[0]
    places = {tuple(place) for place in near.visits.targets.tolist()}
    assert {(1100.0 - BESIDE, -500.0), (1100.0, -500.0 + BESIDE)} <= places
    half = np.array(MACHINE.sheet) / 2
    assert (np.abs(near.visits.targets) <= half - 50).all()
    assert (near.visits.targets % 10 == 0).all()


def test_the_worst_distances_are_measured_again():
    board = distances_between(marks_on(MACHINE, MACHINE, targets_of(3, 3), noise=0.2))
    spans = list(board.distances)
    spans[5] = replace(spans[5], length=spans[5].length + 9.0)
    case = replace(
        case_on(replace(board, distances=tuple(spans)), "chain_pitch"),
        spans=tuple(" - ".join(each.between) for each in spans),
    )
    (again,) = near_the_worst(case)
    said = again.do[0].removeprefix("Measure these distances 3 more times: ")
    assert said.startswith(f"{case.spans[5]}, ")
    assert again.do[0].count(" - ") == 4 and "3 more times" in again.do[0]
    assert again.minutes == ROUND + READING * 3 * 4 and len(again.visits) == 0


def test_proof_marks_lie_far_from_what_was_fitted_and_from_each_other():
    known = targets_of(3, 3)
    first, second = proof_places(MACHINE, known)
    places = grid(MACHINE.sheet, 15, 9)
    places = places[usable(MACHINE, places, MACHINE.sled_weight)]
    places = places[usable(MACHINE, places - [0.0, BELOW], MACHINE.sled_weight)]

    def gap(place, marks):
        return np.linalg.norm(marks - place, axis=1).min()

    assert gap(first, known) == max(gap(place, known) for place in places)
    both = np.vstack([known, first])
    assert gap(second, both) == max(gap(place, both) for place in places)
    assert len(proof_places(MACHINE, np.zeros((0, 2)))) == 2
