"""predict and visits: the lab's door to the core, and its slopes."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.fit.observations import chains_to, loaded, observe, visited
from plumb.marks.read import Measurements
from plumb.model.predict import NAMES, believed_lengths, known_effects, lengths, values_of
from plumb.settings.machine import PublishedSettings
from synthetic import BELIEVED, TRUE, grid, marks_on


def test_every_parameter_of_the_library_has_its_place_among_the_values():
    names = {f"{effect}.{name}" for effect, several in known_effects().items() for name in several}
    assert names == {name for name in NAMES if "." in name}


def test_the_stock_controller_believes_its_own_formula_and_plumb_ours():
    published = PublishedSettings(chain_sag_correction=8.2)
    stock = replace(BELIEVED, controller="stock", published=published)
    target = np.array([[1000.0, -400.0]])
    ours = believed_lengths(stock, target, controller="plumb")
    # Our model of these settings has their sag, though it is written in published units.
    assert ours == pytest.approx(lengths(stock.as_plumb_model(), target)[0])
    assert ours != pytest.approx(lengths(BELIEVED, target)[0], abs=0.5)
    assert believed_lengths(stock, target) != pytest.approx(ours, abs=1e-3)


def test_a_heavier_sled_stretches_more_and_sags_less():
    values, factors = loaded(values_of(TRUE), 2 * TRUE.sled_weight, TRUE.sled_weight)
    sag = NAMES.index("chain_sag.weight_ratio_squared")
    assert values[sag] == pytest.approx(8.2e-12 / 4)
    assert factors[sag] == pytest.approx(1 / 4)
    assert values[NAMES.index("sled_weight")] == 2 * TRUE.sled_weight
    assert factors[NAMES.index("sled_weight")] == 0


def test_each_visit_has_its_own_sled():
    light = marks_on(TRUE, BELIEVED, grid(3, 2))
    heavy = marks_on(TRUE, BELIEVED, grid(3, 2), sled_weight=150.0, prefix="heavy ")
    rows = observe(BELIEVED, Measurements(light + heavy))
    where, slopes, _ = visited(values_of(TRUE), rows, over_top=True, usual_weight=TRUE.sled_weight)
    assert where == pytest.approx(rows.measured, abs=5e-5)
    assert np.abs(where[:6] - where[6:]).max() > 0.3
    weight = NAMES.index("sled_weight")
    assert slopes[:6, :, weight].any() and not slopes[6:, :, weight].any()
    chains, _ = chains_to(TRUE, where, rows.sled_weights)
    assert chains == pytest.approx(rows.chains, abs=5e-5)
