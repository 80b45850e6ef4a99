"""Tests of the error that marks leave open: a row of marks settles little."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER, Hidden
from plumb.cure.decision import decide
from plumb.diagnosis import diagnose
from plumb.fit.expected import expected_error
from plumb.fit.inputs import Inputs
from plumb.fit.problem import PRIORS, Checked


def open_of(layout, *, noise=0.5, seed=3, settings=MAKER):
    board = cut(Hidden(), layout, seed=seed, noise=noise, tape_sigma=noise, settings=settings)
    return diagnose(Inputs(settings, board.measurements)).left_open


@pytest.mark.parametrize(
    ("columns", "rows", "is_too_much"),
    [(9, 1, True), (2, 2, True), (3, 2, False)],
)
def test_a_row_of_marks_leaves_too_much_open(columns, rows, is_too_much):
    assert open_of(plan(columns, rows)).is_too_much is is_too_much


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
    assert open_of(plan(3, 3), settings=bare).before == pytest.approx(
        normal.among_marks_mm, rel=0.1
    )


def test_no_command_fits_too_few_marks():
    marks = cut(Hidden(), plan(3, 1), seed=3, settings=MAKER).measurements
    result = decide(Inputs(MAKER, marks))
    assert result.addition is None and result.chosen == () and not result.done
    said = result.reason
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
