"""chain view and covariates: errors on the sheet as chain, against what they may depend on."""

from dataclasses import replace

import numpy as np
import pytest
from chain_views import chain_view
from plumb.fit.compare import compare
from plumb.fit.covariates import covariates
from plumb.fit.inputs import Inputs
from plumb.fit.observations import observe
from plumb.marks.read import Mark, Measurements
from plumb.model.predict import lengths, values_of
from synthetic import BELIEVED, TRUE, grid, marks_on


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
