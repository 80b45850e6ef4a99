"""What a plan could tell: sizes that are seen, effects that look alike, and what to add."""

from dataclasses import replace

import numpy as np
import pytest
from plan_cases import MACHINE, SIGMA
from plumb.diagnosis.answer import NOTHING
from plumb.diagnosis.every_machine import clean_of
from plumb.diagnosis.evidence import Noises, accounts_of
from plumb.diagnosis.explanation import Board, explain
from plumb.diagnosis.linear import LinearBoard
from plumb.fit.observations import model_and_observations
from plumb.marks.read import Mark, Measurements
from plumb.model.catalogue import EVERY_MACHINE, effect_names, parameter_words
from plumb.plan.preview import APART, POWER, _named, preview
from plumb.plan.proposal import AGAIN
from plumb.text.errors import InputError
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


@pytest.mark.parametrize("effect", ["sheet_skew", "chain_plane"])
def test_the_smallest_size_is_named_with_the_power_that_is_said(effect):
    seen = preview(MACHINE, plan_of(5, 5), sigma=SIGMA, is_quick=True)
    model, rows = model_and_observations(MACHINE, plan_of(5, 5))
    frame = explain(Board.of(model, rows, sigma=SIGMA))
    board = LinearBoard.of(frame, (*EVERY_MACHINE, effect))
    every = accounts_of(board)
    accounts = every.among(np.array([names in ((), (effect,)) for names in every.effects]))
    source, count = np.random.default_rng(1), 1500
    drawn = board.effects[:, board.columns[effect]] * outline(seen, effect).smallest
    read = drawn + SIGMA * source.standard_normal((len(drawn), count))
    read += board.frame @ source.standard_normal((board.frame.shape[1], count))
    noises = Noises(np.array([SIGMA]), np.zeros(1))
    total = clean_of(replace(board, read=read), accounts, noises).total
    nothing = np.exp(total[0] - np.logaddexp.reduce(total, axis=0))
    assert np.mean(nothing < NOTHING) == pytest.approx(POWER, abs=0.1)


def test_what_is_seen_better_is_named_in_smaller_sizes(nine):
    for i, each in enumerate(nine.outlines):
        assert each.effect == nine.effects[i] == effect_names()[i]
        assert each.seen == nine.matrix[i, i]
        if each.smallest is None:
            assert each.seen <= 0.01
    single = [each for each in nine.outlines if len(each.parameters) == 1 and each.smallest]
    sigmas = [each.seen * each.smallest for each in single]
    assert min(sigmas) > 2 and max(sigmas) < 8
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


def test_additions_are_worth_the_information_that_they_bring(nine):
    kinds = [each.kind for each in nine.additions]
    assert {"marks", "weight", "many", "frame", "repeats"} <= {*kinds}
    rates = [each.rate for each in nine.additions]
    assert rates == sorted(rates, reverse=True) and min(rates) >= 0
    for each in nine.additions:
        assert each.rate == pytest.approx(each.bits / (each.minutes + AGAIN))
        assert each.bits <= np.log2(len(nine.effects))
        assert each.named >= nine.named
    assert max(each.named for each in nine.additions) > nine.named
    named = [
        each.effect
        for each, row in zip(nine.outlines, nine.matrix, strict=True)
        if each.smallest is not None and each.smallest <= 1 and min(row) >= APART
    ]
    assert nine.named == len(named)
    smallest = [each.smallest for each in nine.outlines if each.smallest is not None]
    assert nine.seen == sum(size <= 1 for size in smallest) < sum(size <= 2 for size in smallest)
    # All marks of the addition at once are a plan like any other.
    many = next(each for each in nine.additions if each.kind == "many")
    marks = plan_of(3, 3, approach=(0.0, 1.0)).marks + tuple(
        replace(mark, sled_weight=None) for mark in many.visits.marks(many.visits.targets)
    )
    whole = preview(MACHINE, Measurements(marks), sigma=SIGMA, is_quick=True)
    assert whole.named == pytest.approx(many.named, abs=1)


def test_what_is_added_is_counted_as_the_plan_itself_is():
    """At noises at which effects show one after the other."""
    model, rows = model_and_observations(MACHINE, plan_of(5, 5))
    counts = []
    for sigma in (SIGMA / 8, SIGMA / 4, SIGMA / 2, SIGMA):
        seen = preview(MACHINE, plan_of(5, 5), sigma=sigma, is_quick=True)
        board = Board.of(model, rows, sigma=sigma)
        assert _named(board, seen.matrix) == seen.named <= seen.seen
        counts.append(seen.named)
    assert counts == sorted(counts, reverse=True) and counts[0] > counts[-1]


def test_a_plan_of_too_few_places_is_refused():
    with pytest.raises(InputError, match="plan at least three"):
        preview(MACHINE, Measurements(plan_of(2, 1).marks, source="m.toml"), sigma=SIGMA)
    three = preview(MACHINE, Measurements(plan_of(3, 1).marks), sigma=SIGMA, is_quick=True)
    assert (three.marks, three.distances) == (3, 0)
