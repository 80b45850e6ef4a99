"""Chains paid out, what was measured of the places they led to, and errors seen as chain."""

from dataclasses import replace

import numpy as np
import pytest
from chain_views import chain_view
from plumb.fit.compare import compare, covariates
from plumb.fit.inputs import Inputs
from plumb.fit.observations import model_and_observations, observe
from plumb.marks.read import Distance, Mark, Measurements
from plumb.model.predict import lengths, values_of
from plumb.settings.machine import PublishedSettings
from synthetic import BELIEVED, TRUE, grid, marks_on

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
    published = PublishedSettings(8.2, chain_elasticity=5e-6, holey_sled_weight=110.0)
    holey = replace(STOCK, published=published)
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


def seen(true, **how):
    """The chain view of marks that a true machine made, by the machine that sent it."""
    rows = observe(BELIEVED, Measurements(marks_on(true, BELIEVED, grid(5, 3), **how)))
    return chain_view(values_of(BELIEVED), {}, rows, BELIEVED)


def known(rows, model=BELIEVED):
    return {each.name: each for each in covariates(model, rows)}


def rows_at(*marks):
    return observe(BELIEVED, Measurements(marks))


@pytest.mark.parametrize("zero", [(2.0, 0.0), (0.0, -1.5)])
def test_a_chain_zeroed_wrong_is_the_same_error_of_that_chain_everywhere(zero):
    effects = {"chain_zero": {"left": zero[0], "right": zero[1]}}
    view = seen(replace(BELIEVED, effects=effects))
    assert view.chains == pytest.approx(np.tile(zero, (15, 1)), abs=0.01)
    assert np.ptp(np.hypot(*view.errors.T)) > 0.3  # on the sheet it looks different everywhere


def test_a_longer_chain_errs_with_its_length():
    view = seen(replace(BELIEVED, effects={"chain_pitch": {"left": 0.001, "right": 0.0}}))
    paid = lengths(BELIEVED, grid(5, 3))[0]
    share = view.chains[:, 0] / paid[:, 0]
    assert np.corrcoef(view.chains[:, 0], paid[:, 0])[0, 1] > 0.9999
    assert share == pytest.approx(np.full(15, 0.001), rel=0.15)  # less the chain on the sprocket
    assert np.abs(view.chains[:, 1]).max() < 0.01


def test_chain_errors_are_those_of_compare():
    marks = Measurements(marks_on(TRUE, BELIEVED, grid(5, 3), rotation=0.001, noise=0.5))
    compared = compare(Inputs(BELIEVED, marks)).marks
    said = [(mark.left_chain_residual, mark.right_chain_residual) for mark in compared]
    view = chain_view(values_of(BELIEVED), {}, observe(BELIEVED, marks), BELIEVED)
    assert view.chains == pytest.approx(np.array(said))
    assert view.errors == pytest.approx(np.array([mark.error for mark in compared]))


def test_a_straight_chain_closes_the_triangle():
    place = np.array([300.0, -100.0])
    seen_there = known(rows_at(Mark("1", tuple(place), tuple(place))))
    length, angle = (seen_there[name].values[0, 0] for name in ("length", "angle"))
    sprocket = np.array([-BELIEVED.motor_gap / 2, BELIEVED.motor_height])
    straight = np.hypot(*(place - sprocket))
    # Without the arm, and but for the sprocket's radius.
    assert length + BELIEVED.rotation_radius == pytest.approx(straight, abs=1.0)
    down = np.arctan2(sprocket[1] - place[1], place[0] - sprocket[0])
    assert angle == pytest.approx(down, abs=1.1 * BELIEVED.sprocket_radius / straight)


@pytest.mark.parametrize("pitch", [0.0, 0.004])  # of both chains: 8 mm in two metres
def test_an_eccentric_sprocket_is_a_sine_against_the_phase(pitch):
    runout = {"left_sine": 0.4, "left_cosine": 0.0, "right_sine": 0.0, "right_cosine": -0.3}
    effects = {"chain_pitch": {"left": pitch, "right": pitch}}
    model = replace(BELIEVED, effects=effects)
    true = replace(model, effects={**effects, "sprocket_runout": runout})
    rows = observe(model, Measurements(marks_on(true, model, grid(7, 5))))
    chains = chain_view(values_of(model), {}, rows, model).chains
    phase = known(rows, model)["phase"].values
    assert chains[:, 0] == pytest.approx(-0.4 * np.sin(phase[:, 0]), abs=0.03)
    assert chains[:, 1] == pytest.approx(0.3 * np.cos(phase[:, 1]), abs=0.03)
    assert phase.min() >= 0 and phase.max() < 2 * np.pi


def test_order_and_approach_are_those_of_the_visits():
    marks = (
        Mark("1", (0.0, 0.0), (0.0, 0.0), approach=(0.0, -40.0)),
        Mark("2", (0.0, 100.0), (0.0, 100.0)),
        Mark("3", (0.0, 200.0), (0.0, 200.0), approach=(-3.0, 0.0)),
    )
    seen_there = known(rows_at(*marks))
    assert seen_there["order"].values[:, 0].tolist() == [1, 2, 3]
    approach = seen_there["approach"].values
    assert approach[[0, 2], 0] == pytest.approx([-np.pi / 2, np.pi])
    assert np.isnan(approach[1]).all()
    assert seen_there["y"].values[:, 1] == pytest.approx([0, 100, 200], abs=1e-3)
