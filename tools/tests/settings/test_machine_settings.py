"""Machine settings and their translation into our model."""

from dataclasses import replace

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
