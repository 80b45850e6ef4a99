"""Machine settings: their limits, and their translation into our model."""

from dataclasses import fields, replace

import pytest
from plumb.model.predict import chain_lengths
from plumb.settings.machine import (
    FRAME_LIMITS,
    PUBLISHED_LIMITS,
    MachineSettings,
    PublishedSettings,
    find_fault,
)
from plumb.text.errors import InputError

STOCK = MachineSettings(
    motor_gap=3602.6,
    motor_height=1078.0,
    rotation_radius=139.1,
    sheet_width=2438.4,
    sheet_height=1219.2,
    feed="top",
    controller="stock",
)


def test_holey_settings_become_effects():
    holey = replace(
        STOCK,
        controller="holey",
        published=PublishedSettings(33.0, chain_elasticity=5.1685e-6, holey_sled_weight=113.68),
    )
    model = holey.as_plumb_model()
    assert model.sled_weight == 113.68
    assert model.chain_weight == 0.001372
    # 0.001372^2 / (24 * 113.68^2) = 6.069e-12, whatever $37 says.
    assert model.effects["chain_sag"]["weight_ratio_squared"] == pytest.approx(6.069e-12, rel=1e-4)
    assert model.effects["chain_stretch"] == {"compliance": 5.1685e-6}
    stock = holey.as_plumb_model(controller="stock")
    assert stock.effects == {"chain_sag": {"weight_ratio_squared": pytest.approx(33e-12)}}


@pytest.mark.parametrize(
    ("published", "key"),
    [
        (PublishedSettings(chain_elasticity=5e-6), "sledWeight"),
        (PublishedSettings(holey_sled_weight=97.9), "chainElasticity"),
    ],
)
def test_holey_does_not_guess(published, key):
    holey = replace(STOCK, controller="holey", published=published)
    with pytest.raises(InputError, match=key):
        holey.as_plumb_model()
    with pytest.raises(InputError, match=key):
        chain_lengths(holey, [[0.0, 0.0]])


GOOD = MachineSettings(2978.4, 1072.6, 139.1, 2438.4, 1219.2, "top")


def test_every_number_has_a_limit():
    numbers = {field.name for field in fields(MachineSettings)} - {
        "motor_height",
        "feed",
        "controller",
        "effects",
        "published",
        "file",
        "fitted",
    }
    assert set(FRAME_LIMITS) == numbers | {"motor_offset"}
    assert set(PUBLISHED_LIMITS) == {field.name for field in fields(PublishedSettings)}


@pytest.mark.parametrize("gap", [2978.4, 3719.6])
@pytest.mark.parametrize("offset", [422, 463, 1063.2])
@pytest.mark.parametrize("radius", [0, 100, 250])
def test_machines_that_exist_are_accepted(gap, offset, radius):
    real = replace(GOOD, motor_gap=gap, motor_height=609.6 + offset, rotation_radius=radius)
    assert find_fault(real) is None


@pytest.mark.parametrize("name", sorted(set(FRAME_LIMITS) - {"motor_offset"}))
@pytest.mark.parametrize("value", [float("nan"), float("inf"), -1e9])
def test_impossible_numbers_are_named(name, value):
    faulty, sentence = find_fault(replace(GOOD, **{name: value}))
    assert faulty == name or name == "sheet_height"
    assert sentence
