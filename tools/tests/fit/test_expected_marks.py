"""Tests of the expected error of marks before anything is measured."""

from dataclasses import replace

import pytest
from plumb.fit.compare import best_pose
from plumb.fit.expected import (
    COLUMNS,
    MARGIN,
    ROWS,
    WIDE,
    expected_anywhere,
    expected_error,
    expected_priors,
    places_over,
)
from plumb.fit.fit import PRIORS
from plumb.fit.observations import rms
from plumb.model.catalogue import parameter_words
from plumb.model.predict import FOUND, NAMES, lengths, places
from synthetic import BELIEVED, grid

AT = grid(4, 3)
TYPICAL = {name: words["typical"] for name, words in parameter_words().items() if name in NAMES}


def moved_by(**wrong):
    """The error of a machine with these numbers at each place (n, 2) [mm]."""
    chains, outcome = lengths(BELIEVED, AT)
    where, reached = places(replace(BELIEVED, **wrong), chains)
    assert (outcome == FOUND).all() and (reached == FOUND).all()
    return where - AT


def with_effect(name, size):
    effect, _, parameter = name.partition(".")
    return {effect: {parameter: size}}


@pytest.mark.parametrize("number", ["motor_gap", "motor_height", "rotation_radius"])
def test_a_number_of_the_frame_counts_as_far_as_it_may_be_off(number):
    moved = moved_by(**{number: getattr(BELIEVED, number) + 0.5})
    expected = expected_error(BELIEVED, {number: 0.5}, at=AT)
    assert expected.frame == pytest.approx(rms(moved), rel=0.01)
    assert expected.shape == pytest.approx(
        rms(best_pose(AT, AT + moved).errors), rel=0.01, abs=1e-9
    )
    assert expected_error(BELIEVED, {number: 0.0}, at=AT).frame == 0.0


def test_effects_count_by_their_typical_sizes_until_the_settings_have_them():
    whole = expected_error(BELIEVED, {}, at=AT).effects
    for name, size in TYPICAL.items():
        moved = moved_by(effects=with_effect(name, size / 10))
        shape = 10 * rms(best_pose(AT, AT + moved).errors)
        known = replace(BELIEVED, effects=with_effect(name, 1e-9 * size))
        left = expected_error(known, {}, at=AT).effects
        assert whole**2 - left**2 == pytest.approx(shape**2, rel=0.2, abs=1e-3 * whole**2), name


def test_places_reach_all_over_the_sheet():
    looked_at = places_over((2000.0, 1000.0))
    assert looked_at.shape == (COLUMNS * ROWS, 2)
    assert looked_at.max(axis=0).tolist() == [1000 - MARGIN, 500 - MARGIN]
    assert looked_at.min(axis=0).tolist() == [MARGIN - 1000, MARGIN - 500]
    by_places = expected_error(BELIEVED, PRIORS, at=places_over(BELIEVED.sheet))
    assert expected_error(BELIEVED, PRIORS) == by_places
    assert expected_anywhere(BELIEVED, PRIORS) == by_places


def test_known_numbers_replace_the_usual_ones():
    usual = expected_priors({})
    assert usual == {**PRIORS, **WIDE}
    known = expected_priors({"motor_gap": 0.5, "sled_weight": 1.0, "chain_pitch.left": 1e-4})
    assert known == {**usual, "motor_gap": 0.5, "sled_weight": 1.0}
