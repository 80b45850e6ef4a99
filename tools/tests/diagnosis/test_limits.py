"""Limits of the diagnosis: how large what is not proved may be, and how much it must have read."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.diagnosis import diagnose
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.noise import KNOWN, Noise
from plumb.diagnosis.sizes import room_for
from plumb.fit.inputs import Inputs
from plumb.fit.observations import observe
from plumb.marks.read import Distance, Measurements
from plumb.text.errors import InputError
from scipy import stats
from synthetic import BELIEVED, distances_between, grid, marks_on

STATED = Noise(0.5, KNOWN, "stated")


def pulled(effect, sigmas):
    """The frame's explanation of marks that an effect of one parameter pulls by this many sigma."""
    rows = observe(BELIEVED, Measurements(marks_on(BELIEVED, BELIEVED, grid(5, 4))))
    frame = explain(Board.of(BELIEVED, rows, sigma=0.5))
    (beyond,) = frame.beyond_fit([effect]).T
    size = np.linalg.norm(beyond)
    scale = frame.board.problem.scale[frame.board.columns([effect])[0]]
    rest = replace(frame, at=replace(frame.at, residual=sigmas * beyond / size))
    return rest, scale / size


@pytest.mark.parametrize("effect", ["sheet_skew", "tape_scale"])
def test_a_limit_reaches_as_far_below_zero_as_above(effect):
    # One-sided 95 % of what is measured as 4 sigma, whichever way it points.
    for sigmas in (4.0, -4.0):
        frame, sigma_of_size = pulled(effect, sigmas)
        (limit,) = room_for(effect, (frame,), STATED).limits
        assert limit.largest == pytest.approx((4 + stats.norm.isf(0.05)) * sigma_of_size, rel=0.01)


def test_the_limit_of_a_size_that_cannot_be_negative_is_its_upper_end():
    for sigmas, left in ((4.0, 4 + stats.norm.isf(0.05)), (-4.0, 0.0)):
        frame, sigma_of_size = pulled("chain_plane", sigmas)
        (limit,) = room_for("chain_plane", (frame,), STATED).limits
        assert limit.largest == pytest.approx(left * sigma_of_size, rel=0.01, abs=1e-12)


def test_repeats_do_not_count_as_further_marks():
    twice = marks_on(BELIEVED, BELIEVED, grid(2, 1), noise=0.5)
    marks = twice + marks_on(BELIEVED, BELIEVED, grid(2, 1), noise=0.5, seed=2)
    marks += marks_on(BELIEVED, BELIEVED, grid(2, 1), noise=0.5, seed=3)
    with pytest.raises(InputError, match="4 measured numbers"):
        diagnose(Inputs(BELIEVED, Measurements(marks, source="two marks")))


def test_a_distance_is_the_same_from_both_ends():
    spans = distances_between(marks_on(BELIEVED, BELIEVED, grid(3, 1), noise=0.5))
    back = tuple(Distance(span.between[::-1], span.length + 0.3) for span in spans.distances)
    with pytest.raises(InputError, match="3 measured numbers"):
        diagnose(Inputs(BELIEVED, replace(spans, distances=spans.distances + back)))


def test_three_marks_are_enough_to_begin_with():
    marks = marks_on(BELIEVED, BELIEVED, np.array([(-900.0, 400.0), (900.0, 400.0), (0.0, -400.0)]))
    assert diagnose(Inputs(BELIEVED, Measurements(marks))).verdict == "nothing_provable"
