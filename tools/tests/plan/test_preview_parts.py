"""What a plan could tell: sizes that are seen, effects that look alike, and what to add."""

from dataclasses import replace

import numpy as np
import pytest
from plan_cases import MACHINE, SIGMA
from plumb.marks.read import Mark, Measurements
from plumb.model.catalogue import effect_names, parameter_words
from plumb.plan.preview import APART, POWER, _needed, preview
from plumb.plan.proposal import AGAIN
from plumb.plan.separation import ENOUGH
from plumb.text.errors import InputError
from scipy import stats
from synthetic import grid


def plan_of(columns, rows, **how):
    targets = grid(columns, rows)
    return Measurements(
        tuple(Mark(str(i), tuple(at), tuple(at), **how) for i, at in enumerate(targets.tolist()))
    )


@pytest.fixture(scope="module")
def nine():
    return preview(MACHINE, plan_of(3, 3, approach=(0.0, 1.0)), sigma=SIGMA)


def outline(seen, effect):
    (only,) = [each for each in seen.outlines if each.effect == effect]
    return only


def test_the_smallest_size_is_proved_with_the_power_that_is_said():
    for parameters in (1, 2, 4):
        gate = stats.chi2.isf(np.exp(-6.0), parameters)
        sigmas = _needed(parameters, 6.0)
        assert stats.ncx2.sf(gate, parameters, sigmas**2) == pytest.approx(POWER)


def test_what_is_seen_twice_as_well_is_proved_at_half_the_size(nine):
    for i, each in enumerate(nine.outlines):
        assert each.effect == nine.effects[i] == effect_names()[i]
        assert each.seen == nine.matrix[i, i]
        if each.smallest is None:
            assert each.seen <= 0.01
    single = [each for each in nine.outlines if len(each.parameters) == 1 and each.smallest]
    products = [each.seen * each.smallest for each in single]
    assert products == pytest.approx([products[0]] * len(products))
    sag = outline(nine, "chain_sag")
    (only,) = sag.parameters
    words = parameter_words()["chain_sag.weight_ratio_squared"]
    assert (only.name, only.unit) == ("weight_ratio_squared", words["unit"])
    assert only.smallest == pytest.approx(sag.smallest * words["typical"])


def test_a_sharper_tape_sees_as_much_more(nine):
    sharp = preview(MACHINE, plan_of(3, 3, approach=(0.0, 1.0)), sigma=SIGMA / 5, is_quick=True)
    sag, sharper = outline(nine, "tape_scale"), outline(sharp, "tape_scale")
    assert sharper.raw == pytest.approx(sag.raw)
    assert sag.seen < sharper.seen < 5 * sag.seen * (1 + 1e-9)
    assert sharp.additions == () and sharp.sigma == SIGMA / 5


def test_a_tape_that_is_long_moves_marks_by_their_distance():
    # About the middle: the tape hooks on the sheet's corner for edges, so only the order of size.
    seen = preview(MACHINE, plan_of(3, 3), sigma=SIGMA, is_quick=True)
    words = parameter_words()["tape_scale.strain"]["typical"]
    radius = np.sqrt(np.mean(np.sum(grid(3, 3) ** 2, axis=1)))
    assert outline(seen, "tape_scale").raw == pytest.approx(words * radius, rel=1.0)
    friction = outline(seen, "sled_friction")
    assert friction.seen == 0.0 and friction.smallest is None and friction.hidden_share is None
    assert all(each.smallest is None for each in friction.parameters)


def test_effects_are_alike_that_the_marks_cannot_part(nine):
    for i, each in enumerate(nine.outlines):
        limit = min(APART, 0.7 * each.seen)
        wanted = {
            nine.effects[j]
            for j in range(len(nine.effects))
            if j != i and nine.matrix[i, j] < limit
        }
        assert {*each.alike} == wanted
        nearest = [nine.matrix[i, nine.effects.index(name)] for name in each.alike]
        assert nearest == sorted(nearest)
    assert "frame_lean" in outline(nine, "chain_sag").alike


def test_additions_are_worth_what_they_add_to_the_matrix(nine):
    kinds = [each.kind for each in nine.additions]
    assert "repeats" not in kinds and {"marks", "weight", "many", "frame"} <= {*kinds}
    rates = [each.rate for each in nine.additions]
    assert rates == sorted(rates, reverse=True) and min(rates) >= 0
    for each in nine.additions:
        assert each.rate == pytest.approx(each.worth / (each.minutes + AGAIN))
        assert each.worth <= np.sum(ENOUGH - np.minimum(nine.matrix**2, ENOUGH)) + 1e-6
        assert each.pairs >= nine.pairs
    assert nine.pairs == int((nine.matrix >= APART).sum())
    # All marks of the addition at once are a plan like any other.
    many = next(each for each in nine.additions if each.kind == "many")
    marks = plan_of(3, 3, approach=(0.0, 1.0)).marks + tuple(
        replace(mark, sled_weight=None) for mark in many.visits.marks(many.visits.targets)
    )
    whole = preview(MACHINE, Measurements(marks), sigma=SIGMA, is_quick=True)
    assert whole.pairs == pytest.approx(many.pairs, abs=2)


def test_a_plan_of_too_few_places_is_refused():
    with pytest.raises(InputError, match="plan at least three"):
        preview(MACHINE, Measurements(plan_of(2, 1).marks, source="m.toml"), sigma=SIGMA)
    three = preview(MACHINE, Measurements(plan_of(3, 1).marks), sigma=SIGMA, is_quick=True)
    assert (three.marks, three.distances) == (3, 0)
    assert three.targets.tolist() == grid(3, 1).tolist()
