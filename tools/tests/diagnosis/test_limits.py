"""Limits of the diagnosis: what is not proved, what it must have read, what marks leave open."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.bench.boards import MAKER, Hidden, cut, plan
from plumb.cure.decision import decide
from plumb.diagnosis import diagnose
from plumb.diagnosis.diagnosis import room_for
from plumb.diagnosis.evidence import KNOWN, Noise
from plumb.diagnosis.explanation import Board, explain
from plumb.fit.expected import expected_error
from plumb.fit.fit import PRIORS, Checked
from plumb.fit.inputs import Inputs
from plumb.fit.observations import observe
from plumb.marks.read import Distance, Measurements
from plumb.text.errors import InputError
from plumb.words.decision import reason
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


def open_of(layout, *, noise=0.5, seed=3, settings=MAKER):
    board = cut(Hidden(), layout, seed=seed, noise=noise, tape_sigma=noise, settings=settings)
    return diagnose(Inputs(settings, board.measurements)).left_open


@pytest.mark.parametrize(("grid", "is_much"), [((9, 1), True), ((2, 2), True), ((3, 2), False)])
def test_a_row_of_marks_leaves_too_much_open(grid, is_much):
    assert open_of(plan(*grid)).is_too_much is is_much


def test_distances_settle_the_shape_but_not_the_sheets_place():
    by_places, by_spans = (open_of(plan(3, 3, spans=spans)) for spans in (False, True))
    assert by_spans.now < by_places.now and not by_spans.is_too_much


def test_better_readings_and_more_of_them_leave_less():
    sizes = [open_of(plan(3, 3), noise=noise).now for noise in (1.0, 0.5, 0.2)]
    assert sizes == sorted(sizes, reverse=True) and sizes[0] > 1.5 * sizes[2]
    assert open_of(plan(5, 5)).now < open_of(plan(3, 3)).now
    # Read to a tenth of a millimetre, marks all over the sheet still cannot tell all effects apart.
    assert open_of(plan(5, 5), noise=0.1).now > 0.1


def test_before_any_mark_the_expected_error_is_the_normal_one():
    bare = replace(MAKER, effects={})
    normal = expected_error(bare, PRIORS)
    before = open_of(plan(3, 3), settings=bare).before
    assert before == pytest.approx(normal.among_marks_mm, rel=0.1)


def test_no_command_fits_too_few_marks():
    marks = cut(Hidden(), plan(3, 1), seed=3, settings=MAKER).measurements
    result = decide(Inputs(MAKER, marks))
    assert result.addition is None and result.chosen == () and not result.done
    said = reason(result)
    assert "leave 1.2 mm open" in said and "2.5 mm by" in said


def test_a_number_that_is_known_leaves_less_open():
    marks = cut(Hidden(), plan(3, 1), seed=3, settings=MAKER).measurements
    inputs = Inputs(MAKER, marks)
    known = replace(inputs, priors={**PRIORS, "motor_gap": 0.1})
    assert diagnose(known).left_open.before < diagnose(inputs).left_open.before
    assert np.isfinite(diagnose(replace(inputs, priors={**PRIORS, "motor_gap": 0})).left_open.now)
    checks = [Checked(f"chain_pitch.{side}", 0.0, 1e-5) for side in ("left", "right")]
    checked = diagnose(replace(inputs, checked=checks)).left_open
    assert checked.before < 0.9 * diagnose(inputs).left_open.before
    assert checked.now < 0.95 * diagnose(inputs).left_open.now
