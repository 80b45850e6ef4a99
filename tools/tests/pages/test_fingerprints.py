"""fingerprints: fields, sizes and cosines on the default machine, against published figures."""

import numpy as np
import pytest
from fingerprints import (
    FRAME_STEPS,
    Showing,
    cosine,
    default_machine,
    every_showing,
    look_alikes,
    showings_of,
)
from plumb.fit.observations import rms
from plumb.model.catalogue import every_effect

SHOWINGS = every_showing()


def shape_cosine(cause: dict, other: dict) -> float:
    return cosine(*(Showing("", parameters).field.shape for parameters in (cause, other)))


BOTH = {"chain_pitch.left": 0.001, "chain_pitch.right": 0.001}
SAG = {"chain_sag.weight_ratio_squared": 8.2e-12}
STRETCH = {"chain_stretch.compliance": 5.2e-6}
TAPE = {"tape_scale.strain": 0.001}


# Published cosines of shapes, 13 x 7 marks on the same machine, computed independently.
@pytest.mark.parametrize(
    ("cause", "other", "published"),
    [
        ({"motor_gap": 1.0}, {"rotation_radius": 1.0}, -0.99),
        ({"motor_gap": 1.0}, STRETCH, -0.88),
        ({"rotation_radius": 1.0}, STRETCH, 0.91),
        ({"frame_flex.inward": 0.007}, STRETCH, 0.97),
        ({"frame_flex.downward": 0.02}, BOTH, -0.91),
        ({"frame_flex.downward": 0.02}, TAPE, -0.74),
        (BOTH, TAPE, 0.73),
        (BOTH, SAG, -0.60),
        (SAG, TAPE, -0.67),
        (SAG, STRETCH, 0.0),
        ({"chain_pitch.left": 0.001}, {"chain_pitch.right": 0.001}, 0.60),
    ],
)
def test_cosines_are_those_published(cause, other, published):
    assert shape_cosine(cause, other) == pytest.approx(published, abs=0.05)


def test_sizes_are_those_published():
    gap, radius = (Showing("", {name: 1.0}).field for name in ("motor_gap", "rotation_radius"))
    assert (rms(gap.raw), rms(gap.shape)) == pytest.approx((0.72, 0.39), abs=0.02)
    assert (rms(radius.raw), rms(radius.shape)) == pytest.approx((1.75, 0.61), abs=0.04)


def test_what_only_moves_the_sheet_has_no_shape():
    for name in ("motor_level", "motor_height"):
        assert not any(case.field.has_shape for case in SHOWINGS[name])
        assert not look_alikes(name, SHOWINGS)


def test_both_chain_zeros_are_the_rotation_radius():
    nearest, cosine = look_alikes("chain_zero", SHOWINGS)[0]
    assert nearest == "rotation_radius" and cosine == pytest.approx(1.0, abs=1e-3)


def test_every_cause_has_its_field_and_three_others_beside_it():
    assert set(SHOWINGS) == {cause["name"] for cause in every_effect()} | set(FRAME_STEPS)
    for name, cases in SHOWINGS.items():
        assert all(rms(case.field.raw) > 0.01 for case in cases)
        alikes = look_alikes(name, SHOWINGS)
        if any(case.field.has_shape for case in cases):
            assert len(alikes) == 3 and name not in dict(alikes)
            assert np.all(np.diff([abs(cosine) for _, cosine in alikes]) < 0.005)


def test_sides_are_shown_together_and_friction_from_two_sides():
    cases = {cause["name"]: [case.label for case in showings_of(cause)] for cause in every_effect()}
    assert cases["chain_pitch"] == ["left", "right", "both alike"]
    assert cases["sled_swing"] == ["right", "up"]
    assert cases["sled_friction"] == [
        "drag, approached moving right",
        "drag, approached moving up",
    ]


def test_the_default_machine_has_sag_and_stretch():
    assert set(default_machine().effects) == {"chain_sag", "chain_stretch"}
