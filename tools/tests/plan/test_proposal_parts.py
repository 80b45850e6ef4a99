"""Tests of what a proposal promises beside its chance: pairs told apart, and limits."""

from dataclasses import replace

import numpy as np
import pytest
from plan_cases import MACHINE, case_on, nine
from plumb.marks.read import Measurements
from plumb.plan.separation import apart, pairs_of
from synthetic import grid, marks_on


def pitch_board(left=0.006):
    """Nine marks of a machine whose left chain is longer than the settings say."""
    effects = {**MACHINE.effects, "chain_pitch": {"left": left, "right": 0.0}}
    machine = replace(MACHINE, effects=effects)
    return Measurements(marks_on(machine, MACHINE, grid(3, 3), noise=0.2))


def test_two_effects_are_apart_by_what_a_fit_of_the_other_leaves():
    source = np.random.default_rng(4)
    slopes = source.standard_normal((12, 5))
    drawn, fitted = np.zeros((5, 2)), np.array([0, 1, 2])
    drawn[3, 0], drawn[4, 1] = 2.0, 3.0
    both = slopes @ drawn
    left = both - slopes[:, fitted] @ np.linalg.lstsq(slopes[:, fitted], both, rcond=None)[0]
    assert apart(slopes, drawn, fitted) == pytest.approx(np.sum(left**2))
    # In microns or in metres: the scale of what is fitted does not matter, and unfelt ones neither.
    for scale in (1e-3, 1e3):
        scaled = slopes * np.array([scale, scale, scale, 1.0, 1.0])
        assert apart(scaled, drawn, fitted) == pytest.approx(np.sum(left**2), rel=1e-5)
    unfelt = slopes * np.array([1.0, 1.0, 0.0, 1.0, 1.0])
    rest = both - slopes[:, :2] @ np.linalg.lstsq(slopes[:, :2], both, rcond=None)[0]
    assert apart(unfelt, drawn, fitted) == pytest.approx(np.sum(rest**2))
    # What is fitted itself is not apart from the fit.
    same = np.zeros((5, 1))
    same[1, 0] = 1.0
    assert apart(slopes, same, fitted) == pytest.approx(0.0, abs=1e-6)


def test_every_suspect_is_compared_with_every_other():
    case = case_on(pitch_board(), "chain_pitch", "tape_scale", "frame_lean")
    pairs = pairs_of(case)
    assert len(pairs) == 6 and all(pair.weight == pytest.approx(2 / 3) for pair in pairs)
    alone = case_on(pitch_board(), "chain_pitch", verdict="one_suspect")
    assert len(pairs_of(alone)) == len(alone.posterior.felt) - 1
    hidden = case_on(nine())
    assert len(pairs_of(hidden)) == len(hidden.hypotheses)
    for pair in pairs_of(hidden):
        assert pair.fitted.tolist() == hidden.board.frame.tolist()
