"""Slips among the readings of a mark: found whatever is hidden, and kept out of the noise."""

from dataclasses import replace

import pytest
from plumb.bench.boards import cut, plan
from plumb.bench.causes import MAKER, Hidden, causes_of
from plumb.cure.add import add
from plumb.cure.decision import decide
from plumb.diagnosis import diagnose
from plumb.diagnosis.answer import verdict_sentence
from plumb.fit.inputs import Inputs
from plumb.marks.read import Distance
from synthetic import read_elsewhere

TWICE = Hidden(((causes_of("chain_pitch")[1], 1.5), (causes_of("chain_stretch")[0], 0.8)))


@pytest.mark.parametrize("tape_sigma", [None, 0.4])
def test_a_slip_in_a_repeat_does_not_count_as_noise(tape_sigma):
    board = cut(TWICE, plan(5, 5, repeats=True), seed=3, noise=0.4, tape_sigma=tape_sigma)
    slipped = read_elsewhere(board.measurements, len(board.measurements.marks) - 2, (10.0, 0.0))
    diagnosis = diagnose(Inputs(MAKER, slipped))
    assert diagnosis.verdict == "slip" and diagnosis.noise.sigma < 0.6
    assert [slip.name for slip in diagnosis.outliers] == [slipped.marks[-2].name]
    assert diagnosis.outliers[0].length == pytest.approx(10, abs=1.5)
    assert "disagrees with its repeats" in verdict_sentence(diagnosis)
    assert decide(Inputs(MAKER, slipped)).addition is None


def test_an_addition_that_was_asked_for_says_what_disagrees():
    board = cut(Hidden(), plan(5, 5, repeats=True), seed=3, noise=0.4, tape_sigma=None)
    slipped = read_elsewhere(board.measurements, -1, (0.0, 10.0))
    addition = add(Inputs(MAKER, slipped), effects=["chain_sag"])
    assert addition.sigma_from == "marks" and addition.after_fit.sigma < 0.6
    assert any(said.startswith("remeasure mark") for said in addition.warnings)


def test_two_slips_do_not_hide_each_other():
    board = cut(Hidden(), plan(5, 5), seed=3, noise=0.4, tape_sigma=0.4)
    slipped = read_elsewhere(read_elsewhere(board.measurements, 5, (8.0, 0.0)), 19, (-5.0, 6.0))
    diagnosis = diagnose(Inputs(MAKER, slipped))
    assert diagnosis.verdict == "slip"
    assert {slip.name for slip in diagnosis.outliers} == {slipped.marks[i].name for i in (5, 19)}


def test_of_two_readings_the_one_off_the_frame_is_named_and_both_are_doubted():
    board = cut(Hidden(), plan(5, 5, times=2), seed=4, noise=0.4, tape_sigma=None)
    diagnosis = diagnose(Inputs(MAKER, read_elsewhere(board.measurements, 30, (6.0, 0.0))))
    assert diagnosis.verdict == "slip" and len(diagnosis.outliers) == 1
    assert diagnosis.outliers[0].offset[0] == pytest.approx(6, abs=1.5)
    assert "its other reading may be the wrong one" in diagnosis.outliers[0].sentence


def test_repeated_distances_are_checked_too():
    board = cut(Hidden(), plan(3, 3, spans=True, repeats=True), seed=4, noise=0.4, tape_sigma=0.4)
    spans = list(board.measurements.distances)
    spans[-1] = Distance(spans[-1].between, spans[-1].length + 9.0)
    diagnosis = diagnose(Inputs(MAKER, replace(board.measurements, distances=tuple(spans))))
    assert diagnosis.verdict == "slip" and diagnosis.noise.sigma < 0.6
    assert diagnosis.outliers[0].name == " - ".join(spans[-1].between)
    assert diagnosis.outliers[0].offset[0] == pytest.approx(9, abs=1.5)
