"""A board kept at hand gives the numbers of `plumb add`, also for sizes held by hand."""

import numpy as np
import pytest
from plumb import api
from plumb.cure.add import add
from plumb.cure.live_board import Chosen, LiveBoard
from published_marks import MARKS, SETTINGS


@pytest.fixture(scope="module")
def inputs():
    return api.read(SETTINGS, MARKS)


def sizes(fitted):
    return {estimate.name: estimate.value for estimate in fitted.estimates}


def test_refits_one_after_the_other_end_where_add_begins_afresh(inputs):
    board = LiveBoard(inputs)
    way = [("chain_pitch",), ("tape_scale", "chain_pitch"), ("chain_sag", "chain_stretch"), ()]
    for effects in [*way, ("chain_pitch", "sheet_skew")]:
        live, added = board.fit(Chosen(effects)), add(inputs, effects=effects).after_fit
        assert sizes(live) == pytest.approx(sizes(added), rel=1e-4, abs=1e-7)
        np.testing.assert_allclose(live.errors, added.errors, atol=2e-5)
        assert live.left_out_rms == pytest.approx(added.left_out_rms, rel=2e-5)
        assert live.corrected_rms == pytest.approx(added.corrected_rms, rel=2e-5)


@pytest.mark.parametrize("effect", ["chain_pitch", "tape_scale", "sheet_skew"])
def test_a_size_held_where_the_fit_put_it_leaves_the_same_errors(inputs, effect):
    free = LiveBoard(inputs).fit(Chosen((effect,)))
    mine = {name: size for name, size in sizes(free).items() if name.startswith(effect)}
    held = LiveBoard(inputs).fit(Chosen((effect,), mine))
    np.testing.assert_allclose(held.errors, free.errors, atol=1e-4)
    assert not any(name.startswith(effect) for name in sizes(held))
    assert held.spent < free.spent - 0.5
