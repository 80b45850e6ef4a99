"""Sizes that no real machine has: plumb add and plumb diagnose judge them alike."""

from dataclasses import replace

import pytest
from plumb.cure.add import add
from plumb.diagnosis.explanation import explain, measured_board
from plumb.diagnosis.noise import KNOWN, Noise
from plumb.diagnosis.sizes import sizes_of
from plumb.fit.inputs import Inputs
from plumb.marks.read import Measurements
from plumb.model.catalogue import effect_names, parameter_words
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


def judged(measurements, effect):
    """Of each parameter: whether it is plausible and possible by the diagnosis, and by the fit."""
    inputs = Inputs(BELIEVED, measurements, sigma=SIGMA)
    fitted = explain(measured_board(inputs), (effect,))
    sizes = sizes_of(fitted, effect, Noise(SIGMA, KNOWN, "stated"))
    estimates = {each.name: each for each in add(inputs, effects=(effect,)).parameters}
    return {
        size.name: (
            (size.plausible, estimates[f"{effect}.{size.name}"].plausible),
            (size.possible, estimates[f"{effect}.{size.name}"].possible),
        )
        for size in sizes
        if size.low is not None
    }


def test_the_fit_and_the_diagnosis_agree_on_every_effect():
    for number, name in enumerate(SIZED):
        measurements = board_with(name, 1.6)
        # Some of them: all on each board would take a minute.
        for effect in {name.partition(".")[0], *effect_names()[number::5]} - {"sled_friction"}:
            for by_both in judged(measurements, effect).values():
                assert all(ours == theirs for ours, theirs in by_both), (name, effect)


@pytest.mark.parametrize("name", SIZED)
def test_add_and_diagnose_both_doubt_a_size_far_beyond_plausible(name):
    effect, _, parameter = name.partition(".")
    doubted = judged(board_with(name, 3.0), effect)
    assert doubted[parameter] == ((False, False), (False, False))
