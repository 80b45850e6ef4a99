"""observations: chains paid out, and what was measured of the places they led to."""

from dataclasses import replace

import numpy as np
import pytest
from plumb.fit.observations import model_and_observations, observe
from plumb.marks.read import Distance, Mark, Measurements
from plumb.model.predict import lengths
from plumb.settings.machine import PublishedSettings
from synthetic import BELIEVED, TRUE

A = Mark("A", (0.0, 0.0), (1.0, 2.0))
B = Mark("B", (500.0, 100.0))
C = Mark("C", (-500.0, 100.0), (-501.0, 99.0), sled_weight=120.0, chains=(1500.0, 1600.0))
BOARD = Measurements((A, B, C), (Distance(("C", "A"), 510.0), Distance(("A", "B"), 509.0)))
STOCK = replace(BELIEVED, controller="stock", published=PublishedSettings(8.2, 0.1, 0.2))


def test_rows_are_visits_and_distances_join_them():
    rows = observe(BELIEVED, BOARD)
    assert rows.names == ("A", "C")
    assert rows.mark_rows.tolist() == [0, 2]
    assert rows.measured.tolist() == [[1.0, 2.0], [-501.0, 99.0]]
    assert rows.targets.tolist() == [[0.0, 0.0], [-500.0, 100.0]]
    assert rows.distance_rows.tolist() == [[2, 0], [0, 1]]
    assert rows.count == 2 * 2 + 2


def test_a_mark_without_a_weight_has_that_of_the_file_then_of_the_model_then_of_the_settings():
    assert observe(BELIEVED, BOARD).sled_weights.tolist() == [97.9, 97.9, 120.0]
    assert observe(BELIEVED, BOARD, sled_weight=99.0).sled_weights.tolist() == [99.0, 99.0, 120.0]
    said = replace(BOARD, sled_weight=111.0)
    assert observe(BELIEVED, said, sled_weight=99.0).sled_weights[0] == 111.0


def test_the_option_outweighs_the_marks_and_they_the_settings():
    target = np.array([[900.0, -500.0]])
    marks = Measurements((Mark("1", (900.0, -500.0), (900.0, -500.0)),), controller="stock")
    plumb = observe(STOCK, replace(marks, controller="plumb")).chains
    stock = observe(STOCK, replace(marks, controller=None)).chains
    assert plumb == pytest.approx(lengths(STOCK.as_plumb_model(), target)[0], abs=1e-9)
    assert np.abs(stock - plumb).max() > 0.01
    assert observe(STOCK, marks, controller="plumb").chains.tolist() == plumb.tolist()


def test_published_settings_mean_what_their_controller_made_of_them():
    holey = replace(
        STOCK, published=PublishedSettings(8.2, chain_elasticity=5e-6, holey_sled_weight=110.0)
    )
    model, rows = model_and_observations(holey, BOARD, controller="holey")
    assert model.effect("chain_stretch", "compliance") == 5e-6
    assert rows.sled_weights[0] == model.sled_weight == 110.0
    model, _ = model_and_observations(holey, BOARD)
    assert "chain_stretch" not in model.effects


def test_chains_come_from_the_settings_in_force_and_the_model_from_the_others():
    heavy = replace(TRUE, sled_weight=130.0)
    model, rows = model_and_observations(heavy, BOARD, cut_with=STOCK)
    assert model == heavy
    assert rows.chains[0] == pytest.approx(observe(STOCK, BOARD).chains[0])
    assert rows.sled_weights.tolist() == [130.0, 130.0, 120.0]


def test_an_rms_counts_marks_as_vectors_and_distances_only_where_no_mark_is():
    rows = observe(BELIEVED, BOARD)
    errors = np.array([3.0, 4.0, 0.0, 0.0, 100.0, 100.0])  # two marks, then two distances
    assert rows.rms_of(errors) == pytest.approx(np.sqrt(25 / 2))
    assert rows.rms_of_noise(np.array([0.5, 0.5, 0.0, 1.2, 0.0, 0.0])) == pytest.approx(1.0)
    spans = replace(rows, measured=np.zeros((0, 2)), targets=np.zeros((0, 2)), names=())
    assert spans.rms_of(np.array([6.0, 8.0])) == pytest.approx(np.sqrt(50))
