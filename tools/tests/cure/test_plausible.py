"""What no real machine has: plumb add and plumb diagnose judge a size alike."""

from dataclasses import replace

import pytest
from plumb.cure.add import add
from plumb.diagnosis import diagnose
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements
from plumb.model.catalogue import parameter_words
from synthetic import BELIEVED, grid, marks_on

SIGMA = 0.5
WIDE = grid(5, 5)
SIZED = ("chain_pitch.left", "chain_plane.gap_squared", "frame_flex.inward")


def board_with(name, share):
    """Marks of a machine on which a parameter has a share of the largest plausible size."""
    effect, _, parameter = name.partition(".")
    size = share * parameter_words()[name]["high"]
    true = replace(BELIEVED, effects={effect: {parameter: size}})
    return Measurements(marks_on(true, BELIEVED, WIDE, noise=SIGMA, seed=3), source="made up")


def judged(diagnosis, measurements, effect):
    """Of each parameter: whether it is plausible and possible by the diagnosis, and by the fit."""
    sizes = next(ranked for ranked in diagnosis.ranking if ranked.effect == effect).sizes
    added = add(
        Inputs(BELIEVED, measurements, sigma=diagnosis.noise.sigma), effects=(effect,)
    ).parameters
    fitted = {estimate.name: estimate for estimate in added}
    return [
        (size.plausible, size.possible, estimate.plausible, estimate.possible)
        for size in sizes
        for estimate in [fitted[f"{effect}.{size.name}"]]
    ]


@pytest.mark.parametrize("name", SIZED)
@pytest.mark.parametrize("share", [0.5, 1.25, 1.6, 3.0])
def test_the_fit_and_the_diagnosis_agree_on_every_effect(name, share):
    measurements = board_with(name, share)
    diagnosis = diagnose(Inputs(BELIEVED, measurements, sigma=SIGMA))
    for ranked in diagnosis.ranking:
        if ranked.sizes[0].low is None:
            continue  # nothing was measured that feels it
        for by_size, near_size, by_fit, near_fit in judged(diagnosis, measurements, ranked.effect):
            assert (by_size, near_size) == (by_fit, near_fit), ranked.effect


@pytest.mark.parametrize("name", SIZED)
def test_a_size_a_little_beyond_what_was_met_is_no_reason_to_look_elsewhere(name):
    measurements = board_with(name, 1.25)
    effect = name.partition(".")[0]
    diagnosis = diagnose(Inputs(BELIEVED, measurements, sigma=SIGMA))
    assert (effect,) in [
        explanation.effects for explanation in diagnosis.explanations if explanation.possible
    ]
    for _, by_size, _, by_fit in judged(diagnosis, measurements, effect):
        assert by_size and by_fit


@pytest.mark.parametrize("name", SIZED)
def test_a_size_far_beyond_is_refused_by_both(name):
    measurements = board_with(name, 3.0)
    effect, _, parameter = name.partition(".")
    diagnosis = diagnose(Inputs(BELIEVED, measurements, sigma=SIGMA))
    sizes = next(ranked for ranked in diagnosis.ranking if ranked.effect == effect).sizes
    at = [size.name for size in sizes].index(parameter)
    assert judged(diagnosis, measurements, effect)[at] == (False, False, False, False)
