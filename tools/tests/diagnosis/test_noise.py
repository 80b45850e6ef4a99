"""The noise of a reading, and one posterior whose listed accounts hold most."""

from dataclasses import replace

import numpy as np
import pytest
from hidden_boards import board, board_cut, size_for
from plumb.bench.boards import BARE, MAKER, Hidden, cut, plan
from plumb.diagnosis import diagnose
from plumb.diagnosis.evidence import (
    KNOWN,
    SURPRISING,
    Noise,
    left_by_noise,
    misfit_chance,
    noise_by,
)
from plumb.diagnosis.explanation import Board, explain, measured_board
from plumb.diagnosis.posterior import LISTED, MOST_LISTED, listing, posterior_of
from plumb.diagnosis.priors import STATED_SPREAD
from plumb.fit.inputs import Inputs, Stated
from plumb.fit.observations import observe
from plumb.marks.read import Measurements
from plumb.model.catalogue import EVERY_MACHINE
from plumb.text.values import MM
from scipy import stats
from synthetic import BELIEVED, TRUE, grid, marks_on

FINAL = Stated(0.5, is_final=True)


def board_of(*, noise, columns=5, rows=3, times=1, seed=1, true=BELIEVED, sigma=0.5):
    """Marks with noise, each read several times; only the frame is off."""
    exact = marks_on(true, BELIEVED, grid(columns, rows)) * times
    source = np.random.default_rng(seed)
    marks = [
        replace(mark, measured=tuple(mark.measured + noise * source.standard_normal(2)))
        for mark in exact
    ]
    return Board.of(BELIEVED, observe(BELIEVED, Measurements(tuple(marks))), sigma=sigma)


def weights_for(sigmas, sigma, degrees):
    """Log weights of noises of which a sigma with some degrees of freedom was seen."""
    return -degrees * (np.log(sigmas) + 0.5 * (sigma / sigmas) ** 2)


@pytest.mark.parametrize("degrees", [10, 200])
def test_a_noise_is_known_as_well_as_its_posterior_is_narrow(degrees):
    sigmas = np.geomspace(0.05, 5.0, 400)
    noise = noise_by(sigmas, weights_for(sigmas, 0.6, degrees), None, MM)
    assert noise.source == "marks" and noise.sigma == pytest.approx(0.6, rel=1.5 / degrees)
    assert noise.degrees == pytest.approx(degrees, rel=2 / degrees + 0.01)
    assert noise.quantile == pytest.approx(stats.t.isf(0.025, noise.degrees))
    assert noise.upper_quantile == pytest.approx(stats.t.isf(0.05, noise.degrees))
    # A constant in all weights is none.
    less = noise_by(sigmas, weights_for(sigmas, 0.6, degrees) - 900.0, None, MM)
    assert (less.sigma, less.degrees) == pytest.approx((noise.sigma, noise.degrees))


def test_a_noise_that_is_final_stays_whatever_the_marks_say():
    for noise in (0.1, 2.0):
        said = posterior_of(board_of(noise=noise), FINAL).noise
        assert said == Noise(0.5, KNOWN, "stated") and said.quantile == 1.96


@pytest.mark.parametrize(("stated", "true"), [(None, 0.3), (Stated(0.5), 1.0)])
def test_marks_move_what_was_stated_towards_what_they_scatter(stated, true):
    few, many = (
        posterior_of(board_of(noise=true, columns=columns, rows=3, times=times), stated).noise
        for columns, times in ((3, 1), (5, 4))
    )
    assert many.source == ("stated and marks" if stated else "marks")
    assert many.sigma == pytest.approx(true, rel=0.2)
    assert abs(np.log(many.sigma / true)) < abs(np.log(few.sigma / true)) + 0.1
    assert few.degrees < many.degrees < 200


@pytest.mark.parametrize(
    ("off", "says"), [(0.95, ""), (1.05, "more"), (-1.05, "less"), (-0.95, "")]
)
def test_noise_far_from_the_stated_noise_is_reported(off, says):
    stated = Stated(0.5)
    sigma = stated.sigma * np.exp(off * SURPRISING * STATED_SPREAD)
    sigmas = np.geomspace(0.05, 5.0, 4001)
    noise = noise_by(sigmas, weights_for(sigmas, sigma, 4000), stated, MM)
    assert len(noise.notes) == bool(says)
    assert not says or f", {says} than the stated 0.50 mm" in noise.notes[0]


# Lack of fit.


def test_the_chance_of_a_misfit_is_uniform_where_the_noise_is_known():
    chances = [misfit_chance(explain(board_of(noise=0.5, seed=seed)), FINAL) for seed in range(60)]
    assert stats.kstest(chances, "uniform").pvalue > 0.01


def test_noise_leaves_the_same_error_as_on_many_boards():
    noise = Noise(0.5, KNOWN, "stated")
    left = [explain(board_of(noise=0.5, seed=seed)).rms ** 2 for seed in range(40)]
    said = left_by_noise(explain(board_of(noise=0.5)), noise)
    assert said == pytest.approx(np.sqrt(np.mean(left)), rel=0.06)
    assert said < 0.5 * np.sqrt(2)
    more = left_by_noise(explain(board_of(noise=0.5, true=TRUE), ("chain_pitch",)), noise)
    assert more < said


def test_a_field_does_not_count_as_noise():
    """Accounts without a field need a large noise here; those with a field the noise there is."""
    board = board_cut({}, plan(5, 5), seed=4, noise=0.5, tape_sigma=None, bump=4.0)
    diagnosis = diagnose(Inputs(MAKER, board.measurements))
    posterior = diagnosis.readings.posterior
    assert diagnosis.verdict == "not_in_library" and posterior.field_chance > 0.9
    assert diagnosis.noise.sigma == pytest.approx(0.5, rel=0.3)
    # The accounts without a field keep theirs.
    assert posterior.noises.sigmas.max() > 1.5 * diagnosis.noise.sigma


NINE = plan(3, 3)


def listed(shares):
    """The accounts that are listed, by the shares of all."""
    several, weights = [*shares], np.log([*shares.values()]) + 7.0
    return [(several[place], share) for place, share in listing(several, weights)]


def test_the_fewest_accounts_that_hold_nearly_all_are_listed():
    shares = {("a",): 0.6, ("b",): 0.3, ("c",): 0.06, ("d",): 0.04}
    assert [each for each, _ in listed(shares)] == [("a",), ("b",), ("c",)]
    assert [share for _, share in listed(shares)] == pytest.approx([0.6, 0.3, 0.06])
    assert listed({("a",): LISTED + 0.001, ("b",): 0.049}) == [(("a",), pytest.approx(0.951))]
    assert [each for each, _ in listed({("a",): LISTED - 0.001, ("b",): 0.051})] == [("a",), ("b",)]
    many = {(str(i),): 0.05 for i in range(20)}
    assert len(listed(many)) == MOST_LISTED


def test_an_account_that_only_adds_to_a_likelier_one_counts_with_it():
    shares = {("a",): 0.6, ("a", "b"): 0.2, ("b", "c"): 0.15, ("d",): 0.05}
    assert listed(shares) == [(("a",), pytest.approx(0.8)), (("b", "c"), pytest.approx(0.15))]
    # One that is likelier with more stays, and what is in it stays beside it.
    assert [each for each, _ in listed({("a", "b"): 0.6, ("a",): 0.4})] == [("a", "b"), ("a",)]


def bare_posterior(layout, noise):
    """Of a machine as every machine is, cut with settings that know of no sag and no stretch."""
    made = cut(Hidden(), layout, seed=3, noise=noise, settings=BARE).measurements
    return posterior_of(measured_board(Inputs(BARE, made)), Stated(noise, is_final=True))


def test_usual_effects_are_not_suspects_where_marks_do_not_show_them():
    # Settings without sag or stretch, and marks that are read too badly to tell.
    posterior = bare_posterior(NINE, 4.0)
    assert all(not {*each.account.effects} & {*EVERY_MACHINE} for each in posterior.listed())
    # Read well, they tell that the chain sags.
    assert "chain_sag" in bare_posterior(plan(5, 5), 0.1).accounts[0].effects


def test_sizes_that_no_machine_has_are_unlikely_by_themselves():
    # A leaning frame draws the same arrows as sag, but would have to lean by 58 degrees.
    size = size_for("chain_sag", NINE, 3.0)
    measured = board({"chain_sag": size}, NINE, seed=101)
    posterior = posterior_of(measured_board(Inputs(MAKER, measured)), FINAL)
    assert posterior.listed()[0].account.effects == ("chain_sag",)
    assert not any(each.account.effects == ("frame_lean",) for each in posterior.listed())
