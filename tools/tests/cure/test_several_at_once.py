"""Machines with several effects at once, and a little that no effect draws."""

from pathlib import Path

import pytest
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER, Hidden, causes_of
from plumb.bench.judged_board import shape_error
from plumb.cure.decision import decide
from plumb.fit.inputs import Inputs, read_inputs

BOARDS = Path(__file__).resolve().parents[1] / "data/boards"


def cured(name):
    return decide(read_inputs(BOARDS / name / "groundcontrol.ini", [BOARDS / name / "marks.toml"]))


def test_three_effects_of_a_real_machine_are_named_and_written():
    result = cured("real-25")
    assert {*result.named} == {"sled_swing", "frame_flex", "chain_sag"}
    falls = [each.rms for each in result.diagnosis.falls]
    assert falls == pytest.approx([0.92, 0.68, 0.50], abs=0.02)
    assert "Three things are wrong at once" in result.diagnosis.sentence
    assert "no effect draws" in result.diagnosis.sentence
    assert result.done and result.addition.after.left_out_rms < 0.65


def test_the_best_predicting_effects_are_written_beside_a_bump():
    result = cured("several-11")
    assert {*result.named} == {"frame_flex", "sled_swing", "sheet_skew"}
    assert result.done and result.addition.after.left_out_rms < 0.35


def test_the_promised_error_includes_what_no_effect_draws():
    hidden = Hidden(((causes_of("chain_plane")[0], 2.5),), outside="bump", outside_mm=1.0)
    board = cut(hidden, plan(5, 5), seed=3, noise=0.2, tape_sigma=0.2)
    result = decide(Inputs(MAKER, board.measurements))
    left = shape_error(result.addition.settings, board.machine.sleds)
    assert 0.5 < left == pytest.approx(result.expected_mm, rel=0.3)


@pytest.mark.parametrize("name", ["real-25", "several-11"])
def test_no_effect_has_a_chance_that_the_shares_contradict(name):
    diagnosis = cured(name).diagnosis
    for effect in diagnosis.ranking:
        shares = [each.share for each in diagnosis.explanations if effect.effect in each.effects]
        assert effect.chance >= sum(shares) - 1e-6
