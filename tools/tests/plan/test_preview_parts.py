"""Tests of what a plan could tell: sizes that show, and effects that look alike."""

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
from plumb.model.catalogue import EVERY_MACHINE
from plumb.plan.preview import POWER, preview
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
def test_the_smallest_size_is_detected_at_the_stated_rate(effect):
    seen = preview(MACHINE, plan_of(5, 5), sigma=SIGMA)
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


def test_look_alikes_are_named_and_effects_that_show_are_counted(nine):
    assert "frame_lean" in outline(nine, "chain_sag").alike
    smallest = [each.smallest for each in nine.outlines if each.smallest is not None]
    assert nine.named <= nine.seen == sum(size <= 1 for size in smallest)
    assert nine.seen < sum(size <= 2 for size in smallest)
