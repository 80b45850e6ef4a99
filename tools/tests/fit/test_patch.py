"""The residual patch: it lowers the error where nobody measured, or it is not added."""

from dataclasses import replace

import numpy as np
import pytest
from hidden_boards import board
from plumb.bench.boards import MAKER, plan
from plumb.cure.add import add
from plumb.cure.decision import decide
from plumb.fit.compare import PATCH, compare
from plumb.fit.inputs import Inputs
from plumb.model.catalogue import effect_names, parameter_names
from plumb.text.errors import InputError

WIDE = plan(7, 5)


def halves(measurements):
    """Every other mark, and those between."""
    return [replace(measurements, marks=measurements.marks[i::2]) for i in (0, 1)]


def with_cubic(measurements, seed, size):
    """The board under a random field of the third degree, of this many millimetres RMS."""
    source = np.random.default_rng(seed)
    x, y = np.array([mark.target for mark in measurements.marks]).T / [[1219.2], [609.6]]
    moved = np.stack([x**3, x**2 * y, x * y**2, y**3], axis=1) @ source.standard_normal((4, 2))
    moved *= size / np.sqrt(np.mean(np.sum(moved**2, axis=1)))
    marks = [
        replace(mark, measured=tuple(np.add(mark.measured, by)))
        for mark, by in zip(measurements.marks, moved, strict=True)
    ]
    return replace(measurements, marks=tuple(marks))


@pytest.mark.parametrize("kind", ["bump", "cubic"])
def test_it_lowers_the_error_at_marks_that_it_never_saw(kind):
    before, after = [], []
    for seed in range(3):
        if kind == "bump":
            strange = board({}, WIDE, seed=seed, bump=3.0, noise=0.3)
        else:
            strange = with_cubic(board({}, WIDE, seed=seed, noise=0.3), 1000 + seed, 3.0)
        seen, unseen = halves(strange)
        for patch, errors in ((False, before), (True, after)):
            fitted = add(Inputs(MAKER, seen, sigma=0.3), effects=(), patch=patch)
            comparison = compare(Inputs(fitted.settings, unseen, cut_with=MAKER))
            errors.append(comparison.shape_rms)
    assert np.mean(after) < 0.6 * np.mean(before)


def test_it_is_not_added_where_nothing_is_left():
    for seed in range(4):
        clean = board({}, plan(5, 5), seed=seed)
        added = add(Inputs(MAKER, clean, sigma=0.5), effects=(), patch=True).effects_added
        assert PATCH not in added


def test_auto_offers_it_and_adds_it_only_when_asked():
    strange = board({}, plan(5, 5), seed=8, bump=3.0)
    offered = decide(Inputs(MAKER, strange))
    assert offered.diagnosis.verdict == "not_in_library"
    assert offered.offer[1] < 0.8 * offered.offer[0]
    assert PATCH not in offered.addition.effects_added
    taken = decide(Inputs(MAKER, strange), patch=True)
    assert taken.addition.effects_added == (PATCH,)
    assert taken.addition.after.left_out_rms == pytest.approx(offered.offer[1])
    assert taken.addition.settings.effects[PATCH]


def test_it_is_never_a_suspect_and_never_named_as_an_effect():
    assert PATCH not in effect_names() and len(parameter_names(PATCH)) == 18
    with pytest.raises(InputError, match="--patch"):
        add(Inputs(MAKER, board({}, plan(5, 5), seed=1)), effects=[PATCH])
