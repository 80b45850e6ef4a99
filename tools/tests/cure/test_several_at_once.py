"""Machines with several things wrong at once, and a little that nobody draws."""

from dataclasses import replace
from pathlib import Path

import pytest
from plumb.bench.boards import plan
from plumb.bench.causes import MAKER
from plumb.cure.auto import add_auto
from plumb.fit.inputs import Inputs, read_inputs
from plumb.marks.read import Measurements
from plumb.model.catalogue import EVERY_MACHINE
from synthetic import marks_on

BOARDS = Path(__file__).resolve().parents[1] / "data/boards"


def cured(name):
    return add_auto(
        read_inputs(BOARDS / name / "groundcontrol.ini", [BOARDS / name / "marks.toml"])
    )


def test_three_effects_of_a_real_machine_are_named_and_written():
    result = cured("real-25")
    assert {*result.named} == {"sled_swing", "frame_flex", "chain_sag"}
    falls = [each.rms for each in result.diagnosis.falls]
    assert falls == pytest.approx([0.92, 0.68, 0.50], abs=0.02)
    assert "Three things are wrong at once" in result.diagnosis.sentence
    assert "no effect draws" in result.diagnosis.sentence
    assert result.done and result.addition.after.left_out_rms < 0.65


@pytest.mark.parametrize(
    ("name", "left"), [("several-5", 0.45), ("several-6", 0.40), ("several-11", 0.50)]
)
def test_true_effects_are_written_though_a_bump_acts_too(name, left):
    result = cured(name)
    assert {"frame_flex", "sled_swing"} <= {*result.named}
    assert {*result.named} <= {"frame_flex", "sled_swing", "sheet_skew", *EVERY_MACHINE}
    assert result.done and result.addition.after.left_out_rms < left


@pytest.mark.parametrize("name", ["real-25", "several-5", "several-6", "several-11"])
def test_no_effect_has_a_chance_that_the_shares_contradict(name):
    diagnosis = cured(name).diagnosis
    for effect in diagnosis.ranking:
        shares = [each.share for each in diagnosis.explanations if effect.effect in each.effects]
        # A share counts accounts that only add to it, and these have all of its effects.
        assert effect.chance >= sum(shares) - 1e-6
        assert effect.chance <= 0.5 or shares


def marks_of(true, seed):
    marks = marks_on(true, MAKER, plan(5, 3).targets, noise=0.5, seed=seed)
    return Inputs(MAKER, Measurements(marks, (), tape_sigma=0.5, source="marks.toml"))


def test_a_machine_that_is_right_is_left_as_it_is():
    answers = [add_auto(marks_of(MAKER, seed)) for seed in range(10)]
    assert sum(not answer.is_good for answer in answers) <= 1
    assert all(answer.addition is None for answer in answers if answer.is_good)


def test_a_machine_that_is_off_by_more_than_noise_is_not_called_good():
    off = replace(MAKER, motor_gap=MAKER.motor_gap + 3.0)
    for seed in range(4):
        answer = add_auto(marks_of(off, seed))
        assert not answer.is_good and answer.expected_mm < answer.diagnosis.choice.as_set
