"""One posterior: its parts are shares of a whole, and the accounts that are listed hold most."""

import numpy as np
import pytest
from hidden_boards import board, size_for
from plumb.bench.boards import cut, plan
from plumb.bench.causes import BARE, MAKER, Hidden
from plumb.diagnosis.explanation import measured_board
from plumb.diagnosis.posterior import (
    LISTED,
    MOST_LISTED,
    listing,
    posterior_of,
)
from plumb.fit.inputs import Inputs, Stated
from plumb.model.catalogue import EVERY_MACHINE

NINE = plan(3, 3)
FINAL = Stated(0.5, is_final=True)


def listed(shares):
    """The accounts that are listed, by the shares of all."""
    several, weights = [*shares], np.log([*shares.values()]) + 7.0
    return [(several[place], share) for place, share in listing(several, weights)]


def test_the_fewest_accounts_that_hold_nearly_all_are_listed():
    shares = {("a",): 0.6, ("b",): 0.3, ("c",): 0.06, ("d",): 0.04}
    assert listed(shares) == [
        (("a",), pytest.approx(0.6)),
        (("b",), pytest.approx(0.3)),
        (("c",), pytest.approx(0.06)),
    ]
    assert listed({("a",): LISTED + 0.001, ("b",): 0.049}) == [(("a",), pytest.approx(0.951))]
    assert [each for each, _ in listed({("a",): LISTED - 0.001, ("b",): 0.051})] == [("a",), ("b",)]
    many = {(str(i),): 0.05 for i in range(20)}
    assert len(listed(many)) == MOST_LISTED


def test_an_account_that_only_adds_to_a_likelier_one_counts_with_it():
    shares = {("a",): 0.6, ("a", "b"): 0.2, ("b", "c"): 0.15, ("d",): 0.05}
    assert listed(shares) == [
        (("a",), pytest.approx(0.8)),
        (("b", "c"), pytest.approx(0.15)),
    ]
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
