"""Machine settings and their translation into our model."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.model.predict import chain_lengths
from plumb.settings.machine import MachineSettings, PublishedSettings
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


def test_stock_corrections_become_effects():
    stock = replace(
        STOCK, published=PublishedSettings(27.4, left_tolerance=0.1, right_tolerance=0.3)
    )
    model = stock.as_plumb_model()
    assert model.effects["chain_sag"]["weight_ratio_squared"] == pytest.approx(27.4e-12)
    assert model.effects["chain_pitch"] == pytest.approx({"left": 0.001, "right": 0.003})
    assert model.published == PublishedSettings()
    # The published formula also divides the radius: 139.1 stands for 139.1 * 1.002 mm of ring.
    assert model.rotation_radius == pytest.approx(139.1 * 1.002, abs=1e-3)


@pytest.mark.parametrize(("left", "right"), [(0.2, 0.2), (0.3, -0.1)])
def test_the_radius_keeps_the_lengths(left, right):
    stock = replace(STOCK, published=PublishedSettings(0.0, left, right))
    model = stock.as_plumb_model()
    points = np.array([[0.0, 0.0], [900.0, -500.0], [-900.0, 500.0]])
    plain = replace(STOCK, rotation_radius=0.0)
    wrapped_and_straight = chain_lengths(plain, points)
    strains = np.array([left, right]) / 100
    published = chain_lengths(stock, points)
    # What our chain_pitch does, (straight - R) / (1 + e) + wrapped, from the same geometry.
    straight = np.sqrt(
        (points[:, :1] - np.array([-1801.3, 1801.3])) ** 2
        + (1078.0 - points[:, 1:]) ** 2
        - STOCK.sprocket_radius**2
    )
    wrapped = wrapped_and_straight - straight
    ours = wrapped + (straight - model.rotation_radius) / (1 + strains)
    half_difference = 139.1 * abs(left - right) / 200
    assert np.abs(ours - published).max() == pytest.approx(half_difference, abs=2e-3)


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
