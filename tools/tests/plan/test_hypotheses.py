"""How probable the explanations are that stand before the next measurement."""

import numpy as np
import pytest
from plan_cases import case_on, nine
from plumb.plan.case import IMPOSSIBLE, LIGHT, MOST_HYPOTHESES, _weighed


def prices(explanations):
    return {
        each.effects: each.cost + 2 * len(each.board.columns(each.effects)) for each in explanations
    }


@pytest.mark.parametrize("seed", [1, 2])
def test_explanations_are_weighed_by_their_fit_and_their_parameters(seed):
    several = list(case_on(nine(seed=seed)).singles.values())
    weighed = _weighed(several, {each.effects for each in several})
    price = prices(several)
    best = sorted(price, key=price.__getitem__)[:MOST_HYPOTHESES]
    likely = np.exp(-np.array([price[name] for name in best]) / 2)
    whole = sum(np.exp(-each / 2) for each in price.values())
    kept = [name for name, each in zip(best, likely, strict=True) if each > LIGHT * whole]
    assert [each.effects for each in weighed] == kept and len(kept) > 2
    expected = likely[: len(kept)] / likely[: len(kept)].sum()
    assert [each.weight for each in weighed] == pytest.approx(list(expected))


def test_sizes_that_no_machine_has_make_an_explanation_less_probable():
    several = list(case_on(nine()).singles.values())[:3]
    names = {each.effects for each in several}
    usual = {each.effects: each.weight for each in _weighed(several, names)}
    first = several[0].effects
    doubted = {each.effects: each.weight for each in _weighed(several, names - {first})}
    for name in names - {first}:
        ratio = (doubted[first] / doubted[name]) / (usual[first] / usual[name])
        assert ratio == pytest.approx(IMPOSSIBLE)
